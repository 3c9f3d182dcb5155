// A terrain of a sweep: a source, or a table.
#pragma once

#include <string>

#include "audit/sweep/scene.h"
#include "audit/toml_document.h"

namespace plumb::audit::sweep {

/// folder  in which files are looked for
/// Throws InputError, one line with the value's place.
SweepTerrain terrain_in(const TomlValue& value, const std::string& folder);

}  // namespace plumb::audit::sweep
