// Bounds as numbers of 8 bits, and as bytes.
#include "mesh/tessellation/bounds_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/tessellation/bound_scale.h"
#include "support/random_scene.h"

namespace plumb::mesh::tessellation {
namespace {

using patch_quadtree::RansCounts;
using patch_quadtree::RansTable;
using test_support::Random;

TEST(BoundScale, NamesALittleMoreThanItWasGiven) {
  Random random(34);
  for (const double unit_m : {1.0, 3e-7, 0.4321}) {
    const BoundScale scale{unit_m};
    for (int k = 0; k < 20000; ++k) {
      const double bound_m = unit_m * std::exp2(random.uniform(0.0, 50.0));
      const double value_m = scale.value(scale.code(bound_m));
      EXPECT_GE(value_m, bound_m);
      // 2^(1/5) - 1 is 0.1486...
      EXPECT_LE(value_m, bound_m * 1.1487);
    }
  }
}

TEST(BoundScale, RisesWithWhatItNames) {
  const BoundScale scale{0.25};
  EXPECT_EQ(scale.value(0), 0.0);
  EXPECT_EQ(scale.value(1), 0.25);
  EXPECT_EQ(scale.value(6), 0.5);
  for (int code = 1; code < 256; ++code)
    EXPECT_GT(scale.value(static_cast<std::uint8_t>(code)),
              scale.value(static_cast<std::uint8_t>(code - 1)));
  for (int code = 0; code < 255; ++code) {
    const auto byte = static_cast<std::uint8_t>(code);
    EXPECT_EQ(scale.code(scale.value(byte)), code);
    // A hair more needs the next.
    EXPECT_EQ(scale.code(std::nextafter(scale.value(byte), 1e300)), code + 1);
  }
}

TEST(BoundScale, NamesNothingAsZeroAndTheEndlessAsNone) {
  const BoundScale scale{1e-3};
  EXPECT_EQ(scale.code(0.0), 0);
  EXPECT_EQ(scale.code(std::numeric_limits<double>::denorm_min()), 1);
  EXPECT_EQ(scale.code(std::numeric_limits<double>::infinity()), BoundScale::kNone);
  EXPECT_EQ(scale.code(1e30), BoundScale::kNone);
  EXPECT_TRUE(std::isinf(scale.value(BoundScale::kNone)));
}

// Bounds and what foretells them.
struct Sample {
  PatchBounds bounds;
  std::vector<double> distances_m;

  ForetoldBounds foretold() const { return {distances_m, BoundScale{0.01}}; }
};

// Bounds as they are, alike from block to block, and as they never are; some blocks have a void.
Sample random_sample(Random& random, int blocks, int levels) {
  Sample sample;
  PatchBounds& bounds = sample.bounds;
  bounds.blocks = blocks;
  bounds.levels = levels;
  bounds.published_m = random.chance(0.1) ? std::numeric_limits<float>::infinity()
                                          : static_cast<float>(random.uniform(0.0, 90.0));
  if (random.chance(0.2)) return sample;
  bounds.low_m = static_cast<float>(random.uniform(-500.0, 100.0));
  bounds.high_m = bounds.low_m + static_cast<float>(random.uniform(0.0, 900.0));
  const bool wild = random.chance(0.4);
  for (int k = 0; k < blocks * blocks; ++k) {
    const bool has_void = random.chance(0.2), has_none = has_void && random.chance(0.5);
    for (int level = 0; level < levels; ++level) {
      const int code = wild ? random.integer(0, 254) : 40 + 5 * level + random.integer(-3, 3);
      const bool none = level > 0 ? has_void : has_none;
      bounds.codes.push_back(none ? BoundScale::kNone : static_cast<std::uint8_t>(code));
      sample.distances_m.push_back(has_void     ? -1.0
                                   : level == 0 ? 0.0
                                                : random.uniform(0.0, level * 4.0));
    }
  }
  return sample;
}

std::vector<RansTable> tables_of(const std::vector<Sample>& all, int levels) {
  std::vector<RansCounts> counts(bound_contexts(levels));
  for (const Sample& each : all) count_bounds(each.bounds, each.foretold(), counts);
  return *patch_quadtree::rans_tables_of(patch_quadtree::rans_model_bytes(counts), counts.size());
}

// Both halves, as a reader asks for them.
bool decode(std::span<const std::uint8_t> bytes, const Sample& sample,
            std::span<const RansTable> tables, PatchBounds& bounds) {
  return decode_bounds(bytes, sample.bounds.blocks, sample.bounds.levels, tables, bounds) &&
         (bounds.is_void() || (!sample.distances_m.empty() &&
                               decode_thinned(bytes, sample.foretold(), tables, bounds)));
}

TEST(BoundsRecord, ComesBackAsItWas) {
  Random random(35);
  int voids = 0;
  for (const auto& [blocks, levels] : {std::pair(1, 4), std::pair(2, 5), std::pair(16, 4)}) {
    std::vector<Sample> all;
    for (int k = 0; k < 60; ++k) all.push_back(random_sample(random, blocks, levels));
    const std::vector<RansTable> tables = tables_of(all, levels);
    for (const Sample& each : all) {
      PatchBounds again;
      const Bytes bytes = encode_bounds(each.bounds, each.foretold(), tables);
      ASSERT_TRUE(decode(bytes, each, tables, again));
      EXPECT_EQ(again, each.bounds);
      voids += each.bounds.is_void();
    }
  }
  EXPECT_GT(voids, 5);
}

// What a reader of bounds relies on.
void expect_usable(const PatchBounds& bounds, int blocks, int levels) {
  EXPECT_GE(bounds.published_m, 0.0f);
  EXPECT_EQ(bounds.blocks, blocks);
  EXPECT_EQ(bounds.levels, levels);
  if (bounds.is_void()) return;
  EXPECT_EQ(bounds.codes.size(), static_cast<std::size_t>(blocks * blocks * levels));
  EXPECT_TRUE(std::isfinite(bounds.low_m) && std::isfinite(bounds.high_m));
  EXPECT_LE(bounds.low_m, bounds.high_m);
}

TEST(BoundsRecord, DamagedIsRefusedOrUsable) {
  Random random(36);
  constexpr int kBlocks = 3, kLevels = 4;
  std::vector<Sample> all;
  for (int k = 0; k < 12; ++k) all.push_back(random_sample(random, kBlocks, kLevels));
  const std::vector<RansTable> tables = tables_of(all, kLevels);
  int refused = 0, tried = 0;
  const auto attempt = [&](const Sample& sample, const Bytes& bytes) {
    PatchBounds bounds;
    ++tried;
    if (decode(bytes, sample, tables, bounds)) {
      expect_usable(bounds, kBlocks, kLevels);
    } else {
      ++refused;
    }
  };
  for (const Sample& each : all) {
    const Bytes whole = encode_bounds(each.bounds, each.foretold(), tables);
    for (std::size_t length = 0; length < whole.size(); ++length) {
      PatchBounds bounds;
      EXPECT_FALSE(decode(std::span(whole).first(length), each, tables, bounds))
          << length << " of " << whole.size();
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (int value = 0; value < 256; ++value) {
        Bytes harmed = whole;
        harmed[at] = static_cast<std::uint8_t>(value);
        if (harmed != whole) attempt(each, harmed);
      }
    }
    Bytes longer = whole;
    longer.push_back(0);
    PatchBounds bounds;
    EXPECT_FALSE(decode(longer, each, tables, bounds));
  }
  EXPECT_GT(refused, tried / 2);
}

}  // namespace
}  // namespace plumb::mesh::tessellation
