// Comparisons as the cases of a test run.
#pragma once

#include <string>

#include "compare/comparison.h"
#include "compare/folder_comparison.h"

namespace plumb::compare {

/// A suite of one case, which passes where the comparison does. What fails says why in its message,
/// and all reasons and worst pixels in its text; what has no verdict is an error.
std::string comparison_junit(const Comparison& comparison);

/// A suite of one case that could not be compared.
std::string error_junit(const std::string& name, const std::string& message);

/// A case for each pair, each file that is missing (a failure) and each that could not be compared
/// (an error), in the order of their names.
std::string folder_junit(const FolderComparison& folders);

}  // namespace plumb::compare
