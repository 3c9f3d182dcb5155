// Images in files: OpenEXR for data, PNG for people.
#pragma once

#include <filesystem>
#include <string>

#include "image/aov_image.h"
#include "image/colour_image.h"

namespace plumb::image {

/// Writes every channel that is there as float32, losslessly compressed, with the metadata under
/// "plumb:".
///
///   (1) The same image gives the same bytes: no clock, no machine, no thread count is in the file.
///   (2) The file appears whole or not at all.
/// Throws InputError with path and cause if it cannot be written, std::invalid_argument if the
/// image is not valid or a metadata name is empty.
void write_exr(const std::filesystem::path& path, const AovImage& image);
/// The bytes of that file.
std::string exr_bytes(const AovImage& image);

/// Reads the channels of `channels()` that the file has, by name, and the metadata under "plumb:".
/// Other channels are ignored. Throws InputError with path and cause if the file cannot be read,
/// has none of the channels, or holds a part of its picture only.
AovImage read_exr(const std::filesystem::path& path);

/// 8-bit sRGB, three channels. The same pixels give the same bytes; whole or not at all. Throws
/// InputError with path and cause.
void write_png(const std::filesystem::path& path, const Rgb8Image& image);
void write_png(const std::filesystem::path& path, const ColourImage& image);
/// The bytes of that file.
std::string png_bytes(const Rgb8Image& image);

/// An 8-bit picture in any format that OpenImageIO reads; grey becomes RGB, alpha is dropped
/// without being multiplied in. Throws InputError if it cannot be read or is not 8-bit.
Rgb8Image read_png(const std::filesystem::path& path);

/// A colour picture in linear light: integer files are sRGB, float files linear. Grey becomes RGB,
/// alpha is dropped. Throws InputError if it cannot be read.
ColourImage read_colour(const std::filesystem::path& path);

}  // namespace plumb::image
