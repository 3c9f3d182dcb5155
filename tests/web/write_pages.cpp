// write_pages FOLDER: reports of a generated terrain and of harm done to its picture on purpose,
// for the browser's test.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>

#include "compare/comparison.h"
#include "compare/comparison_page.h"
#include "compare/planted_defects.h"
#include "compare/planted_scene.h"
#include "compare/profile.h"

namespace {

using namespace plumb::compare;
namespace fs = std::filesystem;
using plumb::image::PlaneImage;

constexpr const char* kCommand = "plumb compare reference candidate -o report";

PicturePair pair_of(const std::string& name, PlaneImage reference, PlaneImage candidate) {
  return {"reference/" + name, "candidate/" + name, std::move(reference), std::move(candidate), {}};
}

Comparison compared(const PicturePair& pair) {
  return compare_pictures(pair, built_in_profiles().front());
}

void write_pair(const fs::path& folder, const PicturePair& pair) {
  write_comparison(folder, pair, compared(pair), kCommand);
}

// All channels, a crack, a number that is none, and a mask over the right edge.
PicturePair everything(const PlaneImage& picture, const PlaneImage& cracked) {
  PicturePair pair = pair_of("crack.exr", picture, cracked);
  pair.candidate.planes[0].values[5] = std::numeric_limits<float>::quiet_NaN();
  const int width = pair.width_px();
  pair.mask.assign(pair.size(), 1);
  for (std::size_t k = 0; k < pair.size(); ++k) {
    if (static_cast<int>(k % static_cast<std::size_t>(width)) >= width - 40) pair.mask[k] = 0;
  }
  return pair;
}

PlaneImage depth_of(PlaneImage picture) {
  std::erase_if(picture.planes, [](const auto& plane) { return plane.name != "Z"; });
  return picture;
}

void write_folders(const fs::path& folder, const PlantedScene& scene, const PlaneImage& picture) {
  Places places(2);
  FolderComparison folders{"reference", "candidate", "default", {}, {}, {}};
  folders.profile = built_in_profiles().front().name;
  const auto add = [&](const std::string& name, const PlaneImage& a, const PlaneImage& b) {
    const PicturePair pair = pair_of(name, a, b);
    folders.pairs.push_back(write_folder_pair(folder, name, pair, compared(pair), kCommand));
  };
  const PlaneImage colours = colours_alone(picture);
  add("equal.png", colours, colours);
  add("noise & bits.png", colours, with_least_bit_noise(colours, places));
  add("frames/half a pixel.exr", picture, scene.shifted(0.5, 0.0));
  add("frames/tile.exr", picture, with_missing_tile(picture, 12, places));
  add("depth.exr", depth_of(picture), depth_of(with_crack(picture, 2, 60, places)));
  add("coarse.png", colours, colours_alone(scene.with_level_of_detail(8)));
  folders.missing = {{"frames/lost.exr", true}, {"new.png", false}};
  write_folder_report(folder, folders, kCommand);
}

void write_all(const fs::path& folder) {
  const PlantedScene scene({.samples = 257, .width_px = 480, .height_px = 270});
  const PlaneImage picture = scene.drawn();
  Places places(1);
  const PlaneImage cracked = with_crack(picture, 1, 60, places);
  write_pair(folder / "all-channels", everything(picture, cracked));
  write_pair(folder / "colour-alone",
             pair_of("crack.png", colours_alone(picture), colours_alone(cracked)));
  write_folders(folder / "folders", scene, picture);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: write_pages FOLDER\n", stderr);
    return 2;
  }
  try {
    write_all(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
