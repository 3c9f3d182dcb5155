// A camera of a sweep: a preset, a file or a table.
#pragma once

#include <string>

#include "audit/sweep/scene.h"
#include "audit/toml_document.h"

namespace plumb::audit::sweep {

/// One frame or a path of them.
///
/// folder  in which files are looked for
/// Throws InputError, one line with the value's place.
SweepCamera sweep_camera_in(const TomlValue& value, const std::string& folder);

}  // namespace plumb::audit::sweep
