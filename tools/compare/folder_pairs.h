// Pictures to be compared, from files and folders.
#pragma once

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

/// Files are pictures by their extension (EXR, HDR, PFM, PNG, TIFF, JPEG, BMP, TGA, PNM, WebP);
/// others are passed over. Throws InputError for a folder that cannot be read.
FolderFiles folder_files(const std::string& reference, const std::string& candidate);

}  // namespace plumb::compare
