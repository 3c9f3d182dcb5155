// What each pixel of a picture sees: the joint between casters, rasterisers and the audit.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/triangle_mesh.h"

namespace plumb {

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// One entry a pixel, row by row from the top left.
struct HitImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<double> depth_m;         // view depth; kNoHit where nothing is seen
  std::vector<glm::dvec3> from_eye_m;  // the point seen, relative to the eye; zero where nothing is
  std::vector<std::uint32_t>
      primitive;  // the triangle (or slice) seen; kNoPrimitive where nothing is
  std::vector<std::uint16_t>
      overdraw;  // fragments that fell on the pixel; empty where rays were cast

  HitImage() = default;
  HitImage(int width, int height)
      : width_px(width),
        height_px(height),
        depth_m(static_cast<std::size_t>(width) * height, kNoHit),
        from_eye_m(depth_m.size(), glm::dvec3(0.0)),
        primitive(depth_m.size(), kNoPrimitive) {}

  std::size_t size() const { return depth_m.size(); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * width_px + static_cast<std::size_t>(x);
  }
  bool hit(std::size_t pixel) const { return depth_m[pixel] < kNoHit; }
};

}  // namespace plumb
