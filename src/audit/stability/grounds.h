// The grounds that failure scenes stand on.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/camera.h"
#include "terrain/heightfield.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::audit::stability {

/// Of columns x rows samples, spacing_m apart; height_m(i, j) of each.
terrain::Heightfield ground(int columns, int rows, double spacing_m,
                            const std::function<double(int, int)>& height_m);

/// Rough at every size, 10 m between samples.
terrain::Heightfield rough_ground(int columns, int rows, std::uint32_t seed,
                                  double relief_m = 100.0, double void_share = 0.0);

/// A terrain of stacks a metre apart, voxels of a metre up to high_m; rock is 1, sand 2.
terrain::Heightfield stacks(int columns, int rows, int high_m,
                            const std::function<std::vector<terrain::Layer>(int, int)>& layers);

/// A square-pixel camera of 160 x 120 pixels.
LookAt look(const glm::dvec3& eye_m, const glm::dvec3& target_m, double fov_y_deg = 50.0,
            double near_m = 0.5);

}  // namespace plumb::audit::stability
