// Depth buffers in the files that people have.
#include "image/depth_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/check.h"
#include "image/image_files.h"

namespace plumb::image {
namespace {

namespace fs = std::filesystem;

class DepthFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("plumb_depth_file_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string file(const std::string& name, const std::string& bytes) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  fs::path folder_;
};

std::string bytes_of(std::initializer_list<float> values, bool big) {
  std::string bytes;
  for (const float value : values) {
    const auto word = std::bit_cast<std::uint32_t>(value);
    for (int b = 0; b < 4; ++b)
      bytes += static_cast<char>((word >> (8 * (big ? 3 - b : b))) & 0xffu);
  }
  return bytes;
}

const std::vector<float> kRows{1.0f, 2.5f, 3.0f, 4.0f, 5.0f, 6.0f};

template <class Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(DepthFile, ReadsPfmFromTheTop) {
  for (const bool big : {false, true}) {
    const std::string head = std::string("Pf\n3 2\n") + (big ? "1.0\n" : "-1.0\n");
    const std::string path =
        file("a.pfm", head + bytes_of({4.0f, 5.0f, 6.0f, 1.0f, 2.5f, 3.0f}, big));
    const DepthBuffer buffer = read_depth(path);
    EXPECT_EQ(buffer.width_px, 3);
    EXPECT_EQ(buffer.height_px, 2);
    EXPECT_EQ(buffer.values, kRows);
    EXPECT_EQ(buffer.format, NumberFormat{});
  }
}

TEST_F(DepthFile, RefusesBrokenPfm) {
  for (const std::string& bytes :
       {std::string("Pf\n3 2\n-1.0\n") + bytes_of({1, 2, 3, 4, 5}, false),
        std::string("Pf\n3 2\n-1.0\n") + bytes_of({1, 2, 3, 4, 5, 6, 7}, false),
        std::string("Pf\n3 -2\n-1.0\n"), std::string("Pf\n3 2\n0\n"), std::string("Pf\n3"),
        std::string("PF\n1 1\n-1.0\n") + bytes_of({1, 2, 3}, false)}) {
    const std::string path = file("a.pfm", bytes);
    const std::string text = complaint([&] { read_depth(path); });
    EXPECT_NE(text.find(path), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

TEST_F(DepthFile, ReadsRawFloatsOfEitherOrder) {
  const DepthReadOptions little{"", RawOrder::Little, 3, 2}, big{"", RawOrder::Big, 3, 2};
  EXPECT_EQ(read_depth(file("a.raw", bytes_of({1.0f, 2.5f, 3, 4, 5, 6}, false)), little).values,
            kRows);
  EXPECT_EQ(read_depth(file("b.raw", bytes_of({1.0f, 2.5f, 3, 4, 5, 6}, true)), big).values, kRows);
  const std::string text = complaint([&] {
    read_depth(file("c.raw", bytes_of({1, 2, 3, 4, 5}, true)), big);
  });
  EXPECT_NE(text.find("3 x 2 floats are 24 bytes, the file has 20"), std::string::npos) << text;
}

TEST_F(DepthFile, TakesZOrTheChannelNamedAndListsThoseThereAre) {
  AovImage picture;
  picture.width_px = 3;
  picture.height_px = 2;
  picture.z = kRows;
  picture.r = picture.g = picture.b = std::vector<float>(6, 0.5f);
  const std::string path = (folder_ / "a.exr").string();
  write_exr(path, picture);
  EXPECT_EQ(read_depth(path).values, kRows);
  EXPECT_EQ(read_depth(path).channel, "Z");
  EXPECT_EQ(read_depth(path, {.channel = "R"}).values, picture.r);
  std::string text = complaint([&] { read_depth(path, {.channel = "depth"}); });
  EXPECT_NE(text.find("has no channel 'depth': it has R, G, B, Z"), std::string::npos) << text;
  picture.z.clear();
  write_exr(path, picture);
  text = complaint([&] { read_depth(path); });
  EXPECT_NE(text.find("name one of R, G, B (--depth-channel)"), std::string::npos) << text;
}

TEST_F(DepthFile, SaysWhatCannotBeRead) {
  for (const std::string& path : {(folder_ / "none.exr").string(), file("cut.exr", "v/1\x01"),
                                  file("text.exr", "hello"), folder_.string()}) {
    const std::string text = complaint([&] { read_depth(path); });
    EXPECT_NE(text.find(path), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace plumb::image
