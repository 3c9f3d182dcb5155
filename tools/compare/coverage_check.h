// Where terrain must be seen, where sky must be, and where either may: the sure way to find cracks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "image/plane_image.h"

namespace plumb::compare {

/// What stands for sky.
struct SkyRule {
  enum class Kind { NoGround, Alpha, Number } kind = Kind::NoGround;
  float number = 0.0f;  // of depth

  friend bool operator==(const SkyRule&, const SkyRule&) = default;
};

/// Depth (Z) that no ground has, where either picture has such: not finite, at or below zero, 1e9
/// and more; else alpha (A) below one half; else the number 1, if all depth is at most that: window
/// depth, as it was cleared. Nothing where they have neither channel.
std::optional<SkyRule> sky_rule(const image::PlaneImage& reference,
                                const image::PlaneImage& candidate);

/// 1 where a picture shows terrain.
std::vector<std::uint8_t> shown_terrain(const image::PlaneImage& picture, const SkyRule& rule);
/// The same by what the picture alone says.
std::optional<std::vector<std::uint8_t>> shown_terrain(const image::PlaneImage& picture);

/// What the candidate shows where the reference leaves no choice.
struct CoverageErrors {
  std::int64_t must_be_terrain = 0, must_be_sky = 0, undecided = 0;  // pixels of the reference
  std::int64_t holes = 0;                                            // sky where terrain must be
  std::int64_t overshoot = 0;                                        // terrain where sky must be
  std::vector<std::size_t> wrong;  // all of them, in the order of their rows
};

/// A pixel of the reference must be terrain if it and all neighbours within `band_px` (>= 0, in x
/// and y) are, must be sky likewise, and is undecided else. Throws std::invalid_argument if sizes
/// differ.
CoverageErrors check_coverage(std::span<const std::uint8_t> reference,
                              std::span<const std::uint8_t> candidate, int width_px, int height_px,
                              int band_px = 1);

}  // namespace plumb::compare
