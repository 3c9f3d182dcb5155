#include "compare/folder_pairs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "core/check.h"

namespace plumb::compare {
namespace fs = std::filesystem;

bool is_picture(const fs::path& path) {
  static constexpr std::array<std::string_view, 16> kExtensions{
      ".exr", ".hdr", ".pfm", ".png", ".tif", ".tiff", ".jpg",  ".jpeg",
      ".bmp", ".tga", ".pbm", ".pgm", ".ppm", ".pnm",  ".webp", ".rgbe"};
  std::string extension = path.extension().string();
  for (char& letter : extension)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

namespace {

// A folder of a report of ours, whose pictures are no pictures to compare.
bool is_report(const fs::path& folder) {
  return fs::exists(folder / "comparison.json") && fs::exists(folder / "index.html");
}

// A link to a folder that it lies in.
bool is_loop(const fs::directory_entry& entry) {
  std::error_code error;
  if (!entry.is_symlink(error)) return false;
  const fs::path target = fs::canonical(entry.path(), error),
                 place = fs::canonical(entry.path().parent_path(), error);
  const fs::path from = place.lexically_relative(target);
  return error || (!from.empty() && *from.begin() != "..");
}

}  // namespace

std::set<std::string> pictures_below(const std::string& folder) {
  std::set<std::string> names;
  std::error_code error;
  constexpr auto kOptions = fs::directory_options::follow_directory_symlink;
  fs::recursive_directory_iterator each(folder, kOptions, error);
  if (error) input_error("cannot read the folder '{}': {}", folder, error.message());
  for (; each != fs::recursive_directory_iterator(); each.increment(error)) {
    if (error) input_error("cannot read the folder '{}': {}", folder, error.message());
    if (each->is_directory() && (is_report(each->path()) || is_loop(*each)))
      each.disable_recursion_pending();
    // By its name here, wherever a link leads.
    if (each->is_regular_file() && is_picture(each->path()))
      names.insert(each->path().lexically_relative(folder).generic_string());
  }
  return names;
}

PicturePair read_pair(const std::string& reference, const std::string& candidate,
                      const std::string& mask) {
  PicturePair pair{
      reference, candidate, image::read_planes(reference), image::read_planes(candidate), {}};
  if (mask.empty()) return pair;
  const image::PlaneImage picture = image::read_planes(mask);
  if (picture.width_px != pair.width_px() || picture.height_px != pair.height_px())
    input_error("the mask '{}' has {} x {} pixels, '{}' has {} x {}", mask, picture.width_px,
                picture.height_px, reference, pair.width_px(), pair.height_px());
  for (const float value : picture.planes.front().values)
    pair.mask.push_back(value >= 0.5f ? 1 : 0);
  return pair;
}

FolderFiles folder_files(const std::string& reference, const std::string& candidate) {
  const std::set<std::string> here = pictures_below(reference), there = pictures_below(candidate);
  FolderFiles files;
  std::set<std::string> all = here;
  all.insert(there.begin(), there.end());
  for (const std::string& name : all) {
    if (here.contains(name) && there.contains(name)) {
      files.both.push_back(name);
    } else {
      files.missing.push_back({name, here.contains(name)});
    }
  }
  return files;
}

}  // namespace plumb::compare
