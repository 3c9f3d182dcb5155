// The elevation files that come with the project load as their README says.
#include <cmath>
#include <optional>

#include "written_files.h"

namespace plumb::terrain {
namespace {

std::string data(const std::string& name) {
  return std::string(PLUMB_SOURCE_DIR) + "/../shared/data/" + name;
}

#define SKIP_WITHOUT(name) \
  if (!std::filesystem::exists(data(name))) GTEST_SKIP() << data(name) << " is not here"

struct KnownFile {
  const char* name;
  int columns, rows;
  double dx_m, dy_m, spacing_tolerance_m;
  float lowest, highest, height_tolerance;
  std::int64_t voids;
  std::function<void(ReadOptions&)> options;
};

void nothing(ReadOptions&) {}
void terrain_rgb(ReadOptions& options) {
  options.decode = Decode::TerrainRgb;
  options.spacing_x_m = 10.0;
}
void decimetres(ReadOptions& options) {
  options.height_scale = 0.1;
  options.spacing_x_m = 20.0;
}
void raw_decimetres(ReadOptions& options) {
  decimetres(options);
  options.raw_size = RawSize{513, 513};
}

// Spacings: exact where the file states metres; within half a unit of the last digit that the
// README prints, and where it takes a degree of latitude for 111.2 km (92.7 m for three seconds)
// within 0.5 % of it, as the ellipsoid's degrees are 110.6 to 111.7 km long.
// Heights: exact; 0.1 m steps and three decimals are the nearest floats.
const std::vector<KnownFile>& known_files() {
  constexpr double kDegree = 0.005 * 92.7;
  static const std::vector<KnownFile> files = {
      {"taiwan_central_8193.tif", 8193, 8193, 20.065, 20.065, 0.115, -33, 3947, 0, 0, nothing},
      {"narok_kenya_5840x4934.tif", 5840, 4934, 38.2, 38.2, 0.05, 597, 3095, 0, 12158981, nothing},
      {"srtm3_alps_N46E008.tif", 1201, 1201, 64, 92.7, 1.0, 187, 4173, 0, 103743, nothing},
      {"srtm3_canberra_S36E149.tif", 1201, 1201, 75, 92.7, 1.0, 7, 1604, 0, 0, nothing},
      {"N28W017.hgt", 1201, 1201, 81, 92.7, 1.0, -9, 3695, 0, 0, nothing},
      {"N29W014.hgt", 1201, 1201, 80.8, 92.7, kDegree, -14, 669, 0, 2, nothing},
      {"N65E029.hgt", 1201, 1201, 39, 92.7, 0.5, 157, 469, 0, 4804, nothing},
      {"bigtujunga_30m.tif", 1197, 643, 30, 30, 0, 315, 2295, 0, 0, nothing},
      {"jacksboro_fault_403x344.tif", 403, 344, 74.5, 92.7, 0.5, 236, 1076, 0, 0, nothing},
      {"etopo5_global_4320x2161.tif", 4320, 2161, 9270, 9270, 0.01 * 9270, -10376, 7833, 0, 0,
       nothing},
      {"ahn_dsm_0p5m_963x840.tif", 963, 840, 0.5, 0.5, 0, -0.436f, 43.305f, 0, 42475, nothing},
      {"martini_fuji_terrainrgb.png", 512, 512, 10, 10, 0, 13.7f, 3751.0f, 0, 0, terrain_rgb},
      {"delatin_14-2625-6369_terrainrgb.png", 512, 512, 10, 10, 0, 19.0f, 251.8f, 0, 0,
       terrain_rgb},
      {"formats/yushan_2049_u16_decimetre.png", 2049, 2049, 20, 20, 0, 583, 3947, 0, 0, decimetres},
      {"formats/yushan_513_u16le_decimetre.r16", 513, 513, 20, 20, 0, 1319, 3947, 0, 0,
       raw_decimetres},
      {"formats/jacksboro_fault.asc", 403, 344, 74.5, 92.7, 0.5, 236, 1076, 0, 0, nothing},
      {"formats/srtm3_canberra_cog.tif", 1201, 1201, 75, 92.7, 1.0, 7, 1604, 0, 0, nothing},
      {"formats/bigtujunga_257.dem", 257, 258, 30, 30, 0, 748, 1992, 0, 257, nothing},
  };
  return files;
}

class KnownFiles : public testing::TestWithParam<KnownFile> {};

TEST_P(KnownFiles, LoadAsTheReadmeStates) {
  const KnownFile& known = GetParam();
  SKIP_WITHOUT(known.name);
  ReadOptions options;
  known.options(options);
  const Heightfield field = load_terrain(data(known.name), options);
  EXPECT_EQ(field.columns(), known.columns);
  EXPECT_EQ(field.rows(), known.rows);
  EXPECT_NEAR(field.dx_m, known.dx_m, known.spacing_tolerance_m);
  EXPECT_NEAR(field.dy_m, known.dy_m, known.spacing_tolerance_m);
  const Box box = bounds(field);
  EXPECT_NEAR(box.low.z, known.lowest, known.height_tolerance);
  EXPECT_NEAR(box.high.z, known.highest, known.height_tolerance);
  EXPECT_EQ(field.provenance.voids_declared, known.voids);
  EXPECT_EQ(field.provenance.voids_not_finite, 0);
  std::int64_t voids = 0;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) voids += field.is_void(i, j) ? 1 : 0;
  }
  EXPECT_EQ(voids, known.voids);
}

