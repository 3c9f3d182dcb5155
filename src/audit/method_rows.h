// The rows of the methods that come with plumb.
#pragma once

#include <string>

#include "audit/method.h"

namespace plumb::audit {

Method full_row();
Method restricted_quadtree_row();

/// Slices alone, or slices beside meshes where these cost less.
Method slicing_row(const std::string& name, const std::string& summary, bool hybrid);

/// Patches with factors of their own, or each at one level: fine selection or none.
Method tessellation_row(const std::string& name, const std::string& summary, bool fine);

Method stacks_row();

}  // namespace plumb::audit
