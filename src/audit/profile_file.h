// Cost profiles as people name and write them.
#pragma once

#include <string>
#include <vector>

#include "slicing/cost_profile.h"

namespace plumb::audit {

/// The profiles that come with plumb; the first is the default.
const std::vector<slicing::CostProfile>& known_profiles();

/// A known name; a TOML file with `vertices_per_s`, `pixels_per_s` and `name` (the file's, if it
/// has none); or "NAME,VERTICES_PER_S,PIXELS_PER_S". Speeds are at least 1; a known name stands for
/// its own speeds alone. Throws InputError, one line, for anything else.
slicing::CostProfile parse_profile(const std::string& text);

/// As the third form: parsing it gives the same profile, to the last bit of its numbers.
std::string to_text(const slicing::CostProfile& profile);
/// As such a file; `comments` go before it, a line each.
std::string to_toml(const slicing::CostProfile& profile,
                    const std::vector<std::string>& comments = {});

}  // namespace plumb::audit
