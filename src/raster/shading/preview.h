// A terrain as a shaded map.
#pragma once

#include <glm/vec3.hpp>

#include "image/colour_image.h"
#include "terrain/heightfield.h"

namespace plumb::raster {

/// Linear colour of what has no samples.
inline const glm::dvec3 kVoidColour{0.55, 0.05, 0.35};

/// The terrain from straight above, north up: height colours between its lowest and highest sample,
/// shaded from north-west, voids in `kVoidColour`.
///
/// Pixels are square on the ground, the longer side is at most `max_px` and no pixel is finer than
/// the finer of the two spacings. A pixel has the mean of the samples that fall in it; it is void
/// if more than half of them are. Slopes are exaggerated so that their mean, level pixels aside, is
/// at least 0.3, or 50 times at most. Same bits on any number of threads.
/// Throws std::invalid_argument if the terrain is not valid or max_px < 1.
image::ColourImage shaded_preview(const terrain::Heightfield& field, int max_px);

}  // namespace plumb::raster
