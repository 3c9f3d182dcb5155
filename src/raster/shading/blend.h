// A picture with what is blended over it.
#pragma once

#include <glm/vec3.hpp>

#include <span>

#include "core/camera.h"
#include "core/layers.h"
#include "image/colour_image.h"
#include "raster/shading/shade.h"

namespace plumb::raster {

/// Each pixel's layers, what lies behind them and fog, by their weights.
///
/// behind   shade()'s picture of the hits, with the sky where nothing is hit
/// normals  one a layer, unit
///
///   (1) Without layers it is `behind` as it is.
///   (2) Same bits on any number of threads.
/// Throws std::invalid_argument if shapes differ.
image::ColourImage blend(const image::ColourImage& behind, const Layers& layers,
                         std::span<const glm::dvec3> normals, const Camera& camera,
                         const ShadeOptions& options);

}  // namespace plumb::raster
