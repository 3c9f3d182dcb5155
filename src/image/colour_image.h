// A picture in linear light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb::image {

/// Linear red, green and blue (Rec. 709 primaries), 1.0 is white; one entry a pixel, row by row
/// from the top left.
struct ColourImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> r, g, b;

  ColourImage() = default;
  ColourImage(int width, int height)
      : width_px(width),
        height_px(height),
        r(static_cast<std::size_t>(width) * height, 0.0f),
        g(r.size(), 0.0f),
        b(r.size(), 0.0f) {}
  std::size_t size() const { return r.size(); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * width_px + static_cast<std::size_t>(x);
  }
  friend bool operator==(const ColourImage&, const ColourImage&) = default;
};

/// A picture as files and screens have it: sRGB, 8 bits, three bytes a pixel from the top left.
struct Rgb8Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;

  friend bool operator==(const Rgb8Image&, const Rgb8Image&) = default;
};

}  // namespace plumb::image
