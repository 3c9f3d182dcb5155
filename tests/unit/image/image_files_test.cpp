#include "image/image_files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <thread>

#include "core/check.h"

namespace plumb::image {
namespace {

namespace fs = std::filesystem;

class ImageFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("plumb_image_files_" + std::to_string(::getpid()) + "_" + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Every channel with numbers of its own, NaN, both infinities and the smallest float among them.
AovImage full_image() {
  AovImage image;
  image.width_px = 5;
  image.height_px = 3;
  float next = 0.1f;
  for (const Channel& channel : channels()) {
    for (int k = 0; k < 15; ++k) (image.*channel.values).push_back(next += 0.37f);
  }
  image.z[2] = std::numeric_limits<float>::infinity();
  image.px[3] = -std::numeric_limits<float>::infinity();
  image.nz[4] = std::numeric_limits<float>::quiet_NaN();
  image.r[5] = std::numeric_limits<float>::denorm_min();
  image.id[6] = 16777216.0f;
  image.metadata["terrain"] = std::string("generate:alpine?size=2049&seed=7");
  image.metadata["camera.eye.x"] = 4500000.123456789;
  image.metadata["camera.far"] = std::numeric_limits<double>::infinity();
  image.metadata["camera.width"] = std::int32_t{5};
  return image;
}

TEST_F(ImageFiles, KeepEveryBitOfEveryChannelThroughAnExr) {
  const AovImage image = full_image();
  write_exr(folder_ / "a.exr", image);
  const AovImage read = read_exr(folder_ / "a.exr");
  EXPECT_EQ(read.width_px, 5);
  EXPECT_EQ(read.height_px, 3);
  for (const Channel& channel : channels()) {
    const std::vector<float>&a = image.*channel.values, &b = read.*channel.values;
    ASSERT_EQ(a.size(), b.size()) << channel.name;
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(a[k]), std::bit_cast<std::uint32_t>(b[k]))
          << channel.name << " " << k;
    }
  }
  EXPECT_EQ(read.metadata, image.metadata);
  EXPECT_EQ(raw_checksum(read), raw_checksum(image));
}

TEST_F(ImageFiles, KeepOnlyTheChannelsThatAreThere) {
  AovImage image;
  image.width_px = image.height_px = 1;
  image.z = {2.5f};
  write_exr(folder_ / "z.exr", image);
  const AovImage read = read_exr(folder_ / "z.exr");
  EXPECT_EQ(read.z, image.z);
  EXPECT_TRUE(read.r.empty() && read.id.empty());
}

TEST_F(ImageFiles, HaveTheSameBytesWheneverTheyAreWritten) {
  const AovImage image = full_image();
  const Rgb8Image picture{2, 1, {1, 2, 3, 4, 5, 6}};
  write_exr(folder_ / "a.exr", image);
  write_png(folder_ / "a.png", picture);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  write_exr(folder_ / "another_name.exr", image);
  write_png(folder_ / "another_name.png", picture);
  EXPECT_EQ(bytes_of(folder_ / "a.exr"), bytes_of(folder_ / "another_name.exr"));
  EXPECT_EQ(bytes_of(folder_ / "a.png"), bytes_of(folder_ / "another_name.png"));
  EXPECT_GT(bytes_of(folder_ / "a.exr").size(), 500u);
}

TEST_F(ImageFiles, CannotBeWrittenWhereNoFolderIs) {
  const fs::path path = folder_ / "missing" / "a.exr";
  const std::string said = complaint([&] { write_exr(path, full_image()); });
  EXPECT_NE(said.find(path.string()), std::string::npos) << said;
  EXPECT_NE(complaint([&] { write_png(path, Rgb8Image{1, 1, {0, 0, 0}}); }), "");
  EXPECT_TRUE(fs::is_empty(folder_));
}

// /proc is a folder that takes no file, from nobody.
TEST_F(ImageFiles, CannotBeWrittenIntoAFolderThatRefusesThem) {
  const std::string said = complaint([] { write_exr("/proc/plumb.exr", full_image()); });
  EXPECT_NE(said.find("/proc/plumb.exr"), std::string::npos) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  EXPECT_NE(complaint([] { write_png("/proc/plumb.png", Rgb8Image{1, 1, {0, 0, 0}}); }), "");
}

// As on a full disk: no file of this process may grow beyond 1000 bytes.
TEST_F(ImageFiles, LeaveNoPartBehindWhenTheDiskIsFull) {
  AovImage image;
  image.width_px = image.height_px = 64;
  for (int k = 0; k < 64 * 64; ++k) image.z.push_back(std::sqrt(static_cast<float>(k)));
  Rgb8Image picture{64, 64, {}};
  for (unsigned k = 0; k < 64 * 64 * 3; ++k) {
    picture.rgb.push_back(static_cast<std::uint8_t>(k * k * 2654435761u >> 24));
  }
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 1000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string of_exr = complaint([&] { write_exr(folder_ / "a.exr", image); });
  const std::string of_png = complaint([&] { write_png(folder_ / "a.png", picture); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(of_exr.find("a.exr"), std::string::npos) << of_exr;
  EXPECT_NE(of_png.find("a.png"), std::string::npos) << of_png;
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ImageFiles, LeaveTheOldFileAloneWhenTheNewOneCannotBeMade) {
  AovImage invalid = full_image();
  write_exr(folder_ / "a.exr", invalid);
  const std::string before = bytes_of(folder_ / "a.exr");
  invalid.z.pop_back();
  EXPECT_THROW(write_exr(folder_ / "a.exr", invalid), std::invalid_argument);
  EXPECT_EQ(bytes_of(folder_ / "a.exr"), before);
}

TEST_F(ImageFiles, SayInOneLineWhyTheyCannotBeRead) {
  const std::string missing = complaint([&] { read_exr(folder_ / "none.exr"); });
  EXPECT_NE(missing.find("none.exr"), std::string::npos) << missing;
  EXPECT_EQ(missing.find('\n'), std::string::npos);
  std::ofstream(folder_ / "bad.exr") << "this is no image";
  EXPECT_NE(complaint([&] { read_exr(folder_ / "bad.exr"); }), "");
  std::ofstream(folder_ / "bad.png") << "neither is this";
  EXPECT_NE(complaint([&] { read_png(folder_ / "bad.png"); }), "");
}

TEST_F(ImageFiles, OfAPictureCutShortAreRefused) {
  AovImage image;
  image.width_px = image.height_px = 64;
  for (int k = 0; k < 64 * 64; ++k) image.z.push_back(std::sqrt(static_cast<float>(k)));
  write_exr(folder_ / "a.exr", image);
  const std::string whole = bytes_of(folder_ / "a.exr");
  std::ofstream(folder_ / "cut.exr", std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_NE(complaint([&] { read_exr(folder_ / "cut.exr"); }), "");
}

TEST_F(ImageFiles, KeepThePixelsOfAPng) {
  const Rgb8Image picture{
      3, 2, {0, 128, 255, 1, 2, 3, 255, 255, 255, 9, 8, 7, 0, 0, 0, 64, 32, 16}};
  write_png(folder_ / "a.png", picture);
  EXPECT_EQ(read_png(folder_ / "a.png"), picture);
}

// Linear 0, 0.5 and 1 are the codes 0, 188 and 255.
TEST_F(ImageFiles, EncodeLinearLightAsSrgb) {
  ColourImage picture(1, 1);
  picture.g[0] = 0.5f;
  picture.b[0] = 1.0f;
  write_png(folder_ / "a.png", picture);
  EXPECT_EQ(read_png(folder_ / "a.png").rgb, (std::vector<std::uint8_t>{0, 188, 255}));
  const ColourImage read = read_colour(folder_ / "a.png");
  EXPECT_EQ(read.r[0], 0.0f);
  EXPECT_EQ(read.b[0], 1.0f);
  EXPECT_NEAR(read.g[0], 0.5, 0.004);  // half a code: 1/255 * slope of the light there, 0.0068 / 2
}

TEST_F(ImageFiles, OfFloatsAreLinearAlready) {
  AovImage image;
  image.width_px = image.height_px = 1;
  image.r = {0.25f};
  image.g = {0.5f};
  image.b = {2.0f};
  write_exr(folder_ / "a.exr", image);
  const ColourImage read = read_colour(folder_ / "a.exr");
  EXPECT_EQ(read.r, image.r);
  EXPECT_EQ(read.g, image.g);
  EXPECT_EQ(read.b, image.b);
}

}  // namespace
}  // namespace plumb::image
