#include "compare/others_fuzzy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "compare/others_rules.h"

namespace plumb::compare {
namespace {

using image::Rgb8Image;

constexpr std::uint32_t kSeed = 667;
constexpr int kForgiven = 4;                   // of a channel's difference
constexpr int kLongestStep = 8;                // to the next pixel of a row
constexpr int kSamples = 32;                   // between pixels, around each
constexpr float kMiddle = 0.8f, kSide = 0.1f;  // the blur, in x and in y

struct Colour {
  int r, g, b;
};

Colour pixel(const Rgb8Image& picture, int x, int y) {
  const std::uint8_t* at =
      &picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
                        static_cast<std::size_t>(x))];
  return {at[0], at[1], at[2]};
}

// Values are never below zero here.
int rounded(float value) { return std::min(static_cast<int>(value + 0.5f), 255); }

// Three taps along x (step 3 bytes) or along y (a row), the border's pixel repeated, rounded to 8
// bits: the suites keep what lies between the two directions in a picture as well.
Rgb8Image blurred(const Rgb8Image& from, bool along_x) {
  Rgb8Image to = from;
  const int length = along_x ? from.width_px : from.height_px;
  const std::size_t stride = along_x ? 3 : 3 * static_cast<std::size_t>(from.width_px);
  std::size_t k = 0;
  for (int y = 0; y < from.height_px; ++y) {
    for (int x = 0; x < from.width_px; ++x) {
      const int at = along_x ? x : y;
      const std::size_t back = at > 0 ? stride : 0, on = at + 1 < length ? stride : 0;
      for (int c = 0; c < 3; ++c, ++k) {
        float sum = static_cast<float>(from.rgb[k - back]) * kSide;
        sum += static_cast<float>(from.rgb[k]) * kMiddle;
        sum += static_cast<float>(from.rgb[k + on]) * kSide;
        to.rgb[k] = static_cast<std::uint8_t>(rounded(sum));
      }
    }
  }
  return to;
}

std::uint32_t squared_distance(const Colour& a, const Colour& b) {
  const int r = std::max(std::abs(a.r - b.r) - kForgiven, 0),
            g = std::max(std::abs(a.g - b.g) - kForgiven, 0),
            blue = std::max(std::abs(a.b - b.b) - kForgiven, 0);
  return static_cast<std::uint32_t>(r * r + g * g + blue * blue);
}

// The colour at (u, v), pixels' middles at halves, rounded to 8 bits. Every operation in float and
// in the order of the source, whose roundings decide the bits.
Colour between_pixels(const Rgb8Image& picture, float u, float v) {
  const float left = std::floor(u - 0.5f), top = std::floor(v - 0.5f);
  const float a = (u - 0.5f) - left, b = (v - 0.5f) - top;
  const int x = static_cast<int>(left), y = static_cast<int>(top);
  const int last_x = picture.width_px - 1, last_y = picture.height_px - 1;
  const int x0 = std::clamp(x, 0, last_x), x1 = std::clamp(x + 1, 0, last_x);
  const int y0 = std::clamp(y, 0, last_y), y1 = std::clamp(y + 1, 0, last_y);
  const auto mixed = [&](int p00, int p10, int p01, int p11) {
    return rounded(static_cast<float>(p00) * (1.0f - a) * (1.0f - b) +
                   static_cast<float>(p10) * a * (1.0f - b) +
                   static_cast<float>(p01) * (1.0f - a) * b + static_cast<float>(p11) * a * b);
  };
  const Colour p00 = pixel(picture, x0, y0), p10 = pixel(picture, x1, y0),
               p01 = pixel(picture, x0, y1), p11 = pixel(picture, x1, y1);
  return {mixed(p00.r, p10.r, p01.r, p11.r), mixed(p00.g, p10.g, p01.g, p11.g),
          mixed(p00.b, p10.b, p01.b, p11.b)};
}

// The least distance of a colour to what a picture holds around (x, y), which lies inside. The
// search ends at the first match: how many numbers it draws belongs to the sequence.
std::uint32_t distance_to_near(ConformanceRandom& random, const Colour& colour,
                               const Rgb8Image& picture, int x, int y) {
  std::uint32_t least = squared_distance(colour, pixel(picture, x, y));
  for (int dy = -1; dy <= 1 && least > 0; ++dy) {
    for (int dx = -1; dx <= 1 && least > 0; ++dx)
      least = std::min(least, squared_distance(colour, pixel(picture, x + dx, y + dy)));
  }
  for (int s = 0; s < kSamples && least > 0; ++s) {
    const float u = static_cast<float>(x) + random.unit() * 2.0f - 0.5f;
    const float v = static_cast<float>(y) + random.unit() * 2.0f - 0.5f;
    least = std::min(least, squared_distance(colour, between_pixels(picture, u, v)));
  }
  return least;
}

}  // namespace

double fuzzy_sum(const Rgb8Image& reference, const Rgb8Image& candidate) {
  require_judgeable(reference, candidate);
  const Rgb8Image a = blurred(blurred(reference, true), false);
  const Rgb8Image b = blurred(blurred(candidate, true), false);
  ConformanceRandom random(kSeed);
  std::uint64_t sum = 0;
  std::int64_t looked_at = 0;
  for (int y = 1; y < a.height_px - 1; ++y) {
    for (int x = 1; x < a.width_px - 1; x += random.integer(1, kLongestStep)) {
      const std::uint32_t forth = distance_to_near(random, pixel(a, x, y), b, x, y);
      const std::uint32_t back = distance_to_near(random, pixel(b, x, y), a, x, y);
      const std::uint32_t squared = std::min(forth, back);
      // In 32 bits, as there: a distance beyond 256 begins again at zero.
      sum += static_cast<std::uint32_t>(squared * squared);
      ++looked_at;
    }
  }
  const double largest = 255.0 - kForgiven;
  const double pixels = static_cast<double>(a.width_px - 2) * (a.height_px - 2);
  return static_cast<double>(sum) / (largest * largest * largest * largest) *
         (pixels / static_cast<double>(looked_at));
}

}  // namespace plumb::compare
