// Two pictures that can be compared: of one size, with the same channels, of the same kind.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image/plane_image.h"

namespace plumb::compare {

struct PicturePair {
  std::string reference_name, candidate_name;  // as messages and reports call them
  image::PlaneImage reference, candidate;
  /// 1 where pixels are judged; empty: everywhere.
  std::vector<std::uint8_t> mask = {};

  int width_px() const { return reference.width_px; }
  int height_px() const { return reference.height_px; }
  std::size_t size() const { return reference.size(); }
  bool judged(std::size_t pixel) const { return mask.empty() || mask[pixel] != 0; }
};

/// Throws InputError that says what both are unless sizes, names of channels and encodings are the
/// same and the mask, if any, is of that size.
void require_comparable(const PicturePair& pair);

/// The channels of a colour, three of them (grey thrice); nothing without colour.
std::vector<const image::Plane*> colour_planes(const image::PlaneImage& picture);

/// A picture's colour as a screen shows it: sRGB numbers as they are, linear light encoded (its
/// curve goes on above one, below zero is zero). Numbers that are not finite become zero.
std::vector<std::vector<float>> display_colour(const image::PlaneImage& picture);

}  // namespace plumb::compare
