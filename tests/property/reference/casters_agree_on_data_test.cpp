// The two casters on real elevation: integer heights, ragged voids, cells that are not square, seas
// and walls.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>

#include "reference/embree_caster.h"
#include "reference/pyramid_caster.h"
#include "support/elevation_files.h"
#include "support/hit_image_difference.h"
#include "terrain/camera_presets.h"
#include "terrain/terrain_source.h"

namespace plumb::reference {
namespace {

using test_support::ElevationFile;
using test_support::kElevationFiles;

class DataFile : public testing::TestWithParam<ElevationFile> {
 protected:
  static void compare(bool whole, int width_px, int height_px) {
    const ElevationFile& file = GetParam();
    const std::string path = std::string(PLUMB_SOURCE_DIR) + "/../shared/data/" + file.name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    terrain::ReadOptions options;
    if (!whole) options.window = file.window;
    options.decode = file.decode;
    options.spacing_x_m = file.spacing_m;
    const terrain::Heightfield field = terrain::load_terrain(path, options);
    const PyramidCaster pyramid(field, terrain::Diagonal::Alternating);
    const EmbreeCaster embree(field, terrain::Diagonal::Alternating);
    for (const auto& preset : terrain::preset_help()) {
      const Camera camera =
          make_camera(terrain::preset_camera(field, preset.name, width_px, height_px, 50.0));
      const auto d =
          test_support::difference(camera, pyramid.cast_frame(camera), embree.cast_frame(camera));
      std::printf("%s %s: %s\n", file.name, preset.name.c_str(), to_text(d).c_str());
      EXPECT_GT(d.hits, 0u) << preset.name;
      EXPECT_EQ(d.hit_or_miss, 0u) << preset.name << ": " << to_text(d);
      EXPECT_EQ(d.elsewhere, 0u) << preset.name << ": " << to_text(d);
    }
  }
};
class LongDataFile : public DataFile {};

TEST_P(DataFile, IsSeenAlikeByBothCasters) { compare(false, 640, 360); }
TEST_P(LongDataFile, IsSeenAlikeByBothCasters) { compare(true, 1920, 1080); }

// The long ones carry the name that keeps them out of the ordinary run.
INSTANTIATE_TEST_SUITE_P(CastersAgree, DataFile, testing::ValuesIn(kElevationFiles));
INSTANTIATE_TEST_SUITE_P(LongCastersAgree, LongDataFile, testing::ValuesIn(kElevationFiles));

}  // namespace
}  // namespace plumb::reference
