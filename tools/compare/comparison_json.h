// The results of comparisons as JSON.
#pragma once

#include <string>

#include "compare/comparison.h"
#include "compare/folder_comparison.h"

namespace plumb::compare {

/// One object, schema "plumb.compare/1", that holds the command that makes it again, the verdict
/// and its reasons, limits, all measurements, systematic differences, coverage, numbers that are
/// not finite, mask, worst pixels and notes; a line end behind it. Text that is not UTF-8 has
/// U+FFFD in its place.
///
///   (1) A number that is infinite or none is null: the PSNR of equal pictures.
///   (2) The same comparison gives the same bytes: no clock, no machine, no thread count.
std::string comparison_json(const Comparison& comparison, const std::string& command);

/// One object, schema "plumb.compare-folder/1": counts, files that one side lacks, files that could
/// not be compared, and each pair's object (without command) in the order of by_badness.
std::string folder_json(const FolderComparison& folders, const std::string& command);

}  // namespace plumb::compare
