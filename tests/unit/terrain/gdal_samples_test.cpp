// What files that GDAL reads store, and what heights it becomes.
#include <cmath>
#include <limits>

#include "written_files.h"

namespace plumb::terrain {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Heightfield reload(const GeoTiff& tiff, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  const std::string file = folder.file("terrain.tif");
  write(file, tiff);
  return load_terrain(file, options);
}

struct SampleType {
  const char* name;
  std::vector<double> values;  // the type's ends among them, where float32 holds them
};

class EverySampleType : public testing::TestWithParam<SampleType> {};

TEST_P(EverySampleType, GivesItsValuesAsHeights) {
  GeoTiff tiff;
  tiff.type = GetParam().name;
  tiff.values = GetParam().values;
  const Heightfield field = reload(tiff);
  const std::vector<float> heights = as_in_file(field);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(heights[k], static_cast<float>(tiff.values[k])) << tiff.type << " sample " << k;
  }
  const bool sixteen = tiff.type == "Byte" || tiff.type == "UInt16" || tiff.type == "Int16";
  EXPECT_EQ(field.heights_m.is_coded(), sixteen);
  EXPECT_EQ(field.provenance.largest_rounding_m, 0.0);
  EXPECT_EQ(field.provenance.voids_declared + field.provenance.voids_not_finite, 0);
  EXPECT_EQ(field.provenance.format, "GTiff");
}

