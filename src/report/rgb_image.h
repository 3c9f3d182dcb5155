// A picture of bytes, ready to be shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb::report {

/// A display colour (sRGB, 8 bits a channel).
struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;

  friend bool operator==(const Rgb&, const Rgb&) = default;
};

/// width x height pixels of three bytes (red, green, blue), row by row from the top left.
struct RgbImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  RgbImage() = default;
  RgbImage(int width_px, int height_px, Rgb fill = {})
      : width(width_px),
        height(height_px),
        rgb(3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) set(x, y, fill);
    }
  }

  std::size_t offset(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x));
  }
  Rgb at(int x, int y) const {
    const std::size_t i = offset(x, y);
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
  /// Pixels outside the picture are left out.
  void set(int x, int y, Rgb colour) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    const std::size_t i = offset(x, y);
    rgb[i] = colour.r;
    rgb[i + 1] = colour.g;
    rgb[i + 2] = colour.b;
  }
  void fill(int x, int y, int columns, int rows, Rgb colour) {
    for (int row = y; row < y + rows; ++row) {
      for (int column = x; column < x + columns; ++column) set(column, row, colour);
    }
  }

  friend bool operator==(const RgbImage&, const RgbImage&) = default;
};

}  // namespace plumb::report
