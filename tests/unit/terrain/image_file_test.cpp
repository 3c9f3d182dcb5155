// Heights in images.
#include <cmath>

#include "written_files.h"

namespace plumb::terrain {
namespace {

ReadOptions ten_metres(Decode decode = Decode::Unspecified) {
  ReadOptions options;
  options.spacing_x_m = 10.0;
  options.decode = decode;
  return options;
}

class ImageFile : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string png_ = folder_.file("image.png");
};

TEST_F(ImageFile, SixteenBitsAreHeightsAsTheyAre) {
  write_png16(png_, 2, 2, {0, 1, 40000, 65535});
  const Heightfield field = load_terrain(png_, ten_metres());
  EXPECT_EQ(as_in_file(field), (std::vector<float>{0, 1, 40000, 65535}));
  EXPECT_EQ(field.heights_m(0, 0), 40000.0f);  // the file's last row is the southernmost
  EXPECT_EQ(field.dx_m, 10.0);
  EXPECT_EQ(field.dy_m, 10.0);
  EXPECT_EQ(field.provenance.format, "PNG");
}

TEST_F(ImageFile, EightBitsAreHeightsWithoutGamma) {
  std::vector<std::uint8_t> values;
  for (int k = 0; k < 256; ++k) values.push_back(static_cast<std::uint8_t>(k));
  write_png8(png_, 16, 16, 1, values);
  const std::vector<float> heights = as_in_file(load_terrain(png_, ten_metres()));
  for (std::size_t k = 0; k < 256; ++k) EXPECT_EQ(heights[k], static_cast<float>(k));
}

TEST_F(ImageFile, TerrainRgbIsDecoded) {
  // -10000 + 0.1 * (65536 R + 256 G + B)
  write_png8(png_, 2, 2, 3, {0, 0, 0, 1, 134, 160, 1, 134, 161, 255, 255, 255});
  const std::vector<float> heights = as_in_file(load_terrain(png_, ten_metres(Decode::TerrainRgb)));
  EXPECT_EQ(heights, (std::vector<float>{-10000.0f, 0.0f, 0.1f, 1667721.5f}));
}

TEST_F(ImageFile, TerrariumIsDecoded) {
  // 256 R + G + B / 256 - 32768
  write_png8(png_, 2, 2, 3, {128, 0, 0, 128, 0, 128, 139, 32, 64, 127, 255, 0});
  const std::vector<float> heights = as_in_file(load_terrain(png_, ten_metres(Decode::Terrarium)));
  EXPECT_EQ(heights, (std::vector<float>{0.0f, 0.5f, 2848.25f, -1.0f}));
}

TEST_F(ImageFile, AlphaDoesNotMultiplyColours) {
  write_png8(png_, 2, 1, 4, {1, 134, 161, 255, 1, 134, 161, 1});
  const std::vector<float> heights = as_in_file(load_terrain(png_, ten_metres(Decode::TerrainRgb)));
  EXPECT_EQ(heights, (std::vector<float>{0.1f, 0.1f}));
}

TEST_F(ImageFile, APixelOfNothingIsVoid) {
  write_png8(png_, 3, 1, 4, {0, 0, 0, 0, 0, 0, 0, 255, 1, 134, 160, 0});
  const Heightfield field = load_terrain(png_, ten_metres(Decode::TerrainRgb));
  EXPECT_TRUE(field.is_void(0, 0));
  EXPECT_EQ(field.heights_m(1, 0), -10000.0f);  // black but opaque: a height
  EXPECT_EQ(field.heights_m(2, 0), 0.0f);       // transparent but coloured: a height
  EXPECT_EQ(field.provenance.voids_declared, 1);
}

TEST_F(ImageFile, GreyTakesTheBandThatIsAskedFor) {
  write_png8(png_, 2, 1, 3, {1, 2, 3, 4, 5, 6});
  ReadOptions options = ten_metres(Decode::Grey);
  options.band = 3;
  const Heightfield field = load_terrain(png_, options);
  EXPECT_EQ(as_in_file(field), (std::vector<float>{3, 6}));
  EXPECT_TRUE(assumes(field, "channel 3 of 3"));
  options.band = 4;
  EXPECT_NE(input_error_of([&] { load_terrain(png_, options); }).find("no channel 4"),
            std::string::npos);
}

TEST_F(ImageFile, AWindowIsCountedFromTheTopLeft) {
  write_png16(png_, 3, 3, {0, 1, 2, 3, 4, 5, 6, 7, 8});
  ReadOptions options = ten_metres();
  options.window = Window{1, 1, 2, 2};
  const Heightfield field = load_terrain(png_, options);
  EXPECT_EQ(as_in_file(field), (std::vector<float>{4, 5, 7, 8}));
  EXPECT_EQ(field.provenance.file_columns, 3);
  EXPECT_EQ(field.provenance.window_y, 1);
}

TEST_F(ImageFile, ScaleOffsetAndNoDataOfTheUserApply) {
  write_png16(png_, 2, 2, {0, 10, 20, 30});
  ReadOptions options = ten_metres();
  options.height_scale = 0.1;
  options.height_offset_m = 100.0;
  options.no_data = 0.0;
  const Heightfield field = load_terrain(png_, options);
  EXPECT_TRUE(field.is_void(0, 1));
  EXPECT_EQ(field.heights_m(1, 1), 101.0f);
  EXPECT_EQ(field.provenance.voids_declared, 1);
}

TEST_F(ImageFile, WithoutASpacingTheErrorAsksForOne) {
  write_png16(png_, 1, 1, {5});
  EXPECT_NE(input_error_of([&] { load_terrain(png_); }).find("--spacing"), std::string::npos);
  ReadOptions options;
  options.require_spacing = false;
  EXPECT_TRUE(assumes(load_terrain(png_, options), "1 m was assumed"));
}

TEST_F(ImageFile, OpenExrHoldsFloats) {
  const std::string exr = folder_.file("image.exr");
  write_exr(exr, 2, 1, {-0.125f, std::numeric_limits<float>::quiet_NaN()});
  const Heightfield field = load_terrain(exr, ten_metres());
  EXPECT_EQ(field.heights_m(0, 0), -0.125f);
  EXPECT_TRUE(field.is_void(1, 0));
  EXPECT_EQ(field.provenance.voids_not_finite, 1);
}

}  // namespace
}  // namespace plumb::terrain
