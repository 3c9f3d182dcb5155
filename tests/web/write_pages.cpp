// write_pages FOLDER: reports of comparisons made by hand, for the browser's test.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "compare/comparison_page.h"
#include "compare/flip.h"
#include "unit/compare/small_comparisons.h"

namespace {

using namespace plumb::compare;

constexpr const char* kCommand = "plumb compare reference candidate -o report";

// A crack, one number that is none, a mask over the right edge, and something of every table.
void write_cracked(const std::filesystem::path& folder, bool with_depth) {
  PicturePair pair = testing::cracked_pair(480, 270, 300);
  pair.candidate.planes[0].values[5] = std::numeric_limits<float>::quiet_NaN();
  Comparison c = testing::cracked_comparison(pair);
  c.numbers = {480 * 68, 1, "channel R at (5, 0): nan, reference 0.35"};
  c.mask = MaskReport{480, 2, 1};
  pair.mask.assign(pair.size(), 1);
  for (std::size_t k = 0; k < pair.size(); ++k) {
    if (k % 480 >= 440) pair.mask[k] = 0;
  }
  c.systematic = {{Systematic::Gain, "the candidate is the reference times 1.05", 0.031, 0.004}};
  c.maps = {testing::colour_map(pair)};
  c.maps.push_back({"FLIP", "Difference that a person sees.", "", c.maps[0].values, {}});
  for (std::size_t k = 0; k < pair.size(); ++k)
    c.maps.back().values[k] *= 0.3f + 0.7f * static_cast<float>(k % 7) / 7.0f;
  if (!with_depth) {
    c.coverage.reset();
    pair = testing::colours_only(pair);
  }
  write_comparison(folder, pair, c, kCommand);
}

void write_folders(const std::filesystem::path& folder) {
  const PicturePair pair = testing::cracked_pair(480, 270, 300);
  const PicturePair depth = testing::depth_only(pair);
  FolderComparison folders{"reference", "candidate", "default", {}, {{"lost.exr", true}}, {}};
  const auto add = [&](const char* name, const PicturePair& pictures, Comparison comparison) {
    folders.pairs.push_back(
        write_folder_pair(folder, name, pictures, std::move(comparison), kCommand));
  };
  add("equal/hill.exr", pair, testing::equal_comparison("hill.exr"));
  Comparison near = testing::passing_comparison("near.exr", 0.7);
  near.maps = {testing::colour_map(pair)};
  add("near hill.exr", pair, near);
  add("crack.exr", pair, testing::cracked_comparison(pair));
  Comparison of_depth = testing::cracked_comparison(pair);
  add("depth.exr", depth, of_depth);
  write_folder_report(folder, folders, kCommand);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: write_pages FOLDER\n", stderr);
    return 2;
  }
  try {
    const std::filesystem::path folder(arguments[1]);
    write_cracked(folder / "depth-and-colour", true);
    write_cracked(folder / "colour-alone", false);
    write_folders(folder / "folders");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
