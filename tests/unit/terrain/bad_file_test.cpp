// Every kind of bad input ends in one line that names the file and says what was expected.
#include <fstream>

#include "written_files.h"

namespace plumb::terrain {
namespace {

class BadFile : public testing::Test {
 protected:
  std::string message_for(const std::string& argument, const ReadOptions& options = {}) {
    const std::string message = input_error_of([&] { load_terrain(argument, options); });
    EXPECT_NE(message.find(argument), std::string::npos) << message;
    return message;
  }
  void expect_says(const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
  std::string good_tiff(const std::string& name, int side = 64) {
    GeoTiff tiff;
    tiff.columns = tiff.rows = side;
    for (int k = 0; k < side * side; ++k) tiff.values.push_back(k % 251);
    const std::string file = folder_.file(name);
    write(file, tiff);
    return file;
  }
  void truncate(const std::string& file, double part) {
    std::filesystem::resize_file(
        file,
        static_cast<std::uintmax_t>(part * static_cast<double>(std::filesystem::file_size(file))));
  }
  TemporaryFolder folder_;
};

TEST_F(BadFile, Missing) {
  for (const char* name : {"none.tif", "none.png", "none.hgt", "none.r16", "none"}) {
    expect_says(message_for(folder_.file(name)), "there is no such file");
  }
  expect_says(input_error_of([] { load_terrain(""); }), "there is no such file");
}

TEST_F(BadFile, Empty) {
  for (const char* name : {"empty.tif", "empty.png", "N45E008.hgt", "empty.r32"}) {
    write_text(folder_.file(name), "");
    expect_says(message_for(folder_.file(name)), "empty");
  }
}

TEST_F(BadFile, Text) {
  for (const char* name : {"text.tif", "text.png", "text.asc", "text.dem", "text.txt"}) {
    write_text(folder_.file(name), "This is no terrain.\nIt has two lines.\n");
    message_for(folder_.file(name));
  }
}

TEST_F(BadFile, TruncatedTiff) {
  for (const double part : {0.99, 0.5, 0.02, 0.002}) {
    const std::string file = good_tiff("cut.tif");
    truncate(file, part);
    message_for(file);
  }
}

TEST_F(BadFile, TruncatedCompressedTiff) {
  GeoTiff tiff;
  tiff.columns = tiff.rows = 128;
  for (int k = 0; k < 128 * 128; ++k) tiff.values.push_back((k * 7919) % 1009);
  tiff.creation_options = {"COMPRESS=DEFLATE", "TILED=YES", "BLOCKXSIZE=32", "BLOCKYSIZE=32"};
  const std::string file = folder_.file("cut.tif");
  write(file, tiff);
  truncate(file, 0.6);
  expect_says(message_for(file), "GDAL");
}

TEST_F(BadFile, TruncatedHgt) {
  const std::string file = folder_.file("N45E008.hgt");
  write_bytes(file, std::vector<unsigned char>(1201 * 1201 * 2 - 10, 0));
  message_for(file);
}

TEST_F(BadFile, TruncatedArcInfoGrid) {
  const std::string file = folder_.file("cut.asc");
  write_text(file, "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 30\n1 2 3\n4 5");
  message_for(file);
}

TEST_F(BadFile, TruncatedPng) {
  std::vector<std::uint16_t> values;
  for (int k = 0; k < 128 * 128; ++k) values.push_back(static_cast<std::uint16_t>(k * 7919));
  ReadOptions options;
  options.spacing_x_m = 1.0;
  for (const double part : {0.7, 0.1, 0.001}) {
    const std::string file = folder_.file("cut.png");
    write_png16(file, 128, 128, values);
    truncate(file, part);
    message_for(file, options);
  }
}

TEST_F(BadFile, DamagedPng) {
  const std::string file = folder_.file("damaged.png");
  write_png16(file, 16, 16, std::vector<std::uint16_t>(256, 5));
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(file));
  for (const std::streamoff at : {std::streamoff{17}, size / 2, size - 13}) {
    write_png16(file, 16, 16, std::vector<std::uint16_t>(256, 5));
    std::fstream bytes(file, std::ios::binary | std::ios::in | std::ios::out);
    bytes.seekp(at).put('\x55');
    bytes.close();
    message_for(file);
  }
}

TEST_F(BadFile, TruncatedExr) {
  const std::string file = folder_.file("cut.exr");
  ReadOptions options;
  options.spacing_x_m = 1.0;
  for (const double part : {0.8, 0.01}) {
    std::vector<float> values;
    for (int k = 0; k < 64 * 64; ++k) values.push_back(static_cast<float>((k * 7919) % 1009));
    write_exr(file, 64, 64, values);
    truncate(file, part);
    message_for(file, options);
  }
}

TEST_F(BadFile, AFolder) {
  std::filesystem::create_directory(folder_.file("folder.png"));
  std::filesystem::create_directory(folder_.file("folder.tif"));
  message_for(folder_.file("folder.png"));
  message_for(folder_.file("folder.tif"));
}

TEST_F(BadFile, WindowsThatAreEmptyOrOutside) {
  const std::string file = good_tiff("good.tif");
  ReadOptions options;
  for (const Window& window : {Window{0, 0, 65, 1}, Window{64, 0, 1, 1}, Window{-1, 0, 2, 2},
                               Window{0, 60, 4, 5}, Window{2147483647, 0, 2147483647, 1}}) {
    options.window = window;
    expect_says(message_for(file, options), "does not lie inside its 64 columns and 64 rows");
  }
  for (const Window& window : {Window{0, 0, 0, 5}, Window{0, 0, 5, -1}}) {
    options.window = window;
    expect_says(message_for(file, options), "is empty");
  }
}

TEST_F(BadFile, ABandThatIsNotThere) {
  ReadOptions options;
  options.band = 2;
  expect_says(message_for(good_tiff("good.tif"), options), "there is no band 2, the file has 1");
}

TEST_F(BadFile, ColoursThatNothingIsSaidAbout) {
  GeoTiff tiff;
  tiff.type = "Byte";
  tiff.is_colour = true;
  tiff.values.assign(12, 7);
  write(folder_.file("colour.tif"), tiff);
  write_png8(folder_.file("colour.png"), 2, 2, 3, std::vector<std::uint8_t>(12, 7));
  write_png8(folder_.file("alpha.png"), 2, 2, 4, std::vector<std::uint8_t>(16, 7));
  for (const char* name : {"colour.tif", "colour.png", "alpha.png"}) {
    expect_says(message_for(folder_.file(name)), "grey|terrain-rgb|terrarium");
  }
}

TEST_F(BadFile, ColoursThatAreNone) {
  ReadOptions options;
  options.spacing_x_m = 1.0;
  options.decode = Decode::Terrarium;
  expect_says(message_for(good_tiff("grey.tif"), options), "terrarium needs three 8-bit bands");
  write_png8(folder_.file("grey.png"), 2, 2, 1, {1, 2, 3, 4});
  expect_says(message_for(folder_.file("grey.png"), options), "terrarium needs three 8-bit");
}

TEST_F(BadFile, ComplexNumbers) {
  GeoTiff tiff;
  tiff.type = "CFloat32";
  tiff.values = {1, 2, 3, 4};
  write(folder_.file("complex.tif"), tiff);
  expect_says(message_for(folder_.file("complex.tif")), "complex");
}

TEST_F(BadFile, NothingToFillFrom) {
  GeoTiff tiff;
  tiff.values = {5, 5, 5, 5};
  tiff.no_data = 5;
  write(folder_.file("void.tif"), tiff);
  ReadOptions options;
  options.no_data_policy = NoDataPolicy::Fill;
  expect_says(message_for(folder_.file("void.tif"), options), "every sample is void");
}

// 400,000 x 400,000 float32 samples are 640,000,000,000 bytes, those of 16 bits half of that; the
// file itself holds none of them.
TEST_F(BadFile, LargerThanMemory) {
  const std::string file = folder_.file("huge.vrt");
  write_text(file,
             "<VRTDataset rasterXSize=\"400000\" rasterYSize=\"400000\">"
             "<GeoTransform>0, 1, 0, 0, 0, -1</GeoTransform>"
             "<VRTRasterBand dataType=\"Float32\" band=\"1\"/></VRTDataset>");
  expect_says(message_for(file), "need 640000000000 bytes of memory, there are");
}

// The header's claim is all that is needed; checksum of "IHDR" and the 13 bytes by zlib.
TEST_F(BadFile, PngLargerThanMemory) {
  const std::string file = folder_.file("huge.png");
  write_png16(file, 16, 16, std::vector<std::uint16_t>(256, 5));
  // 400000 = 0x00061a80 columns and rows
  const std::vector<char> size{0, 6, 0x1a, '\x80', 0, 6, 0x1a, '\x80'};
  const std::vector<char> checksum{'\x10', '\x60', '\x11', '\xfc'};
  std::fstream bytes(file, std::ios::binary | std::ios::in | std::ios::out);
  bytes.seekp(16).write(size.data(), 8);
  bytes.seekp(29).write(checksum.data(), 4);
  bytes.close();
  expect_says(message_for(file), "need 320000000000 bytes of memory, there are");
}

TEST_F(BadFile, BareSamplesLargerThanMemory) {
  const std::string file = folder_.file("huge.r16");
  write_text(file, "12");
  std::error_code failed;
  std::filesystem::resize_file(file, std::uintmax_t{2} * 400000 * 400000, failed);
  if (failed) GTEST_SKIP() << "no file with a hole of 320 GB can be made here";
  ReadOptions options;
  options.spacing_x_m = 1.0;
  options.raw_size = RawSize{400000, 400000};
  expect_says(message_for(file, options), "need 320000000000 bytes of memory, there are");
}

TEST_F(BadFile, RawSizeOfAFileThatStatesItsOwn) {
  ReadOptions options;
  options.raw_size = RawSize{2, 2};
  expect_says(message_for(good_tiff("good.tif"), options), "--raw");
}

}  // namespace
}  // namespace plumb::terrain
