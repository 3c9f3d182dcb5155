// A file is read into its heights by strips: no second copy of it stands in memory.
#include <malloc.h>

#include <fstream>

#include "core/parallel.h"
#include "written_files.h"

namespace plumb::terrain {
namespace {

// Sanitizers keep what is freed, and shadows of everything.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMeasures = false;
#elif defined(__has_feature)
constexpr bool kMeasures = !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool kMeasures = true;
#endif

double kibibytes_of(const std::string& what) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double value = 0.0;
    if (word == what && status >> value) return value;
  }
  return 0.0;
}

/// Lets the system forget the most memory that this process ever had; false where it cannot.
bool forget_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

constexpr int kColumns = 4097, kRows = 2049;
constexpr double kHeights = 2.0 * kColumns * kRows;
// A strip is 4 MiB of doubles, up to whole blocks: 256 rows of them, 8 MiB, in the tiled file. As
// much again is for what the libraries keep, and less than the 16 MiB that the file has.
constexpr double kStrips = 15.0 * 1024 * 1024;

std::vector<std::uint16_t> noise() {
  std::vector<std::uint16_t> values;
  std::uint32_t state = 1;
  for (int k = 0; k < kColumns * kRows; ++k) {
    state = state * 1664525u + 1013904223u;
    values.push_back(static_cast<std::uint16_t>(state >> 16));
  }
  return values;
}

class ReadingMemory : public testing::Test {
 protected:
  void SetUp() override {
    if (!kMeasures || !forget_peak()) GTEST_SKIP() << "no peak of memory can be measured here";
  }
  double peak_bytes_of(const std::string& file, const ReadOptions& options) {
    const ThreadLimit one(1);  // each thread has memory of its own
    {
      ReadOptions small = options;  // what the libraries allocate once
      small.window = Window{0, 0, 1, 1};
      load_terrain(file, small);
    }
    malloc_trim(0);  // what writing the file left behind must not be what reading it needs
    const double before = kibibytes_of("VmRSS:");
    forget_peak();
    EXPECT_EQ(load_terrain(file, options).columns(), kColumns);
    return (kibibytes_of("VmHWM:") - before) * 1024.0;
  }
  ReadOptions spaced() {
    ReadOptions options;
    options.spacing_x_m = 1.0;
    return options;
  }
  TemporaryFolder folder_;
};

TEST_F(ReadingMemory, OfATiledTiffIsItsHeightsAndAStrip) {
  const std::string file = folder_.file("a.tif");
  {
    GeoTiff tiff;
    tiff.columns = kColumns;
    tiff.rows = kRows;
    tiff.type = "UInt16";
    tiff.creation_options = {"TILED=YES"};
    const auto values = noise();
    tiff.values.assign(values.begin(), values.end());
    write(file, tiff);
  }
  EXPECT_LT(peak_bytes_of(file, spaced()), kHeights + kStrips);
}

TEST_F(ReadingMemory, OfAPngIsItsHeightsAndAStrip) {
  const std::string file = folder_.file("a.png");
  write_png16(file, kColumns, kRows, noise());
  EXPECT_LT(peak_bytes_of(file, spaced()), kHeights + kStrips);
}

TEST_F(ReadingMemory, OfBareSamplesIsItsHeightsAndAStrip) {
  const std::string file = folder_.file("a.r16");
  {
    const auto values = noise();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(2 * values.size()));
  }
  ReadOptions options = spaced();
  options.raw_size = RawSize{kColumns, kRows};
  EXPECT_LT(peak_bytes_of(file, options), kHeights + kStrips);
}

int value_at(int k) { return static_cast<int>(std::int64_t{k} * 7919 % 32003); }

// Strips end where blocks do or where memory ends, windows anywhere: nothing shows.
TEST(ReadingByStrips, GivesTheSamplesOfBlocksOfAnyShape) {
  const TemporaryFolder folder;
  GeoTiff tiff;
  tiff.columns = 2051;
  tiff.rows = 1003;
  tiff.type = "Int16";
  for (int k = 0; k < tiff.columns * tiff.rows; ++k) tiff.values.push_back(value_at(k));
  const std::vector<std::vector<std::string>> layouts = {
      {},
      {"BLOCKYSIZE=1003", "COMPRESS=DEFLATE"},
      {"BLOCKYSIZE=7", "COMPRESS=DEFLATE"},
      {"TILED=YES", "BLOCKXSIZE=512", "BLOCKYSIZE=512"},
      {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=304", "COMPRESS=DEFLATE"}};
  for (const auto& layout : layouts) {
    tiff.creation_options = layout;
    const std::string file = folder.file("a.tif");
    write(file, tiff);
    for (const Window& w :
         {Window{0, 0, 2051, 1003}, Window{3, 5, 2048, 998}, Window{1030, 511, 700, 2}}) {
      ReadOptions options;
      options.window = w;
      const std::vector<float> read = as_in_file(load_terrain(file, options));
      std::size_t k = 0;
      for (int row = w.y; row < w.y + w.height; ++row) {
        for (int column = w.x; column < w.x + w.width; ++column, ++k) {
          ASSERT_EQ(read[k], static_cast<float>(value_at(row * 2051 + column)));
        }
      }
    }
  }
}

}  // namespace
}  // namespace plumb::terrain
