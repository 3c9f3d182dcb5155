#include "core/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "core/check.h"

namespace plumb {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("plumb_atomic_file_" + std::to_string(::getpid()) + "_" + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string read(const char* name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  int file_count() const {
    return static_cast<int>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(AtomicFile, HoldsEveryByteAndReplacesWhatWasThere) {
  write_file_atomically(folder_ / "a.txt", "first");
  write_file_atomically(folder_ / "a.txt", std::string_view("b\0\n", 3));
  EXPECT_EQ(read("a.txt"), std::string("b\0\n", 3));
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFile, IsNotTouchedWhenAnExceptionPasses) {
  write_file_atomically(folder_ / "a.txt", "old");
  try {
    const TemporarySibling sibling(folder_ / "a.txt");
    std::ofstream(sibling.path()) << "half of the n";
    EXPECT_EQ(file_count(), 2);
    throw std::runtime_error("interrupted");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(read("a.txt"), "old");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFile, HasATemporaryNameBesideItWithItsExtension) {
  const TemporarySibling one(folder_ / "a.exr"), other(folder_ / "a.exr");
  EXPECT_EQ(one.path().parent_path(), folder_);
  EXPECT_EQ(one.path().extension(), ".exr");
  EXPECT_NE(one.path(), other.path());
}

TEST_F(AtomicFile, FollowsALinkAndLeavesItALink) {
  fs::create_directory(folder_ / "real");
  write_file_atomically(folder_ / "real" / "a.txt", "old");
  fs::create_symlink(fs::path("real") / "a.txt", folder_ / "link.txt");
  write_file_atomically(folder_ / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(read("real/a.txt"), "new");
}

TEST_F(AtomicFile, RefusesWhatIsNoFileByName) {
  const auto complaint = [](const fs::path& path) {
    try {
      write_file_atomically(path, "x");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(complaint("/dev/null").find("/dev/null"), std::string::npos);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_NE(complaint(folder_).find(folder_.string()), std::string::npos);
  const fs::path missing = folder_ / "missing" / "a.txt";
  EXPECT_NE(complaint(missing).find(missing.string()), std::string::npos);
  EXPECT_EQ(file_count(), 0);
}

}  // namespace
}  // namespace plumb
