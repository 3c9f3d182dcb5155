// What a built file says of its blocks holds for whatever is drawn of them, by plain arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "support/elevation_files.h"
#include "support/random_scene.h"
#include "support/tessellated_terrain.h"
#include "support/test_terrain.h"
#include "terrain/terrain_source.h"

namespace plumb::mesh::tessellation {
namespace {

using patch_quadtree::PatchPlace;
using terrain::Diagonal;
using test_support::ElevationFile;
using test_support::Random;
using test_support::rough_terrain;
using test_support::SlowDeviation;

// What was measured of a file's bounds.
struct Tightness {
  std::int64_t blocks = 0, without_bound = 0;
  std::vector<double> claimed_by_measured = {};

  void print(const std::string& name) {
    std::sort(claimed_by_measured.begin(), claimed_by_measured.end());
    const auto at = [&](double share) {
      if (claimed_by_measured.empty()) return 0.0;
      return claimed_by_measured[static_cast<std::size_t>(
          share * static_cast<double>(claimed_by_measured.size() - 1))];
    };
    std::printf(
        "%s: %lld blocks, %lld without a bound; claimed by measured: median %.3f, 95 %% %.3f\n",
        name.c_str(), static_cast<long long>(blocks), static_cast<long long>(without_bound),
        at(0.5), at(0.95));
  }
};

class BoundsCheck {
 public:
  BoundsCheck(const terrain::Heightfield& field, const Prepared& prepared)
      : floats_(field.heights_m), prepared_(prepared), slow_(*floats_, Diagonal::Blocks8) {
    // The rival rounds a few dozen times; 1e-12 of the heights is more.
    for (const float height : (*floats_).values())
      if (std::abs(height) > highest_m_) highest_m_ = std::abs(height);
  }

  // `mixtures` of every block of a patch, or of one in `every`.
  void patch(const PatchPlace& place, Random& random, int mixtures, int every, Tightness& found) {
    const Grid<float> heights_m = prepared_.decoder->heights(place);
    const PatchBounds bounds =
        thinned_bounds(*prepared_.container, *prepared_.bounds, *prepared_.foretold,
                       prepared_.header().layout.index(place), heights_m);
    if (bounds.is_void()) {
      // Its margin is other patches'.
      for (int j = 1; j + 1 < heights_m.rows(); ++j)
        for (int i = 1; i + 1 < heights_m.columns(); ++i) ASSERT_TRUE(std::isnan(heights_m(i, j)));
      return;
    }
    for (int j = 0; j < bounds.blocks; ++j)
      for (int i = 0; i < bounds.blocks; ++i)
        for (int k = 0; k < mixtures && random.chance(1.0 / every); ++k)
          block(place, heights_m, bounds, i, j, random, found);
  }

 private:
  void block(const PatchPlace& place, const Grid<float>& heights_m, const PatchBounds& bounds,
             int i, int j, Random& random, Tightness& found) {
    const int inside = random.integer(0, prepared_.pieces->coarsest());
    BlockLevels levels{static_cast<std::uint8_t>(inside), {}};
    // Full thinning all round is a case of its own: two triangles.
    const bool alike = random.chance(0.3);
    for (std::uint8_t& side : levels.side)
      side = static_cast<std::uint8_t>(alike ? inside : random.integer(0, inside));
    ++found.blocks;
    const std::uint8_t code = bounds.code(i, j, inside);
    if (code == BoundScale::kNone) {
      ++found.without_bound;
      return;
    }
    const double claimed = prepared_.bounds->scale.value(code);
    const double measured =
        slow_.of(test_support::triangles_of_block(prepared_, place, heights_m, i, j, levels));
    EXPECT_LE(measured, claimed + 1e-12 * highest_m_)
        << "patch (" << place.px << ", " << place.py << ") of level " << place.level << ", block ("
        << i << ", " << j << "), inside " << inside;
    if (measured > 0.0) found.claimed_by_measured.push_back(claimed / measured);
  }

