// What holds of every terrain: whatever the threads, against slow direct computations.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "core/parallel.h"
#include "support/test_terrain.h"
#include "terrain/generators.h"
#include "terrain/statistics.h"
#include "terrain/terrain_source.h"
#include "terrain/void_fill.h"

namespace plumb::terrain {
namespace {

std::vector<std::string> terrains() {
  std::vector<std::string> arguments;
  for (const GeneratorHelp& help : generator_help()) {
    for (const char* size : {"1x7", "2", "33", "65x40"}) {
      arguments.push_back(test_support::heights_of(help, std::string("seed=3&size=") + size));
      arguments.push_back(arguments.back() + "&voids=0.3&utm=1&spacing=7,13");
    }
  }
  return arguments;
}

TEST(EveryGenerator, GivesTheSameBitsOnAnyNumberOfThreads) {
  for (const GeneratorHelp& help : generator_help()) {
    const std::string argument = test_support::heights_of(help, "size=301x203&voids=0.15&seed=9");
    std::vector<std::uint64_t> sums;
    for (const int threads : {1, 2, 7}) {
      const ThreadLimit limit(threads);
      sums.push_back(checksum(generate(argument)));
    }
    EXPECT_EQ(sums[0], sums[1]) << argument;
    EXPECT_EQ(sums[0], sums[2]) << argument;
  }
}

TEST(EveryTerrain, IsValid) {
  for (const std::string& argument : terrains()) {
    EXPECT_NO_THROW(require_valid(generate(argument))) << argument;
  }
}

/// The gradient's slope in degrees, by the C library.
double slope_deg(const Heightfield& f, int i, int j) {
  const double a = f.heights_m(i, j), b = f.heights_m(i + 1, j);
  const double c = f.heights_m(i, j + 1), d = f.heights_m(i + 1, j + 1);
  const double east = (b - a + d - c) / 2.0 / f.dx_m, north = (c - a + d - b) / 2.0 / f.dy_m;
  return std::atan(std::hypot(east, north)) * 180.0 / 3.14159265358979323846;
}

TEST(EveryTerrain, HasTheStatisticsOfASlowCount) {
  for (const std::string& argument : terrains()) {
    const Heightfield field = generate(argument);
    const TerrainStatistics s = statistics_of(field);
    std::int64_t voids = 0, cells = 0;
    double sum = 0.0, largest_deg = 0.0;
    std::vector<int> bins(kSlopeBins, 0);
    for (int j = 0; j < field.rows(); ++j) {
      for (int i = 0; i < field.columns(); ++i) {
        voids += field.is_void(i, j) ? 1 : 0;
        sum += field.is_void(i, j) ? 0.0 : field.heights_m(i, j);
        if (i + 1 == field.columns() || j + 1 == field.rows()) continue;
        const double slope = slope_deg(field, i, j);
        if (std::isnan(slope)) continue;
        ++cells;
        largest_deg = std::max(largest_deg, slope);
        ++bins[static_cast<std::size_t>(slope / kSlopeBinWidth_deg)];
      }
    }
    EXPECT_EQ(s.voids, voids) << argument;
    EXPECT_EQ(s.voids + s.heights, static_cast<std::int64_t>(field.heights_m.size())) << argument;
    EXPECT_EQ(s.cells, cells) << argument;
    EXPECT_EQ(std::accumulate(s.slope_histogram.begin(), s.slope_histogram.end(), std::int64_t{0}),
              cells);
    for (std::size_t k = 0; k < kSlopeBins; ++k) {
      EXPECT_EQ(s.slope_histogram[k], bins[k]) << argument << " bin " << k;
    }
    EXPECT_NEAR(s.largest_slope_deg, largest_deg, 1e-12 * 90.0) << argument;
    // Sums of up to 2600 heights below 4000 m, rounded in another order: 2600 * 1e7 * 1.1e-16.
    if (s.heights > 0) {
      EXPECT_NEAR(s.mean_m * static_cast<double>(s.heights), sum, 1e-5) << argument;
    }
  }
}

TEST(EveryTerrain, HasTheSameStatisticsOnAnyNumberOfThreads) {
  const Heightfield field = generate("generate:alpine?size=300&voids=0.1");
  std::vector<TerrainStatistics> all;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    all.push_back(statistics_of(field));
  }
  for (const TerrainStatistics& s : all) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(s.mean_m), std::bit_cast<std::uint64_t>(all[0].mean_m));
    EXPECT_EQ(s.rms_slope_deg, all[0].rms_slope_deg);
    EXPECT_EQ(s.slope_histogram, all[0].slope_histogram);
    EXPECT_EQ(s.steepest_step.rise_m, all[0].steepest_step.rise_m);
  }
}

/// The nearest sample that is not void, by looking at all; of equal ones the lower column, then
/// the lower row.
float nearest_height(const Heightfield& field, int i, int j) {
  double best = std::numeric_limits<double>::infinity();
  float height = std::numeric_limits<float>::quiet_NaN();
  for (int column = 0; column < field.columns(); ++column) {
    for (int row = 0; row < field.rows(); ++row) {
      if (field.is_void(column, row)) continue;
      const double east = (column - i) * field.dx_m, north = (row - j) * field.dy_m;
      const double distance = east * east + north * north;
      if (distance < best) {
        best = distance;
        height = field.heights_m(column, row);
      }
    }
  }
  return height;
}

TEST(EveryFilledTerrain, HasTheHeightOfTheNearestSample) {
  for (const char* argument : {"generate:alpine?size=40x31&voids=0.5&spacing=1",
                               "generate:alpine?size=60x7&voids=0.7&spacing=1,3",
                               "generate:alpine?size=3x50&voids=0.6&spacing=4,1",
                               "generate:alpine?size=25&voids=0.97&spacing=2"}) {
    const Heightfield holes = generate(argument);
    ASSERT_GT(holes.provenance.voids_declared, 0);
    Heightfield filled = holes;
    EXPECT_EQ(fill_voids(filled), holes.provenance.voids_declared);
    for (int j = 0; j < holes.rows(); ++j) {
      for (int i = 0; i < holes.columns(); ++i) {
        ASSERT_EQ(filled.heights_m(i, j), nearest_height(holes, i, j)) << argument << i << " " << j;
      }
    }
  }
}

TEST(EveryWindow, HoldsThatPartOfTheWholeFile) {
  const std::string file = std::string(PLUMB_SOURCE_DIR) + "/../shared/data/N65E029.hgt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  const Heightfield whole = load_terrain(file);
  for (const Window& w : {Window{0, 0, 1, 1}, Window{1200, 1200, 1, 1}, Window{1190, 3, 11, 40},
                          Window{17, 600, 333, 601}}) {
    ReadOptions options;
    options.window = w;
    const Heightfield part = load_terrain(file, options);
    const int south = 1201 - w.y - w.height;
    for (int j = 0; j < w.height; ++j) {
      for (int i = 0; i < w.width; ++i) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(part.heights_m(i, j)),
                  std::bit_cast<std::uint32_t>(whole.heights_m(w.x + i, south + j)));
      }
    }
  }
}

}  // namespace
}  // namespace plumb::terrain