INSTANTIATE_TEST_SUITE_P(
    OfGdal, EverySampleType,
    testing::Values(SampleType{"Byte", {0, 1, 200, 255}},
                    SampleType{"UInt16", {0, 1, 40000, 65535}},
                    SampleType{"Int16", {-32768, -1, 7, 32767}},
                    SampleType{"UInt32", {0, 16777216, 5, 4294967040.0}},
                    SampleType{"Int32", {-2147483648.0, -16777215, 5, 16777216}},
                    SampleType{"Int64", {-9007199254740992.0, -1, 5, 9007199254740992.0}},
                    SampleType{"UInt64", {0, 1, 5, 9007199254740992.0}},
                    SampleType{"Float32", {-0.5, 0.25, 1e-3f, 8848.86f}},
                    SampleType{"Float64", {-0.5, 0.25, 1024.125, 8848.0}}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(GdalSamples, RowZeroInMemoryIsTheSouthernmostOfTheFile) {
  GeoTiff tiff;
  tiff.columns = 2;
  tiff.rows = 3;
  tiff.values = {1, 2, 3, 4, 5, 6};
  const Heightfield field = reload(tiff);
  EXPECT_EQ(field.heights_m(0, 2), 1.0f);
  EXPECT_EQ(field.heights_m(1, 2), 2.0f);
  EXPECT_EQ(field.heights_m(0, 0), 5.0f);
  EXPECT_EQ(field.heights_m(1, 0), 6.0f);
}

TEST(GdalSamples, ScaleAndOffsetOfTheBandAreApplied) {
  GeoTiff tiff;
  tiff.type = "Int16";
  tiff.values = {0, 100, -100, 32767};
  tiff.scale = 0.5;
  tiff.offset = 1000.0;
  const Heightfield field = reload(tiff);
  EXPECT_EQ(as_in_file(field), (std::vector<float>{1000.0f, 1050.0f, 950.0f, 17383.5f}));
  EXPECT_EQ(field.provenance.height_scale, 0.5);
  EXPECT_EQ(field.provenance.height_offset_m, 1000.0);
}

TEST(GdalSamples, ScaleAndOffsetOfTheUserComeOnTopOfTheFilesOwn) {
  GeoTiff tiff;
  tiff.values = {0, 1, 2, 3};
  tiff.scale = 0.5;
  tiff.offset = 10.0;
  ReadOptions options;
  options.height_scale = 4.0;
  options.height_offset_m = -1.0;
  const Heightfield field = reload(tiff, options);  // 4 * (v / 2 + 10) - 1
  EXPECT_EQ(as_in_file(field), (std::vector<float>{39.0f, 41.0f, 43.0f, 45.0f}));
}

TEST(GdalSamples, FeetBecomeMetres) {
  GeoTiff tiff;
  tiff.values = {0, 1000, 2000, 10000};
  tiff.unit = "ft";
  const Heightfield field = reload(tiff);
  EXPECT_EQ(as_in_file(field), (std::vector<float>{0.0f, 304.8f, 609.6f, 3048.0f}));
  EXPECT_TRUE(assumes(field, "units of 0.3048 m"));
}

TEST(GdalSamples, FeetOfTheVerticalCoordinateSystemBecomeMetres) {
  GeoTiff tiff;
  tiff.values = {0, 3937, 7874, 393.7};
  tiff.crs = "EPSG:26911+6360";  // UTM 11N with NAVD88 height in US survey feet
  const Heightfield field = reload(tiff);
  // 3937 US survey feet are 1200 m by definition.
  EXPECT_FLOAT_EQ(as_in_file(field)[1], 1200.0f);
  EXPECT_FLOAT_EQ(as_in_file(field)[3], 120.0f);
}

TEST(GdalSamples, AnUnknownUnitIsTakenAsMetresAndSaid) {
  GeoTiff tiff;
  tiff.values = {0, 1, 2, 3};
  tiff.unit = "cubits";
  const Heightfield field = reload(tiff);
  EXPECT_EQ(as_in_file(field)[3], 3.0f);
  EXPECT_TRUE(assumes(field, "cubits"));
}

TEST(GdalSamples, TheDeclaredNoDataValueIsVoid) {
  GeoTiff tiff;
  tiff.type = "Int16";
  tiff.values = {-32768, 5, 6, -32768};
  tiff.no_data = -32768;
  const Heightfield field = reload(tiff);
  EXPECT_TRUE(field.is_void(0, 1));
  EXPECT_TRUE(field.is_void(1, 0));
  EXPECT_EQ(field.provenance.voids_declared, 2);
  EXPECT_EQ(field.provenance.voids_not_finite, 0);
}

TEST(GdalSamples, NoDataIsComparedWithWhatIsStoredNotWithTheHeight) {
  GeoTiff tiff;
  tiff.type = "Int16";
  tiff.values = {0, 1, 2, 3};
  tiff.no_data = 2;
  tiff.scale = 2.0;
  const Heightfield field = reload(tiff);  // the height 2 is stored as 1
  EXPECT_EQ(as_in_file(field)[1], 2.0f);
  EXPECT_TRUE(field.is_void(0, 0));
  EXPECT_EQ(field.provenance.voids_declared, 1);
}

TEST(GdalSamples, ANoDataValueThatFloat32RoundsIsRecognised) {
  GeoTiff tiff;
  tiff.values = {static_cast<double>(0.1f), 1, 2, 3};
  tiff.no_data = 0.1;
  EXPECT_EQ(reload(tiff).provenance.voids_declared, 1);
  tiff.no_data.reset();
  ReadOptions options;
  options.no_data = 0.1;
  EXPECT_EQ(reload(tiff, options).provenance.voids_declared, 1);
}

TEST(GdalSamples, TheUsersNoDataValueIsVoidBesidesTheFilesOwn) {
  GeoTiff tiff;
  tiff.type = "Int16";
  tiff.values = {-32768, 0, 6, 7};
  tiff.no_data = -32768;
  ReadOptions options;
  options.no_data = 0.0;
  EXPECT_EQ(reload(tiff, options).provenance.voids_declared, 2);
}

TEST(GdalSamples, NanAndInfinityAreVoidAndCountedApart) {
  GeoTiff tiff;
  tiff.values = {kNaN, std::numeric_limits<double>::infinity(), 3, -9999};
  tiff.no_data = -9999;
  const Heightfield field = reload(tiff);
  EXPECT_EQ(field.provenance.voids_not_finite, 2);
  EXPECT_EQ(field.provenance.voids_declared, 1);
  EXPECT_EQ(as_in_file(field)[2], 3.0f);
}

TEST(GdalSamples, ADeclaredNanIsDeclaredNoData) {
  GeoTiff tiff;
  tiff.values = {kNaN, 1, 2, 3};
  tiff.no_data = kNaN;
  const Heightfield field = reload(tiff);
  EXPECT_EQ(field.provenance.voids_declared, 1);
  EXPECT_EQ(field.provenance.voids_not_finite, 0);
}

TEST(GdalSamples, TheMaskOfTheFileHidesSamples) {
  GeoTiff tiff;
  tiff.values = {1, 2, 3, 4};
  tiff.mask = {255, 0, 255, 255};
  const Heightfield field = reload(tiff);
  EXPECT_TRUE(field.is_void(1, 1));
  EXPECT_EQ(field.provenance.voids_declared, 1);
}

TEST(GdalSamples, TheLargestRoundingToFloat32IsReported) {
  GeoTiff tiff;
  tiff.type = "Int32";
  tiff.values = {0, 1, 2, 16777217};  // 2^24 + 1 lies between two floats, one away from each
  EXPECT_EQ(reload(tiff).provenance.largest_rounding_m, 1.0);
  tiff.type = "Float64";
  tiff.values = {0, 1, 2, 1024.0 + 0x1p-15};  // floats near 1024 are 2^-13 apart
  EXPECT_EQ(reload(tiff).provenance.largest_rounding_m, 0x1p-15);
}

TEST(GdalSamples, BandsAreCountedFromOne) {
  GeoTiff tiff;
  tiff.values = {1, 2, 3, 4, 10, 20, 30, 40};
  ReadOptions options;
  options.band = 2;
  EXPECT_EQ(as_in_file(reload(tiff, options)), (std::vector<float>{10, 20, 30, 40}));
}

TEST(GdalSamples, ColoursAreDecodedWhenTold) {
  GeoTiff tiff;
  tiff.type = "Byte";
  tiff.is_colour = true;
  // 1 134 160 is 100000: 0 m; 1 134 161 is 0.1 m; red, then green, then blue
  tiff.values = {1, 1, 0, 2, 134, 134, 0, 0, 160, 161, 0, 0};
  ReadOptions options;
  options.decode = Decode::TerrainRgb;
  const std::vector<float> heights = as_in_file(reload(tiff, options));
  EXPECT_EQ(heights, (std::vector<float>{0.0f, 0.1f, -10000.0f, 3107.2f}));
}

TEST(GdalSamples, HeightsThatNoPlaceOnEarthHasAreSaid) {
  GeoTiff tiff;
  tiff.type = "Int16";
  tiff.values = {-32768, 1, 2, 3};
  const Heightfield field = reload(tiff);
  EXPECT_FALSE(field.is_void(0, 1));
  EXPECT_TRUE(assumes(field, "1 samples lie below -12000 m"));
}

TEST(GdalSamples, TheFillPolicyFillsAndSaysHow) {
  GeoTiff tiff;
  tiff.columns = 3;
  tiff.rows = 1;
  tiff.values = {4, -1, 9};
  tiff.no_data = -1;
  ReadOptions options;
  options.no_data_policy = NoDataPolicy::Fill;
  const Heightfield field = reload(tiff, options);
  EXPECT_EQ(as_in_file(field), (std::vector<float>{4, 4, 9}));  // equally far: the western one
  EXPECT_EQ(field.provenance.voids_declared, 1);
  EXPECT_TRUE(assumes(field, "1 void samples were filled"));
}

TEST(GdalSamples, TiledAndCompressedFilesReadAsPlainOnes) {
  GeoTiff tiff;
  tiff.columns = 70;
  tiff.rows = 50;
  for (int k = 0; k < 3500; ++k) tiff.values.push_back(k % 97);
  const std::vector<float> plain = as_in_file(reload(tiff));
  tiff.creation_options = {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=32", "COMPRESS=DEFLATE"};
  EXPECT_EQ(as_in_file(reload(tiff)), plain);
}

}  // namespace
}  // namespace plumb::terrain
