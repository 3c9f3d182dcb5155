// Where a picture must show terrain, where it must not, and where either is right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb::image {

enum class Coverage : std::uint8_t {
  MustBeTerrain,
  MustBeSky,
  Either,  // along silhouettes, within the width that was asked for
};

/// One state a pixel, row by row from the top left.
struct CoverageImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<Coverage> states;

  CoverageImage() = default;
  CoverageImage(int width, int height, Coverage fill)
      : width_px(width),
        height_px(height),
        states(static_cast<std::size_t>(width) * height, fill) {}
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * width_px + static_cast<std::size_t>(x);
  }
  friend bool operator==(const CoverageImage&, const CoverageImage&) = default;
};

}  // namespace plumb::image
