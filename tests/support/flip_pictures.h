// Pictures for tests of FLIP.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "compare/flip.h"
#include "support/slow_flip.h"

namespace plumb::testing {

/// A picture that owns its channels.
struct FlipPicture {
  int width = 0, height = 0;
  std::vector<float> channel[3];

  FlipPicture(int w, int h, const glm::dvec3& colour = {}) : width(w), height(h) {
    for (int c = 0; c < 3; ++c)
      channel[c].assign(static_cast<std::size_t>(w) * h, static_cast<float>(colour[c]));
  }
  FlipPicture(int w, int h, const std::function<glm::dvec3(int, int)>& colour) : FlipPicture(w, h) {
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) set(x, y, colour(x, y));
    }
  }
  void set(int x, int y, const glm::dvec3& colour) {
    for (int c = 0; c < 3; ++c)
      channel[c][static_cast<std::size_t>(y) * width + x] = static_cast<float>(colour[c]);
  }
  compare::ColourPlanes planes() const {
    return {width, height, channel[0], channel[1], channel[2]};
  }
  SlowPicture slow() const {
    SlowPicture picture{width, height, {}};
    for (std::size_t k = 0; k < channel[0].size(); ++k)
      picture.pixels.emplace_back(channel[0][k], channel[1][k], channel[2][k]);
    return picture;
  }
};

/// Numbers in [0, 1) that look random and are the same everywhere.
class FlipNumbers {
 public:
  explicit FlipNumbers(std::uint64_t seed) : state_(seed) {}
  double next() {
    std::uint64_t x = (state_ += 0x9e3779b97f4a7c15ULL);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

/// Even patches with noise: edges, points, and every colour.
inline FlipPicture patchy_picture(int width, int height, std::uint64_t seed, double noise = 0.05) {
  FlipNumbers numbers(seed);
  std::vector<glm::dvec3> patches;
  for (int k = 0; k < 16; ++k) patches.emplace_back(numbers.next(), numbers.next(), numbers.next());
  return {width, height, [&](int x, int y) {
            const glm::dvec3 even = patches[static_cast<std::size_t>((x / 7 + y / 5 * 3) % 16)];
            const glm::dvec3 by(numbers.next(), numbers.next(), numbers.next());
            return glm::clamp(even + noise * (by - 0.5), 0.0, 1.0);
          }};
}

}  // namespace plumb::testing
