// Files of bare samples: .r16 (uint16) and .r32 (float32).
#pragma once

#include <string>

#include "terrain/heightfield.h"
#include "terrain/read_options.h"

namespace plumb::terrain {

/// Reads options.raw_size samples in rows from the north, of options.byte_order.
/// Throws InputError: no size, or a size that is not the file's; no spacing while
/// options.require_spacing.
Heightfield read_raw(const std::string& file, const ReadOptions& options);

}  // namespace plumb::terrain
