// How two casters' pictures of the same scene differ.
#pragma once

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/camera.h"
#include "core/hit_image.h"

namespace plumb::test_support {

struct HitImageDifference {
  std::size_t pixels = 0;
  std::size_t hits = 0;
  std::size_t hit_or_miss = 0;  // pixels that one hits and the other misses
  std::size_t elsewhere = 0;    // pixels with |dP| * gamma / Z >= 1e-3 px
  std::size_t primitive = 0;    // pixels at the same place whose triangle differs
  double largest_px = 0.0;      // |dP| * gamma / Z over pixels that both hit

  void add(const HitImageDifference& other) {
    pixels += other.pixels;
    hits += other.hits;
    hit_or_miss += other.hit_or_miss;
    elsewhere += other.elsewhere;
    primitive += other.primitive;
    largest_px = std::max(largest_px, other.largest_px);
  }
};

inline std::string to_text(const HitImageDifference& d) {
  return fmt::format(
      "{} pixels, {} hits: {} differ in hit or miss, {} in place, {} in the triangle alone; at "
      "most "
      "{:.3g} px apart",
      d.pixels, d.hits, d.hit_or_miss, d.elsewhere, d.primitive, d.largest_px);
}

inline HitImageDifference difference(const Camera& camera, const HitImage& a, const HitImage& b) {
  HitImageDifference result;
  result.pixels = a.size();
  const double gamma = std::max(camera.gamma_h, camera.gamma_v);
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a.hit(k) != b.hit(k)) ++result.hit_or_miss;
    if (!a.hit(k) || !b.hit(k)) continue;
    ++result.hits;
    const double apart_px = glm::length(a.from_eye_m[k] - b.from_eye_m[k]) * gamma /
                            std::min(a.depth_m[k], b.depth_m[k]);
    result.largest_px = std::max(result.largest_px, apart_px);
    if (!(apart_px < 1e-3)) {
      ++result.elsewhere;
    } else if (a.primitive[k] != b.primitive[k]) {
      ++result.primitive;
    }
  }
  return result;
}

}  // namespace plumb::test_support
