// A comparison as tables for a terminal.
#pragma once

#include <string>

#include "compare/comparison.h"
#include "compare/folder_comparison.h"

namespace plumb::tool {

/// The verdict first, then why, systematic differences, limits (broken ones marked), what else was
/// measured, coverage, and the worst pixels; sentences wrapped, 96 letters a line at most where
/// names allow it.
std::string comparison_text(const compare::Comparison& comparison);

/// The verdict first, then files that are missing or could not be compared by name, then a line a
/// pair, the worst first.
std::string folder_text(const compare::FolderComparison& folders);

}  // namespace plumb::tool
