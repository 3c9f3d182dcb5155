// A picture from any file, every channel of it, numbers as they are stored.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "image/aov_image.h"

namespace plumb::image {

/// What numbers stand for: integer files are taken for sRGB, float files for linear light.
enum class Encoding { Srgb, Linear };
const char* name_of(Encoding encoding);  // "sRGB", "linear"

/// One channel, a number a pixel from the top left.
struct Plane {
  std::string name;  // as the file has it: "R", "Z", "N.X", ...
  std::vector<float> values;
  int float_digits = 24;  // binary digits that a float file keeps: 11 of half, 24 of single
};

/// Numbers of integer files are scaled to 0..1, those of float files are as they are, NaN and
/// infinities included. All planes are of one size.
struct PlaneImage {
  int width_px = 0;
  int height_px = 0;
  Encoding encoding = Encoding::Linear;
  int bits = 0;  // of an integer file's sample; 0: floats
  std::vector<Plane> planes;
  std::map<std::string, MetadataValue> metadata;  // names without their "plumb:"

  std::size_t size() const { return static_cast<std::size_t>(width_px) * height_px; }
  /// Null if there is no such channel.
  const Plane* find(std::string_view name) const;
};

/// The channels of a picture that was drawn, those that are there.
PlaneImage planes_of(const AovImage& picture);

/// Checksum of the size and of the raw bits of every channel, as floats: those of channels() first,
/// in that order, then the others by name; and of the word "sRGB" where that is the encoding.
/// Neither the metadata, nor the file's format, nor the bits of its samples are part of it.
///
///   (1) That of planes_of(picture) is raw_checksum(picture).
///   (2) The order of the planes changes nothing, nor does a float file written in another format.
std::uint64_t raw_checksum(const PlaneImage& picture);

/// A file in any format that OpenImageIO reads; alpha is not multiplied in. Throws InputError with
/// path and cause if it cannot be read whole, has no pixels or more than one part.
PlaneImage read_planes(const std::filesystem::path& path);

}  // namespace plumb::image
