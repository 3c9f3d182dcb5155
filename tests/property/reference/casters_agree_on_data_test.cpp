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
#include "support/hit_image_difference.h"
#include "terrain/camera_presets.h"
#include "terrain/terrain_source.h"

namespace plumb::reference {
namespace {

struct ElevationFile {
  const char* name;
  std::optional<terrain::Window> window =
      std::nullopt;  // of the ordinary run; all of it where absent
  terrain::Decode decode = terrain::Decode::Unspecified;
  std::optional<double> spacing_m = std::nullopt;

  friend std::ostream& operator<<(std::ostream& out, const ElevationFile& file) {
    return out << file.name;
  }
};

const ElevationFile kFiles[] = {
    {"taiwan_central_8193.tif", terrain::Window{4000, 3000, 1025, 900}},
    {"narok_kenya_5840x4934.tif", terrain::Window{2000, 200, 1025, 900}},
    {"etopo5_global_4320x2161.tif", terrain::Window{800, 500, 1025, 700}},
    {"srtm3_alps_N46E008.tif", {}},
    {"srtm3_canberra_S36E149.tif", {}},
    {"N28W017.hgt", {}},
    {"N29W014.hgt", {}},
    {"N65E029.hgt", {}},
    {"bigtujunga_30m.tif", {}},
    {"jacksboro_fault_403x344.tif", {}},
    {"ahn_dsm_0p5m_963x840.tif", {}},
    {"martini_fuji_terrainrgb.png", {}, terrain::Decode::TerrainRgb, 31.0},
    {"delatin_14-2625-6369_terrainrgb.png", {}, terrain::Decode::TerrainRgb, 3.8},
};

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
INSTANTIATE_TEST_SUITE_P(CastersAgree, DataFile, testing::ValuesIn(kFiles));
INSTANTIATE_TEST_SUITE_P(LongCastersAgree, LongDataFile, testing::ValuesIn(kFiles));

}  // namespace
}  // namespace plumb::reference
