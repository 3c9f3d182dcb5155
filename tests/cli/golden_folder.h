// Files and pictures as tests of golden pictures read, write and change them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "image/image_files.h"

namespace plumb::testing {

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline void replace_in(const std::filesystem::path& path, const std::string& what,
                       const std::string& with) {
  std::string text = text_of(path);
  ASSERT_NE(text.find(what), std::string::npos);
  write(path, text.replace(text.find(what), what.size(), with));
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline std::uint8_t& channel(image::Rgb8Image& image, int x, int y, int c) {
  return image.rgb[static_cast<std::size_t>((y * image.width_px + x) * 3 + c)];
}

inline image::Rgb8Image mirrored(const image::Rgb8Image& drawn) {
  image::Rgb8Image result = drawn, from = drawn;
  for (int y = 0; y < drawn.height_px; ++y) {
    for (int x = 0; x < drawn.width_px; ++x) {
      for (int c = 0; c < 3; ++c)
        channel(result, x, y, c) = channel(from, drawn.width_px - 1 - x, y, c);
    }
  }
  return result;
}

// One unit up, down or nothing, as a dithered output has it.
inline image::Rgb8Image noisy(image::Rgb8Image image) {
  std::mt19937 random(7);
  for (std::uint8_t& value : image.rgb)
    value = static_cast<std::uint8_t>(
        std::clamp(static_cast<int>(value) + static_cast<int>(random() % 3) - 1, 0, 255));
  return image;
}

// The colour of the first pixel, the sky's, down column 90 from row 60 to row 99.
inline image::Rgb8Image cracked(image::Rgb8Image image) {
  for (int y = 60; y < 100; ++y) {
    for (int c = 0; c < 3; ++c) channel(image, 90, y, c) = channel(image, 0, 0, c);
  }
  return image;
}

}  // namespace plumb::testing
