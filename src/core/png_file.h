// The part of a PNG file that its pixels come from, checked. Not for users of the library.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plumb {

/// Bytes of a file.
struct FilePart {
  std::uint64_t at = 0, size = 0;
};

/// A PNG file that has been read through once.
struct PngFile {
  int columns = 0, rows = 0;
  int interlaced_bytes = 0;  // of a pixel, where a decoder must hold all of them at once; else 0
  std::vector<FilePart> parts;
};

/// Where a PNG file holds what its pixels are made from: all but its ancillary chunks (colour
/// profiles, gamma, text, time), so that a decoder has nothing to convert by and nothing to warn
/// of.
///
/// libpng writes what it complains of to standard error, past the library that calls it: so the
/// signature, the header, every chunk's length and checksum and the end are checked here first.
/// Throws InputError that names `file`.
PngFile check_png(const std::string& file);

}  // namespace plumb
