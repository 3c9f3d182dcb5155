#include "terrain/read_options.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/check.h"

namespace plumb::terrain {
namespace {

TEST(ReadOptionsText, Window) {
  EXPECT_EQ(parse_window("1,2,30,40"), (Window{1, 2, 30, 40}));
  for (const char* text : {"", "1,2,3", "1,2,3,4,5", "a,2,3,4", "-1,0,1,1", "0,0,0,1", "0,0,1,0",
                           "0,0,1,99999999999", "1, 2,3,4", "1.5,0,1,1"}) {
    EXPECT_THROW(parse_window(text), InputError) << text;
  }
}

TEST(ReadOptionsText, Spacing) {
  EXPECT_EQ(parse_spacing("2.5").x_m, 2.5);
  EXPECT_EQ(parse_spacing("2.5").y_m, 2.5);
  EXPECT_EQ(parse_spacing("2,3").x_m, 2.0);
  EXPECT_EQ(parse_spacing("2,3").y_m, 3.0);
  for (const char* text : {"", ",", "0", "-1", "1,0", "1,2,3", "inf", "nan", "5m"}) {
    EXPECT_THROW(parse_spacing(text), InputError) << text;
  }
}

TEST(ReadOptionsText, Origin) {
  EXPECT_EQ(parse_origin("8,46"), (TileOrigin{8.0, 46.0}));
  EXPECT_EQ(parse_origin("-70.5,-36"), (TileOrigin{-70.5, -36.0}));
  for (const char* text :
       {"", "8", "8,46,0", "181,0", "0,89.5", "0,-91", "nan,0", "0,inf", "E8,N46"}) {
    EXPECT_THROW(parse_origin(text), InputError) << text;
  }
}

TEST(ReadOptionsText, Words) {
  for (const Decode decode : {Decode::Grey, Decode::TerrainRgb, Decode::Terrarium}) {
    EXPECT_EQ(parse_decode(name_of(decode)), decode);
  }
  EXPECT_THROW(parse_decode("unspecified"), InputError);
  EXPECT_EQ(parse_no_data_policy("hole"), NoDataPolicy::Hole);
  EXPECT_EQ(parse_no_data_policy("fill"), NoDataPolicy::Fill);
  EXPECT_THROW(parse_no_data_policy("drop"), InputError);
  EXPECT_EQ(parse_byte_order("big"), ByteOrder::Big);
  EXPECT_THROW(parse_byte_order("middle"), InputError);
  EXPECT_EQ(parse_raw_size("5x7"), (RawSize{5, 7}));
  for (const char* text : {"", "5", "5x", "x7", "0x7", "5x-7", "5x7x9"}) {
    EXPECT_THROW(parse_raw_size(text), InputError) << text;
  }
}

TEST(ReadOptionsCheck, EveryOptionHasItsRange) {
  EXPECT_NO_THROW(check(ReadOptions{}));
  const auto refused = [](auto change) {
    ReadOptions options;
    change(options);
    EXPECT_THROW(check(options), InputError);
  };
  refused([](ReadOptions& o) { o.spacing_x_m = 0.0; });
  refused([](ReadOptions& o) { o.spacing_y_m = 1.0; });
  refused([](ReadOptions& o) { o.origin = TileOrigin{0.0, 90.0}; });
  refused([](ReadOptions& o) { o.band = 0; });
  refused([](ReadOptions& o) { o.height_scale = 0.0; });
  refused([](ReadOptions& o) { o.height_scale = std::numeric_limits<double>::quiet_NaN(); });
  refused([](ReadOptions& o) { o.height_offset_m = std::numeric_limits<double>::infinity(); });
}

}  // namespace
}  // namespace plumb::terrain
