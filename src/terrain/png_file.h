// The part of a PNG file that its pixels come from, checked. Not for users of the library.
#pragma once

#include <string>
#include <vector>

namespace plumb::terrain {

/// The bytes of a PNG file without its ancillary chunks (colour profiles, gamma, text, time), so
/// that a decoder has nothing to convert by and nothing to warn of.
///
/// libpng writes what it complains of to standard error, past the library that calls it: so the
/// signature, the header, every chunk's length and checksum and the end are checked here first.
/// Throws InputError that names `file`.
std::vector<unsigned char> read_png_pixels(const std::string& file);

}  // namespace plumb::terrain
