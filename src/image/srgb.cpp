#include "image/srgb.h"

#include <algorithm>
#include <array>

#include "core/check.h"
#include "core/reproducible_math.h"

namespace plumb::image {
namespace {

// Linear light of the boundary between codes k and k + 1: at or above it, k + 1 is the nearer.
std::array<double, 255> make_boundaries() {
  std::array<double, 255> boundaries{};
  for (std::size_t k = 0; k < boundaries.size(); ++k) {
    boundaries[k] = srgb_to_linear((static_cast<double>(k) + 0.5) / 255.0);
  }
  return boundaries;
}

std::array<float, 256> make_levels() {
  std::array<float, 256> levels{};
  for (std::size_t k = 0; k < levels.size(); ++k) {
    levels[k] = static_cast<float>(srgb_to_linear(static_cast<double>(k) / 255.0));
  }
  return levels;
}

}  // namespace

double srgb_to_linear(double encoded) {
  if (encoded <= 0.04045) return encoded / 12.92;
  return reproducible_pow((encoded + 0.055) / 1.055, 2.4);
}

float srgb8_to_linear(std::uint8_t code) {
  static const std::array<float, 256> levels = make_levels();
  return levels[code];
}

std::uint8_t linear_to_srgb8(float linear) {
  static const std::array<double, 255> boundaries = make_boundaries();
  if (!(linear > 0.0f)) return 0;
  const auto above = std::upper_bound(boundaries.begin(), boundaries.end(), double{linear});
  return static_cast<std::uint8_t>(above - boundaries.begin());
}

Rgb8Image to_srgb8(const ColourImage& image) {
  Rgb8Image result{image.width_px, image.height_px, {}};
  result.rgb.resize(3 * image.size());
  for (std::size_t k = 0; k < image.size(); ++k) {
    result.rgb[3 * k] = linear_to_srgb8(image.r[k]);
    result.rgb[3 * k + 1] = linear_to_srgb8(image.g[k]);
    result.rgb[3 * k + 2] = linear_to_srgb8(image.b[k]);
  }
  return result;
}

ColourImage to_linear(const Rgb8Image& image) {
  ColourImage result(image.width_px, image.height_px);
  require(image.rgb.size() == 3 * result.size(), "{} x {} pixels need {} bytes, got {}",
          image.width_px, image.height_px, 3 * result.size(), image.rgb.size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    result.r[k] = srgb8_to_linear(image.rgb[3 * k]);
    result.g[k] = srgb8_to_linear(image.rgb[3 * k + 1]);
    result.b[k] = srgb8_to_linear(image.rgb[3 * k + 2]);
  }
  return result;
}

}  // namespace plumb::image
