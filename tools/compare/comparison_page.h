// A comparison for people: one page that holds everything, its pictures and its JSON as files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/folder_comparison.h"
#include "compare/picture_pair.h"

namespace plumb::compare {

/// Writes into `folder`, which is made if it is not there:
///   index.html       the page, self-contained
///   comparison.json  comparison_json(comparison, command)
///   reference.png, candidate.png, difference.png (signed), a PNG of each map with its legend,
///   coverage.png, mask.png where there are such
/// Returns the files' names. Throws InputError if one cannot be written; what stood there before is
/// then still there.
std::vector<std::string> write_comparison(const std::filesystem::path& folder,
                                          const PicturePair& pair, const Comparison& comparison,
                                          const std::string& command);

/// The report of one pair of two folders, written to `folder`/pairs/`name`, and what the folders'
/// own page needs to know of it; its maps are gone then. Throws InputError as above, and
/// std::invalid_argument if `name` is absolute or leads out of the folder.
FolderPair write_folder_pair(const std::filesystem::path& folder, const std::string& name,
                             const PicturePair& pair, Comparison comparison,
                             const std::string& command);

/// index.html with a row for each pair, the worst first (files that are missing before them), and
/// comparison.json; returns their names. Throws InputError if one cannot be written.
std::vector<std::string> write_folder_report(const std::filesystem::path& folder,
                                             const FolderComparison& folders,
                                             const std::string& command);

}  // namespace plumb::compare
