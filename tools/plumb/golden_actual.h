// The folder into which another program wrote its pictures.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "golden_manifest.h"

namespace plumb::tool {

/// Its pictures (compare::is_picture): NAME.EXT right in the folder belongs to the case NAME.
struct ActualFolder {
  std::filesystem::path folder;
  std::map<std::string, std::vector<std::filesystem::path>> pictures;  // by the case's name
  std::vector<std::string> strays;  // pictures anywhere below that no case names, sorted

  /// None if there is no picture of that name. Throws InputError that lists them if there are two.
  std::optional<std::filesystem::path> find(const std::string& name) const;
};

/// Throws InputError for a folder that cannot be read.
ActualFolder read_actual_folder(const std::filesystem::path& folder,
                                const GoldenManifest& manifest);

}  // namespace plumb::tool
