// Small grey pictures for the tests of other projects' rules.
#pragma once

#include <cstdint>
#include <functional>

#include "image/colour_image.h"

namespace plumb::compare {

inline image::Rgb8Image drawn(int width, int height, const std::function<int(int, int)>& grey) {
  image::Rgb8Image picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      picture.rgb.insert(picture.rgb.end(), 3, static_cast<std::uint8_t>(grey(x, y)));
  }
  return picture;
}

inline image::Rgb8Image even(int grey, int width = 16, int height = 16) {
  return drawn(width, height, [&](int, int) { return grey; });
}

}  // namespace plumb::compare
