// The transfer between linear light and 8-bit sRGB, with the same bytes on every machine.
#pragma once

#include <cstdint>

#include "image/colour_image.h"

namespace plumb::image {

/// Linear light of an sRGB value, both in [0, 1]. Source: IEC 61966-2-1.
double srgb_to_linear(double encoded);
/// The same of an 8-bit code.
float srgb8_to_linear(std::uint8_t code);
/// The code whose linear light is nearest in sRGB; below 0 and NaN give 0, above 1 gives 255.
///
///   (1) linear_to_srgb8(srgb8_to_linear(c)) == c for every code.
///   (2) Never falls when `linear` rises.
std::uint8_t linear_to_srgb8(float linear);

Rgb8Image to_srgb8(const ColourImage& image);
ColourImage to_linear(const Rgb8Image& image);

}  // namespace plumb::image
