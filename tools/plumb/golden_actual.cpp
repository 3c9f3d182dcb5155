#include "golden_actual.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "compare/folder_pairs.h"
#include "core/check.h"

namespace plumb::tool {
namespace fs = std::filesystem;

std::optional<fs::path> ActualFolder::find(const std::string& name) const {
  const auto found = pictures.find(name);
  if (found == pictures.end()) return std::nullopt;
  if (found->second.size() > 1) {
    std::vector<std::string> names;
    for (const fs::path& each : found->second) names.push_back(each.filename().string());
    input_error("{}: more than one picture of the case: {}", folder.string(),
                fmt::join(names, ", "));
  }
  return found->second.front();
}

ActualFolder read_actual_folder(const fs::path& folder, const GoldenManifest& manifest) {
  ActualFolder actual{folder, {}, {}};
  for (const std::string& name : compare::pictures_below(folder.string())) {
    const fs::path file = name;
    const std::string stem = file.stem().string();
    const bool is_named = !file.has_parent_path() &&
                          std::any_of(manifest.cases.begin(), manifest.cases.end(),
                                      [&](const GoldenCase& each) { return each.name == stem; });
    if (is_named) {
      actual.pictures[stem].push_back(folder / file);
    } else {
      actual.strays.push_back((folder / file).string());
    }
  }
  return actual;
}

}  // namespace plumb::tool
