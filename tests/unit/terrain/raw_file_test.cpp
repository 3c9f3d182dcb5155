// Files of bare samples.
#include "written_files.h"

namespace plumb::terrain {
namespace {

ReadOptions raw(int columns, int rows, ByteOrder order = ByteOrder::Little) {
  ReadOptions options;
  options.spacing_x_m = 1.0;
  options.raw_size = RawSize{columns, rows};
  options.byte_order = order;
  return options;
}

class RawFile : public testing::Test {
 protected:
  void SetUp() override {
    write_bytes(r16_, {0x01, 0x02, 0x03, 0x04, 0xff, 0xff, 0x00, 0x00});
    write_bytes(r32_, {0x00, 0x00, 0xc0, 0x3f});  // 1.5
  }
  std::string refusal(const std::string& file, const ReadOptions& options) {
    return input_error_of([&] { load_terrain(file, options); });
  }
  TemporaryFolder folder_;
  std::string r16_ = folder_.file("a.r16"), r32_ = folder_.file("a.r32");
};

TEST_F(RawFile, BytesAreReadInTheirOrder) {
  EXPECT_EQ(as_in_file(load_terrain(r16_, raw(2, 2))),
            (std::vector<float>{0x0201, 0x0403, 65535, 0}));
  EXPECT_EQ(as_in_file(load_terrain(r16_, raw(2, 2, ByteOrder::Big))),
            (std::vector<float>{0x0102, 0x0304, 65535, 0}));
  EXPECT_EQ(as_in_file(load_terrain(r32_, raw(1, 1))), (std::vector<float>{1.5f}));
}

TEST_F(RawFile, AWindowIsPartOfTheFile) {
  ReadOptions options = raw(2, 2);
  options.window = Window{1, 0, 1, 2};
  EXPECT_EQ(as_in_file(load_terrain(r16_, options)), (std::vector<float>{0x0403, 0}));
}

TEST_F(RawFile, ASizeThatIsMissingOrWrongIsSaid) {
  ReadOptions options = raw(3, 3);
  EXPECT_NE(refusal(r16_, options).find("18 bytes, the file has 8 (2x2 would fit)"),
            std::string::npos);
  options.raw_size.reset();
  EXPECT_NE(refusal(r16_, options).find("--raw WIDTHxHEIGHT (2x2 would fit)"), std::string::npos);
}

}  // namespace
}  // namespace plumb::terrain
