// Pictures to be compared, from files and folders.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "compare/folder_comparison.h"
#include "compare/picture_pair.h"

namespace plumb::compare {

/// Both pictures, read, and where `mask` is not empty the mask: 0 where its first channel is below
/// one half. Throws InputError for what cannot be read and for a mask of another size.
PicturePair read_pair(const std::string& reference, const std::string& candidate,
                      const std::string& mask = "");

/// Pictures below two folders by their names ('/' between folders), in the order of the names.
struct FolderFiles {
  std::vector<std::string> both;
  std::vector<MissingFile> missing;
};

/// Whether a file is a picture by its extension: EXR, HDR, PFM, PNG, TIFF, JPEG, BMP, TGA, PNM,
/// WebP, in letters of either size.
bool is_picture(const std::filesystem::path& path);

/// The names of all pictures below a folder; other files are passed over. Throws InputError for a
/// folder that cannot be read.
std::set<std::string> pictures_below(const std::string& folder);

/// Throws InputError for a folder that cannot be read.
FolderFiles folder_files(const std::string& reference, const std::string& candidate);

}  // namespace plumb::compare
