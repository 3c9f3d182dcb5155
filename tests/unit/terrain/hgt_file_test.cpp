// SRTM tiles under names that do not say where they lie.
#include <bit>

#include "written_files.h"

namespace plumb::terrain {
namespace {

// 1201 x 1201 samples: every 16-bit value, and voids in between.
std::vector<unsigned char> tile_bytes() {
  std::vector<unsigned char> bytes;
  bytes.reserve(2 * 1201 * 1201);
  for (std::uint32_t k = 0; k < 1201 * 1201; ++k) {
    const std::uint32_t value = k % 97 == 0 ? 0x8000u : k * 40503u;
    bytes.push_back(static_cast<unsigned char>(value >> 8));
    bytes.push_back(static_cast<unsigned char>(value));
  }
  return bytes;
}

ReadOptions at(double longitude_deg, double latitude_deg) {
  ReadOptions options;
  options.origin = TileOrigin{longitude_deg, latitude_deg};
  return options;
}

class HgtFile : public testing::Test {
 protected:
  static void SetUpTestSuite() { bytes_ = new std::vector<unsigned char>(tile_bytes()); }
  static void TearDownTestSuite() { delete bytes_; }
  std::string tile(const std::string& name) {
    const std::string file = folder_.file(name);
    write_bytes(file, *bytes_);
    return file;
  }
  std::string refusal(const std::string& file, const ReadOptions& options = {}) {
    return input_error_of([&] { load_terrain(file, options); });
  }
  void expect_says(const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
  TemporaryFolder folder_;
  static std::vector<unsigned char>* bytes_;
};
std::vector<unsigned char>* HgtFile::bytes_ = nullptr;

void expect_same_terrain(const Heightfield& named, const Heightfield& unnamed) {
  EXPECT_EQ(checksum(named), checksum(unnamed));  // size, spacing, origin, heights, voids
  EXPECT_EQ(std::bit_cast<std::uint64_t>(named.dx_m), std::bit_cast<std::uint64_t>(unnamed.dx_m));
  EXPECT_EQ(std::bit_cast<std::uint64_t>(named.dy_m), std::bit_cast<std::uint64_t>(unnamed.dy_m));
  EXPECT_EQ(named.provenance.voids_declared, unnamed.provenance.voids_declared);
  EXPECT_EQ(named.provenance.crs, unnamed.provenance.crs);
  EXPECT_EQ(named.provenance.format, unnamed.provenance.format);
  EXPECT_EQ(named.provenance.file_columns, unnamed.provenance.file_columns);
}

TEST_F(HgtFile, IsTheSameTerrainUnderAnyName) {
  const Heightfield alps = load_terrain(tile("N46E008.hgt"));
  EXPECT_GE(alps.provenance.voids_declared, (1201 * 1201 + 96) / 97);
  for (const char* name : {"tile.hgt", "alps 2000.HGT", "N46E008 (1).hgt", "tile.bin", "tile"}) {
    expect_same_terrain(alps, load_terrain(tile(name), at(8, 46)));
  }
  expect_same_terrain(load_terrain(tile("S36W070.hgt")),
                      load_terrain(tile("andes.hgt"), at(-70, -36)));
}

TEST_F(HgtFile, HasTheSameWindowsUnderAnyName) {
  for (const Window& window : {Window{0, 0, 1201, 1}, Window{17, 600, 333, 601}}) {
    ReadOptions named, unnamed = at(8, 46);
    named.window = unnamed.window = window;
    expect_same_terrain(load_terrain(tile("N46E008.hgt"), named),
                        load_terrain(tile("tile.hgt"), unnamed));
  }
}

TEST_F(HgtFile, SaysWhoseOriginItIs) {
  const Heightfield field = load_terrain(tile("tile.hgt"), at(8, 46.5));
  EXPECT_TRUE(assumes(field, "longitude 8, latitude 46.5 degrees: the user's origin"));
  EXPECT_TRUE(assumes(field, "touches the earth at the centre (latitude 47.0000)"));
}

// A tile of one second; the values are its rows, from the north.
TEST_F(HgtFile, OfOneSecondIsReadToo) {
  const std::string file = folder_.file("fine.hgt");
  {
    std::vector<unsigned char> bytes(std::size_t{2} * 3601 * 3601, 0);
    bytes[1] = 7;
    write_bytes(file, bytes);
  }
  const Heightfield field = load_terrain(file, at(0, 0));
  EXPECT_EQ(field.columns(), 3601);
  EXPECT_EQ(field.rows(), 3601);
  EXPECT_EQ(field.heights_m(0, 3600), 7.0f);
  EXPECT_EQ(field.heights_m(0, 0), 0.0f);
}

TEST_F(HgtFile, WithoutAPlaceAsksForIt) {
  for (const char* name : {"tile.hgt", "tile.bin"}) {
    expect_says(refusal(tile(name)), "give its south-west sample with --origin LON,LAT");
  }
}

TEST_F(HgtFile, OfAnotherSizeIsRefused) {
  const std::string file = tile("tile.hgt");
  std::filesystem::resize_file(file, 2 * 1201 * 1201 - 2);
  for (const ReadOptions& options : {ReadOptions{}, at(8, 46)}) {
    expect_says(refusal(file, options), "2884802 bytes (1201 x 1201 samples) or 25934402");
    expect_says(refusal(file, options), "this one has 2884800");
  }
}

TEST_F(HgtFile, AnOriginOfAnythingElseIsRefused) {
  GeoTiff tiff;
  tiff.values = {1, 2, 3, 4};
  write(folder_.file("a.tif"), tiff);
  write_png16(folder_.file("a.png"), 2, 2, {1, 2, 3, 4});
  for (const std::string& file :
       {folder_.file("a.tif"), folder_.file("a.png"), tile("N46E008.hgt")}) {
    expect_says(refusal(file, at(8, 46)),
                "--origin is for .hgt files whose name does not state it");
  }
  expect_says(refusal("generate:plane", at(8, 46)), "--origin");
}

}  // namespace
}  // namespace plumb::terrain
