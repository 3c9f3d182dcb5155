#include "compare/coverage_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace plumb::compare {
namespace {

// For each number whether all within `radius` of it along a line are ones, and whether all are
// zeros; beyond the line's ends there is nothing.
void all_alike(const std::uint8_t* from, std::size_t stride, int count, int radius,
               std::uint8_t* ones, std::uint8_t* zeros) {
  int ones_until = 0, zeros_until = 0;  // how far back they reach, counted from the running end
  for (int k = 0; k < count + radius; ++k) {
    if (k < count) {
      const bool one = from[static_cast<std::size_t>(k) * stride] != 0;
      ones_until = one ? ones_until : k + 1;
      zeros_until = one ? k + 1 : zeros_until;
    }
    const int middle = k - radius;
    if (middle < 0) continue;
    const int first = std::max(0, middle - radius);
    ones[static_cast<std::size_t>(middle) * stride] = ones_until <= first ? 1 : 0;
    zeros[static_cast<std::size_t>(middle) * stride] = zeros_until <= first ? 1 : 0;
  }
}

constexpr float kFartherThanGround = 1e9f;

// A depth that ground can have.
bool is_ground(float z) { return z > 0.0f && z < kFartherThanGround; }

// Of the depth of two pictures.
struct DepthRange {
  float low = std::numeric_limits<float>::infinity();
  float high = -std::numeric_limits<float>::infinity();
  bool all_ground = true;

  void add(const image::Plane& depth) {
    for (const float z : depth.values) {
      low = std::min(low, z);
      high = std::max(high, z);
      all_ground = all_ground && is_ground(z);
    }
  }
};

}  // namespace

std::optional<SkyRule> sky_rule(const image::PlaneImage& reference,
                                const image::PlaneImage& candidate) {
  DepthRange range;
  bool has_depth = false;
  for (const image::PlaneImage* picture : {&reference, &candidate}) {
    const image::Plane* depth = picture->find("Z");
    if (depth == nullptr) continue;
    range.add(*depth);
    has_depth = true;
  }
  const bool has_alpha = reference.find("A") != nullptr && candidate.find("A") != nullptr;
  if (has_depth && !range.all_ground) return SkyRule{};
  if (has_alpha) return SkyRule{SkyRule::Kind::Alpha};
  if (!has_depth) return std::nullopt;
  const bool is_cleared_window = range.high == 1.0f && range.low < 1.0f;
  return is_cleared_window ? SkyRule{SkyRule::Kind::Number, 1.0f} : SkyRule{};
}

std::vector<std::uint8_t> shown_terrain(const image::PlaneImage& picture, const SkyRule& rule) {
  const image::Plane& plane = *picture.find(rule.kind == SkyRule::Kind::Alpha ? "A" : "Z");
  std::vector<std::uint8_t> shown(picture.size());
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const float value = plane.values[k];
    shown[k] = rule.kind == SkyRule::Kind::Alpha    ? value >= 0.5f
               : rule.kind == SkyRule::Kind::Number ? value != rule.number
                                                    : is_ground(value);
  }
  return shown;
}

std::optional<std::vector<std::uint8_t>> shown_terrain(const image::PlaneImage& picture) {
  const auto rule = sky_rule(picture, picture);
  if (!rule) return std::nullopt;
  return shown_terrain(picture, *rule);
}

CoverageErrors check_coverage(std::span<const std::uint8_t> reference,
                              std::span<const std::uint8_t> candidate, int width_px, int height_px,
                              int band_px) {
  const auto width = static_cast<std::size_t>(width_px),
             height = static_cast<std::size_t>(height_px);
  require(reference.size() == width * height && candidate.size() == width * height && band_px >= 0,
          "coverage must be of one size and the band >= 0");
  const std::size_t size = width * height;
  std::vector<std::uint8_t> ones(size), zeros(size), terrain(size), sky(size), unused(size);
  for (std::size_t y = 0; y < height; ++y)
    all_alike(&reference[y * width], 1, width_px, band_px, &ones[y * width], &zeros[y * width]);
  for (std::size_t x = 0; x < width; ++x) {
    all_alike(&ones[x], width, height_px, band_px, &terrain[x], &unused[x]);
    all_alike(&zeros[x], width, height_px, band_px, &sky[x], &unused[x]);
  }
  CoverageErrors errors;
  for (std::size_t k = 0; k < size; ++k) {
    errors.must_be_terrain += terrain[k];
    errors.must_be_sky += sky[k];
    errors.undecided += terrain[k] == 0 && sky[k] == 0;
    const bool hole = terrain[k] != 0 && candidate[k] == 0;
    const bool overshoot = sky[k] != 0 && candidate[k] != 0;
    errors.holes += hole;
    errors.overshoot += overshoot;
    if (hole || overshoot) errors.wrong.push_back(k);
  }
  return errors;
}

}  // namespace plumb::compare
