// Two folders of pictures, compared file by file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/comparison.h"

namespace plumb::compare {

/// A file that both folders have.
struct FolderPair {
  std::string name;       // below both folders, '/' between folders
  Comparison comparison;  // its maps need not be there any more
  std::string page = {};  // its own report, below the folder's; "": it has none
  std::vector<std::uint8_t> thumbnail_png = {};  // may be empty
};

/// A file that one folder alone has: a failure.
struct MissingFile {
  std::string name;
  bool in_reference = true;  // the candidate lacks it; else the reference
};

/// A file of both that could not be compared: unreadable, of different sizes.
struct FolderError {
  std::string name, message;
};

struct FolderComparison {
  std::string reference_name, candidate_name;  // the folders
  std::string profile;
  std::vector<FolderPair> pairs;
  std::vector<MissingFile> missing;
  std::vector<FolderError> errors;

  int count(CompareVerdict verdict) const;  // pairs
  /// None if a pair could not be compared or judged, or there is nothing at all; fails if a pair
  /// does, or a file is missing; passes or equal else.
  CompareVerdict verdict() const;
};

/// One sentence without the label.
std::string verdict_sentence(const FolderComparison& folders);

/// Places in `pairs`, the worst first: those that fail, those without a verdict, those that pass,
/// equal ones; among these by what uses most of its limit, then by name.
std::vector<std::size_t> by_badness(const FolderComparison& folders);

/// "missing in the candidate", "missing in the reference".
const char* missing_text(const MissingFile& file);

}  // namespace plumb::compare
