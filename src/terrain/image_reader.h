// Heights in PNG and OpenEXR images.
#pragma once

#include <string>

#include "terrain/heightfield.h"
#include "terrain/read_options.h"

namespace plumb::terrain {

/// Reads an image without georeference: 8- and 16-bit PNG, half and float OpenEXR; the first
/// channel is a height (options.band chooses another), or three channels are a colour that
/// options.decode turns into one.
///
/// Stored values are taken as they are: no gamma, no multiplication by alpha. A pixel that is
/// transparent and black all over (the empty pixel of terrain-RGB tiles) is void; alpha has no
/// other meaning.
/// Throws InputError: unreadable, a colour image without options.decode, no spacing while
/// options.require_spacing.
Heightfield read_image(const std::string& file, const ReadOptions& options);

}  // namespace plumb::terrain
