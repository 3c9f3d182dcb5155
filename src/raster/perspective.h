// What a triangle shows at a pixel's centre: depth, and how much each corner counts for.
#pragma once

#include <glm/vec3.hpp>

#include <array>

#include "raster/fixed_point.h"

namespace plumb::raster {

/// 1 / (doubled area * depth of corner i), for a triangle that has an area.
inline glm::dvec3 corner_scales(const EdgeFunctions& edges,
                                const std::array<ScreenVertex, 3>& corners) {
  const auto area = static_cast<double>(edges.doubled_area);
  return {corners[0].inverse_depth / area, corners[1].inverse_depth / area,
          corners[2].inverse_depth / area};
}

/// l_i / w_i where the edge functions have these values: screen barycentric coordinates over
/// depths. Edge function i over the doubled area is l_i. Each step is one rounding of doubles from
/// exact integers.
inline glm::dvec3 corner_shares(std::int64_t edge_0, std::int64_t edge_1, std::int64_t edge_2,
                                const glm::dvec3& scales) {
  return {static_cast<double>(edge_0) * scales.x, static_cast<double>(edge_1) * scales.y,
          static_cast<double>(edge_2) * scales.z};
}

/// The same at the centre of pixel (x, y).
inline glm::dvec3 corner_shares(const EdgeFunctions& edges, const glm::dvec3& scales, int x,
                                int y) {
  const auto at = [&](std::size_t i) {
    return edges.at_first[i] + x * edges.step_x[i] + y * edges.step_y[i];
  };
  return corner_shares(at(0), at(1), at(2), scales);
}

/// One over the depth is the sum of the shares; the perspective-correct coordinate of corner i is
/// its share times the depth.
inline double depth_of(const glm::dvec3& shares) { return 1.0 / (shares.x + shares.y + shares.z); }

}  // namespace plumb::raster
