// Where on the screen a drawn surface's work lies.
#pragma once

#include <vector>

#include "core/camera.h"
#include "core/drawn_surface.h"

namespace plumb::audit {

/// For each pixel of `drawn` one over the area on screen, in square pixels, of the triangle that it
/// shows: how many such triangles a pixel has room for. 0 where nothing is seen, where the triangle
/// reaches behind the near plane, and where it is seen edge on. Empty for a surface without a mesh.
///
///   (1) The same triangles for a camera of twice the width and height: a fourth of the density.
std::vector<float> triangles_a_pixel(const DrawnSurface& surface, const HitImage& drawn,
                                     const Camera& camera);

}  // namespace plumb::audit