INSTANTIATE_TEST_SUITE_P(OfTheProject, KnownFiles, testing::ValuesIn(known_files()),
                         [](const auto& instance) {
                           std::string name;
                           for (const char c : std::string(instance.param.name)) {
                             name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                           }
                           return name;
                         });

TEST(KnownFilePairs, TheArcInfoGridEqualsItsSource) {
  SKIP_WITHOUT("formats/jacksboro_fault.asc");
  EXPECT_EQ(load_terrain(data("formats/jacksboro_fault.asc")).heights_m,
            load_terrain(data("jacksboro_fault_403x344.tif")).heights_m);
}

TEST(KnownFilePairs, TheCloudOptimisedFileEqualsItsSource) {
  SKIP_WITHOUT("formats/srtm3_canberra_cog.tif");
  const Heightfield cog = load_terrain(data("formats/srtm3_canberra_cog.tif"));
  EXPECT_EQ(checksum(cog), checksum(load_terrain(data("srtm3_canberra_S36E149.tif"))));
}

TEST(KnownFilePairs, TheUsgsFileEqualsItsSourceUnderARowOfVoids) {
  SKIP_WITHOUT("formats/bigtujunga_257.dem");
  const Heightfield dem = load_terrain(data("formats/bigtujunga_257.dem"));
  ReadOptions options;
  options.window = Window{300, 100, 257, 257};
  const Heightfield source = load_terrain(data("bigtujunga_30m.tif"), options);
  for (int i = 0; i < 257; ++i) ASSERT_TRUE(dem.is_void(i, 257));  // the file's first row
  for (int j = 0; j < 257; ++j) {
    for (int i = 0; i < 257; ++i) ASSERT_EQ(dem.heights_m(i, j), source.heights_m(i, j));
  }
}

TEST(KnownFilePairs, TheDecimetrePngEqualsItsSource) {
  SKIP_WITHOUT("formats/yushan_2049_u16_decimetre.png");
  ReadOptions png_options;
  decimetres(png_options);
  ReadOptions source_options;
  source_options.window = Window{2010, 4341, 2049, 2049};
  EXPECT_EQ(load_terrain(data("formats/yushan_2049_u16_decimetre.png"), png_options).heights_m,
            load_terrain(data("taiwan_central_8193.tif"), source_options).heights_m);
}

TEST(KnownFilePairs, TheRawFileEqualsItsSource) {
  SKIP_WITHOUT("formats/yushan_513_u16le_decimetre.r16");
  ReadOptions raw_options, png_options;
  raw_decimetres(raw_options);
  decimetres(png_options);
  png_options.window = Window{768, 768, 513, 513};
  EXPECT_EQ(load_terrain(data("formats/yushan_513_u16le_decimetre.r16"), raw_options).heights_m,
            load_terrain(data("formats/yushan_2049_u16_decimetre.png"), png_options).heights_m);
}

TEST(KnownFilePairs, TheWindowWithoutVoidsOfNarokHasNone) {
  SKIP_WITHOUT("narok_kenya_5840x4934.tif");
  ReadOptions options;
  options.window = Window{2736, 528, 2488, 2488};
  const Heightfield field = load_terrain(data("narok_kenya_5840x4934.tif"), options);
  EXPECT_EQ(field.provenance.voids_declared, 0);
  EXPECT_EQ(field.columns(), 2488);
}

// Row 728 from the top, columns 601 and 602.
TEST(KnownFilePairs, TheTwoVoidsOfLanzaroteLieWhereTheReadmeSays) {
  SKIP_WITHOUT("N29W014.hgt");
  const Heightfield field = load_terrain(data("N29W014.hgt"));
  EXPECT_TRUE(field.is_void(601, 1200 - 728));
  EXPECT_TRUE(field.is_void(602, 1200 - 728));
}

}  // namespace
}  // namespace plumb::terrain