  terrain::FloatHeights floats_;
  const Prepared& prepared_;
  SlowDeviation slow_;
  double highest_m_ = 0.0;
};

struct Scene {
  int columns, rows;
  double void_share;
  Parameters parameters;
};

Parameters with(double error_m, int patch_cells, int block_cells, std::uint32_t version = 2) {
  Parameters parameters;
  parameters.error_m = error_m;
  parameters.patch_cells = patch_cells;
  parameters.block_cells = block_cells;
  parameters.format_version = version;
  return parameters;
}

void check_rough(const std::vector<Scene>& scenes) {
  Random random(37);
  for (const Scene& scene : scenes) {
    Tightness found;
    for (std::uint32_t seed = 1; seed <= 2; ++seed) {
      const terrain::Heightfield field =
          rough_terrain(scene.columns, scene.rows, seed, 100.0, scene.void_share);
      const Prepared prepared = prepare(field, scene.parameters);
      BoundsCheck check(field, prepared);
      const auto& layout = prepared.header().layout;
      for (std::int64_t k = 0; k < layout.patch_count(); ++k)
        check.patch(layout.place(k), random, 6, 1, found);
    }
    found.print(std::to_string(scene.columns) + " x " + std::to_string(scene.rows));
    EXPECT_GT(found.blocks, found.without_bound);
  }
}

TEST(TessellationBounds, HoldForEveryBlockOfRoughTerrains) {
  check_rough({{129, 97, 0.0, with(0.0, 32, 8)},
               {129, 97, 0.0, with(2.0, 16, 8, 1)},
               {100, 131, 0.0, with(0.5, 8, 8)},
               {61, 73, 0.0, with(300.0, 16, 8)},
               {130, 120, 0.0, with(0.5, 32, 16)},
               {150, 90, 0.0, with(1.0, 64, 64)},
               {2, 2, 0.0, with(0.5, 16, 8)},
               {3, 200, 0.0, with(0.5, 16, 8)},
               {200, 3, 0.0, with(0.5, 16, 16, 1)}});
}

TEST(TessellationBounds, HoldBetweenVoids) {
  check_rough({{97, 80, 0.02, with(0.5, 16, 8)},
               {67, 65, 0.2, with(0.0, 8, 8, 1)},
               {3, 200, 0.02, with(0.5, 16, 8)}});
}

// Err(P), what the selection goes by, is that of its worst block; heights are within low and high.
TEST(TessellationBounds, OfAPatchAreThoseOfItsBlocks) {
  const terrain::Heightfield field = rough_terrain(90, 77, 5, 100.0, 0.02);
  const Prepared prepared = prepare(field, with(1.0, 16, 8));
  const auto& layout = prepared.header().layout;
  for (std::int64_t k = 0; k < layout.patch_count(); ++k) {
    const PatchPlace place = layout.place(k);
    const PatchBounds& bounds = prepared.bounds->patches[static_cast<std::size_t>(k)];
    int largest = 0;
    for (int j = 0; j < bounds.blocks && !bounds.is_void(); ++j)
      for (int i = 0; i < bounds.blocks; ++i)
        largest = std::max(largest, int{bounds.code(i, j, 0)});
    EXPECT_EQ(bounds.error_code(), largest);
    const int n = layout.patch_cells;
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (int y = layout.sample_row(place, 0); y <= layout.sample_row(place, n); ++y) {
      for (int x = layout.sample_column(place, 0); x <= layout.sample_column(place, n); ++x) {
        if (field.is_void(x, y)) continue;
        low = std::min(low, field.heights_m(x, y));
        high = std::max(high, field.heights_m(x, y));
      }
    }
    EXPECT_EQ(bounds.is_void(), low > high);
    if (bounds.is_void()) continue;
    EXPECT_EQ(bounds.low_m, low);
    EXPECT_EQ(bounds.high_m, high);
  }
}

// patches: at most so many of a level, 0 for all.
void check_file(const ElevationFile& file, bool whole, int patches, int every) {
  const std::string path = test_support::path_of(file);
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  terrain::ReadOptions options;
  if (!whole) options.window = file.window;
  options.decode = file.decode;
  options.spacing_x_m = file.spacing_m;
  const terrain::Heightfield field = terrain::load_terrain(path, options);
  const Prepared prepared = prepare(field, with(1.0, 128, 8));
  BoundsCheck check(field, prepared);
  Random random(38);
  Tightness found;
  const auto& layout = prepared.header().layout;
  for (int level = 0; level < layout.levels; ++level) {
    const std::int64_t first = layout.first_of_level(level),
                       count = layout.first_of_level(level - 1) - first;
    for (std::int64_t k = 0; k < (patches > 0 ? patches : count); ++k) {
      const std::int64_t of = patches > 0 ? random.integer(0, static_cast<int>(count) - 1) : k;
      check.patch(layout.place(first + of), random, 1, every, found);
    }
  }
  found.print(file.name);
  EXPECT_GT(found.claimed_by_measured.size(), 0u);
}

class BoundsOfFile : public testing::TestWithParam<ElevationFile> {};
class LongBoundsOfFile : public BoundsOfFile {};

TEST_P(BoundsOfFile, HoldForSomePatchesOfEveryLevel) { check_file(GetParam(), false, 3, 4); }
TEST_P(LongBoundsOfFile, HoldForEveryPatch) { check_file(GetParam(), true, 0, 1); }

INSTANTIATE_TEST_SUITE_P(Tessellation, BoundsOfFile,
                         testing::ValuesIn(test_support::kElevationFiles));
INSTANTIATE_TEST_SUITE_P(LongTessellation, LongBoundsOfFile,
                         testing::ValuesIn(test_support::kElevationFiles));

}  // namespace
}  // namespace plumb::mesh::tessellation
