// A picture of a terrain for people.
#pragma once

#include <string>

#include "terrain/heightfield.h"

namespace plumb::tool {

/// Writes a shaded picture of the terrain, north up, as PNG: one pixel a sample, or fewer where the
/// terrain is larger than 2048 samples. Throws InputError if it cannot be written.
void write_preview(const std::string& path, const terrain::Heightfield& field);

}  // namespace plumb::tool
