// Heightfields into GeoTIFF files and out of them again.
#include "terrain/geotiff_writer.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "support/random_scene.h"
#include "written_files.h"

namespace plumb::terrain {
namespace {

namespace fs = std::filesystem;
using test_support::Random;

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Zero has one sign in a heightfield that was read; all other bits are the same.
bool same_heights(const Heightfield& a, const Heightfield& b) {
  if (a.columns() != b.columns() || a.rows() != b.rows()) return false;
  for (int j = 0; j < a.rows(); ++j) {
    for (int i = 0; i < a.columns(); ++i) {
      const float x = a.heights_m(i, j), y = b.heights_m(i, j);
      if (std::isnan(x) ? !std::isnan(y) : x != y) return false;
    }
  }
  return true;
}

void expect_same(const Heightfield& written, const Heightfield& read) {
  EXPECT_TRUE(same_heights(written, read));
  EXPECT_EQ(written.dx_m, read.dx_m);
  EXPECT_EQ(written.dy_m, read.dy_m);
  EXPECT_EQ(written.origin_m, read.origin_m);
  EXPECT_EQ(system_of_coordinates(written.provenance), system_of_coordinates(read.provenance));
}

Heightfield through_a_file(const Heightfield& field, const GeotiffOptions& options = {}) {
  const TemporaryFolder folder;
  write_geotiff(folder.file("t.tif"), field, options);
  return load_terrain(folder.file("t.tif"), {});
}

// 3 x 2 samples.
void write_source(const std::string& path, const std::array<double, 6>& transform,
                  const std::string& crs) {
  GeoTiff tiff;
  tiff.columns = 3;
  tiff.values = {1.5, 2, 3, 4, 5, 6.25};
  tiff.transform = transform;
  tiff.crs = crs;
  write(path, tiff);
}

// More than a tile across and up, and no whole number of them.
TEST(GeotiffWriter, KeepsAGeneratedTerrain) {
  for (const char* terrain :
       {"generate:canyon?size=300&seed=5&voids=0.2", "generate:urban?size=257&utm=1",
        "generate:dunes?size=20&spacing=7"}) {
    const Heightfield field = load_terrain(terrain, {});
    expect_same(field, through_a_file(field));
    expect_same(field, through_a_file(field, {.compression = GeotiffCompression::Zstd}));
  }
}

TEST(GeotiffWriter, KeepsRandomTerrains) {
  Random random(7);
  for (int k = 0; k < 50; ++k) {
    const Heightfield field = test_support::random_heightfield(random);
    const Heightfield read = through_a_file(field);
    EXPECT_TRUE(same_heights(field, read));
    EXPECT_EQ(field.dx_m, read.dx_m);
    EXPECT_EQ(field.dy_m, read.dy_m);
    // Half an ulp of the corner, which is no farther off than the origin and the extent together.
    for (int axis = 0; axis < 2; ++axis) {
      const double most = std::abs(field.origin_m[axis]) + 34 * 61.0;
      EXPECT_LE(std::abs(field.origin_m[axis] - read.origin_m[axis]), 0x1p-53 * 2.0 * most);
    }
  }
}

// A file of pixels 30 m wide whose corner is (500000, 4200060): samples at their centres.
TEST(GeotiffWriter, PutsSamplesAtThePixelsCentres) {
  Heightfield field;
  field.heights_m = Grid<float>(2, 2);
  field.heights_m.floats().values() = {1, 2, 3, 4};  // from the south-west
  field.dx_m = field.dy_m = 30.0;
  field.origin_m = {500015.0, 4200015.0};
  field.provenance.crs = "EPSG:32611";
  const TemporaryFolder folder;
  write_geotiff(folder.file("t.tif"), field, {.description = "four samples"});
  GDALDataset* file = GDALDataset::Open(folder.file("t.tif").c_str());
  ASSERT_NE(file, nullptr);
  double t[6];
  file->GetGeoTransform(t);
  EXPECT_EQ((std::vector<double>(t, t + 6)), (std::vector<double>{500000, 30, 0, 4200060, 0, -30}));
  float north_west = 0.0f;
  EXPECT_EQ(file->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, 1, 1, &north_west, 1, 1, GDT_Float32, 0,
                                             0, nullptr),
            CE_None);
  EXPECT_EQ(north_west, 3.0f);
  EXPECT_TRUE(std::isnan(file->GetRasterBand(1)->GetNoDataValue()));
  EXPECT_STREQ(file->GetMetadataItem("TIFFTAG_IMAGEDESCRIPTION"), "four samples");
  EXPECT_STREQ(file->GetMetadataItem("AREA_OR_POINT"), "Area");
  GDALClose(file);
  expect_same(field, load_terrain(folder.file("t.tif"), {}));
}

// What was read from a file is where it was, also in feet, whatever the last digits: there is a
// corner that gives the same bits, that of the file.
TEST(GeotiffWriter, KeepsThePlaceOfAFile) {
  const TemporaryFolder folder;
  Random random(11);
  for (const char* crs : {"EPSG:2056", "EPSG:32611", "EPSG:2225", "EPSG:31467"}) {
    for (int k = 0; k < 25; ++k) {
      const std::string path = folder.file("source.tif");
      write_source(path,
                   {random.uniform(2e5, 8e6), random.uniform(0.1, 90.0), 0,
                    random.uniform(1e6, 9e6), 0, random.uniform(-90.0, -0.1)},
                   crs);
      const Heightfield field = load_terrain(path, {});
      EXPECT_EQ(field.provenance.crs, crs);
      expect_same(field, through_a_file(field));
    }
  }
}

// Degrees became metres on a plane whose origin is the south-west sample: that is what is written,
// under a name that says so, and the name stays.
TEST(GeotiffWriter, StatesALocalFrameForWhatWasLaidOutFlat) {
  const TemporaryFolder folder;
  for (const std::string crs : {"EPSG:4326", "EPSG:3857"}) {
    const std::string path = folder.file("source.tif");
    if (crs == "EPSG:4326") {
      write_source(path, {8.0, 0.001, 0, 47.0, 0, -0.001}, crs);
    } else {
      write_source(path, {930000, 30, 0, 5900000, 0, -30}, crs);
    }
    const Heightfield field = load_terrain(path, {});
    EXPECT_TRUE(field.provenance.is_local);
    const Heightfield read = through_a_file(field);
    expect_same(field, read);
    EXPECT_EQ(read.provenance.crs, fmt::format("local metres ({} laid out flat)", crs));
    EXPECT_FALSE(read.provenance.is_local);
    expect_same(read, through_a_file(read));
  }
}

// With a spacing of the user's the origin is the south-west sample, no place of the file's system.
TEST(GeotiffWriter, StatesALocalFrameForTheUsersSpacing) {
  const TemporaryFolder folder;
  write_source(folder.file("source.tif"), {2600000, 2, 0, 1200000, 0, -2}, "EPSG:2056");
  ReadOptions with_spacing;
  with_spacing.spacing_x_m = 5.0;
  const Heightfield field = load_terrain(folder.file("source.tif"), with_spacing);
  const Heightfield read = through_a_file(field);
  expect_same(field, read);
  EXPECT_EQ(read.provenance.crs, "local metres (EPSG:2056 laid out flat)");
}

// A name that no authority gave is kept as a name; nothing is opened or fetched for it.
TEST(GeotiffWriter, KeepsNamesThatItDoesNotKnow) {
  Heightfield field;
  field.heights_m = Grid<float>(3, 3, 1.0f);
  for (const char* crs : {"NAD83 / somewhere", "NOBODY:12", "EPSG:99999999", "/etc/passwd",
                          "http://localhost/crs", "local metres"}) {
    field.provenance.crs = crs;
    expect_same(field, through_a_file(field));
  }
}

// Samples a centimetre apart, in no system, are no degrees.
TEST(GeotiffWriter, KeepsASmallSpacingInMetres) {
  Heightfield field;
  field.heights_m = Grid<float>(3, 3, 1.0f);
  field.dx_m = field.dy_m = 0.01;
  const Heightfield read = through_a_file(field);
  EXPECT_EQ(read.dx_m, 0.01);
  EXPECT_EQ(read.provenance.crs, "local metres");
  field.dx_m = field.dy_m = 0.02;
  expect_same(field, through_a_file(field));
}

TEST(GeotiffWriter, KeepsOneRowAndExtremeHeights) {
  Heightfield field;
  field.heights_m = Grid<float>(5, 1);
  constexpr float kMost = std::numeric_limits<float>::max();
  field.heights_m.floats().values() = {-0.0f, kMost, -kMost, 1e-45f, kVoid};
  expect_same(field, through_a_file(field));
}

TEST(GeotiffWriter, HoldsWholeMetresAsWholeNumbers) {
  Heightfield field;
  field.heights_m = Grid<float>(3, 1);
  field.heights_m.floats().values() = {0.0f, kVoid, 32767.0f};
  expect_same(field, through_a_file(field, {.samples = GeotiffSamples::Int16}));
  expect_same(field, through_a_file(field, {.samples = GeotiffSamples::Uint16}));
  field.heights_m.floats().values() = {-32767.0f, kVoid, 5.0f};
  expect_same(field, through_a_file(field, {.samples = GeotiffSamples::Int16}));
  const TemporaryFolder folder;
  for (const float wrong : {0.5f, -32768.0f, 40000.0f}) {
    field.heights_m.floats()(0, 0) = wrong;
    const std::string line = input_error_of(
        [&] { write_geotiff(folder.file("t.tif"), field, {.samples = GeotiffSamples::Int16}); });
    EXPECT_NE(line.find("int16 holds whole metres from -32767 to 32767"), std::string::npos)
        << line;
  }
  EXPECT_FALSE(fs::exists(folder.file("t.tif")));
}

TEST(GeotiffWriter, WritesTheSameBytesAndNothingBeside) {
  const Heightfield field = load_terrain("generate:canyon?size=600&seed=5&voids=0.2", {});
  const TemporaryFolder folder;
  write_geotiff(folder.file("a.tif"), field);
  write_geotiff(folder.file("b.tif"), field);
  EXPECT_EQ(bytes_of(folder.file("a.tif")), bytes_of(folder.file("b.tif")));
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(folder.file("a.tif")).parent_path()))
    files += entry.exists() ? 1 : 0;
  EXPECT_EQ(files, 2u);
}

TEST(GeotiffWriter, TellsAFolderThatIsNotThere) {
  const Heightfield field = load_terrain("generate:plane?size=9", {});
  const std::string line = input_error_of([&] { write_geotiff("/no/such/t.tif", field); });
  EXPECT_NE(line.find("'/no/such/t.tif'"), std::string::npos) << line;
}

}  // namespace
}  // namespace plumb::terrain
