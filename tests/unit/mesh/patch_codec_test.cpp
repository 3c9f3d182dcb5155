// Both versions of the patch codec: what goes in comes out, errors keep to their bound, and bytes
// that are no record are told.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "core/check.h"
#include "mesh/patch_quadtree/arithmetic_coder.h"
#include "mesh/patch_quadtree/modelled_patch.h"
#include "mesh/patch_quadtree/patch_layout.h"
#include "mesh/patch_quadtree/published_family.h"
#include "mesh/patch_quadtree/rans.h"
#include "mesh/patch_quadtree/void_mask.h"
#include "support/random_scene.h"
#include "terrain/terrain_source.h"

namespace plumb::mesh::patch_quadtree {
namespace {

using test_support::Random;

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

// Hills of single precision, with a lake that is void and some single voids.
terrain::HeightGrid hills(int columns, int rows, bool with_voids, std::uint64_t seed = 5) {
  Random random(seed);
  Grid<float> heights(columns, rows);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double wave = 300.0 * std::sin(0.05 * i) * std::cos(0.07 * j) - 40.0;
      heights(i, j) = static_cast<float>(wave + 3.0 * random.uniform(-1.0, 1.0));
      const bool lake = std::hypot(i - 0.4 * columns, j - 0.6 * rows) < 0.15 * columns;
      if (with_voids && (lake || random.uniform(0.0, 1.0) < 0.002)) heights(i, j) = kVoid;
    }
  }
  return terrain::HeightGrid(std::move(heights));
}

TEST(PatchLayout, NumbersEveryPatchOnce) {
  for (const auto& [columns, rows] : {std::pair{2, 2}, {9, 9}, {17, 30}, {257, 65}, {1000, 731}}) {
    const PatchLayout layout = layout_of(columns, rows, 8);
    EXPECT_EQ(layout.patch_columns(layout.levels - 1), 1);
    EXPECT_EQ(layout.patch_rows(layout.levels - 1), 1);
    for (std::int64_t k = 0; k < layout.patch_count(); ++k) {
      const PatchPlace place = layout.place(k);
      ASSERT_EQ(layout.index(place), k);
      ASSERT_TRUE(layout.contains(place));
      if (k > 0) {
        ASSERT_TRUE(layout.contains(place.parent()));
      }
    }
  }
  EXPECT_THROW(layout_of(1, 9, 8), std::invalid_argument);
  EXPECT_THROW(layout_of(9, 9, 12), std::invalid_argument);
}

// Even samples of a child are its parent's, beyond the terrain too.
TEST(PatchLayout, SharesSamplesWithTheParent) {
  const PatchLayout layout = layout_of(100, 77, 16);
  for (std::int64_t k = 1; k < layout.patch_count(); ++k) {
    const PatchPlace child = layout.place(k), parent = child.parent();
    for (int i = 0; i <= 16; i += 2) {
      EXPECT_EQ(layout.sample_column(child, i),
                layout.sample_column(parent, i / 2 + (child.px & 1) * 8));
      EXPECT_EQ(layout.sample_row(child, i), layout.sample_row(parent, i / 2 + (child.py & 1) * 8));
    }
  }
}

TEST(Quantiser, NeverLeavesItsError) {
  Random random(3);
  for (const double error : {0.01, 0.1, 1.0, 7.3}) {
    for (const StepRule rule : {StepRule::Same, StepRule::DoublesWithLevel}) {
      const terrain::HeightGrid grid = hills(60, 40, false);
      const Quantiser quantiser = quantiser_for(grid, error, rule);
      for (int j = 0; j < 40; ++j) {
        for (int i = 0; i < 60; ++i) {
          for (const int level : {0, 1, 5}) {
            const double off = std::abs(
                double{quantiser.height(quantiser.number(grid(i, j), level), level)} - grid(i, j));
            EXPECT_LE(off, quantiser.error_m(level));
          }
          EXPECT_LE(
              std::abs(double{quantiser.height(quantiser.number(grid(i, j), 0), 0)} - grid(i, j)),
              error);
          const std::int32_t fine = quantiser.number(grid(i, j), 2),
                             coarse = quantiser.number(grid(i, j), 3);
          if (rule == StepRule::DoublesWithLevel) {
            EXPECT_LE(std::abs(fine - 2 * coarse), 1);
          } else {
            EXPECT_EQ(fine, coarse);
          }
        }
      }
    }
  }
}

// Whole metres within a metre are thirds of a number; 0.5 m keeps them as they are.
TEST(Quantiser, TakesTheOddMultipleOfWholeMetres) {
  Grid<float> whole(30, 30);
  for (int j = 0; j < 30; ++j) {
    for (int i = 0; i < 30; ++i) whole(i, j) = static_cast<float>(7 * i - 11 * j);
  }
  const terrain::HeightGrid grid(std::move(whole));
  EXPECT_EQ(quantiser_for(grid, 1.0, StepRule::Same).step_m, 3.0);
  EXPECT_NEAR(quantiser_for(grid, 2.9, StepRule::Same).step_m, 5.8, 1e-4);
  EXPECT_EQ(quantiser_for(grid, 0.5, StepRule::Same).step_m, 1.0);
  EXPECT_EQ(quantiser_for(grid, 1.0, StepRule::Same).error_m(0), 1.0);
  for (int k = -9; k < 9; ++k) {
    const Quantiser thirds = quantiser_for(grid, 1.0, StepRule::Same);
    const auto height = static_cast<float>(k);
    EXPECT_LE(std::abs(thirds.height(thirds.number(height, 0), 0) - height), 1.0f) << k;
  }
  EXPECT_THROW(quantiser_for(grid, 0.0, StepRule::Same), InputError);
  EXPECT_THROW(quantiser_for(grid, 1e-6, StepRule::DoublesWithLevel), InputError);
}

TEST(ArithmeticCoder, GivesBackWhatItWasGiven) {
  Random random(9);
  for (const int symbols : {2, 3, 256}) {
    std::vector<int> all;
    for (int k = 0; k < 5000; ++k)
      all.push_back(
          static_cast<int>(std::floor(symbols * std::pow(random.uniform(0.0, 1.0), 4.0))));
    AdaptiveModel to(symbols), from(symbols);
    ArithmeticEncoder encoder;
    for (const int symbol : all) {
      encoder.put(symbol, to);
      encoder.put_bits(static_cast<std::uint32_t>(symbol) & 7u, 3);
    }
    const Bytes bytes = encoder.finish();
    ArithmeticDecoder decoder(bytes);
    for (const int symbol : all) {
      ASSERT_EQ(decoder.take(from), symbol);
      ASSERT_EQ(decoder.take_bits(3), static_cast<std::uint32_t>(symbol) & 7u);
    }
    EXPECT_FALSE(decoder.overrun());
  }
}

// A bit of an even chance costs a bit: within a percent, and the bytes that end the code.
TEST(Rans, CostsWhatItsFrequenciesSay) {
  Random random(4);
  std::array<std::uint64_t, kRansSymbols> counts{};
  counts[0] = 700;
  counts[1] = 200;
  counts[7] = 90;
  counts[15] = 10;
  const RansTable table(rans_frequencies(counts));
  std::vector<RansSymbol> symbols;
  double bits = 0.0;
  for (int k = 0; k < 20011; ++k) {
    const double at = random.uniform(0.0, 1000.0);
    const int symbol = at < 700 ? 0 : at < 900 ? 1 : at < 990 ? 7 : 15;
    symbols.push_back({&table, static_cast<std::uint8_t>(symbol)});
    bits -= std::log2(table.frequency[static_cast<std::size_t>(symbol)] / double{kRansTotal});
  }
  const Bytes bytes = rans_encode(symbols);
  EXPECT_NEAR(8.0 * static_cast<double>(bytes.size()), bits, 0.01 * bits + 8.0 * 4 * kRansStates);
  RansDecoder decoder(bytes);
  for (const RansSymbol& each : symbols) ASSERT_EQ(decoder.take(table), each.symbol);
  EXPECT_TRUE(decoder.is_finished());
}

TEST(VoidMask, IsExact) {
  Random random(8);
  Grid<std::uint8_t> mask(35, 19), known(35, 19, std::uint8_t{2});
  for (int j = 0; j < 19; ++j) {
    for (int i = 0; i < 35; ++i) {
      mask(i, j) = i + j > 30 || random.uniform(0.0, 1.0) < 0.02 ? 1 : 0;
      if (i % 2 == 0 && j % 2 == 0) known(i, j) = mask(i, j);
    }
  }
  Grid<std::uint8_t> again;
  EXPECT_TRUE(decode_voids(encode_voids(mask, known), known, again));
  EXPECT_EQ(again, mask);
}

struct Coded {
  PatchLayout layout;
  Quantiser quantiser;
  terrain::HeightGrid grid;

  Coded(int columns, int rows, bool voids, StepRule rule, double error_m = 0.5)
      : layout(layout_of(columns, rows, 16)), quantiser(), grid(hills(columns, rows, voids)) {
    quantiser = quantiser_for(grid, error_m, rule);
  }
  PatchNumbers numbers(const PatchPlace& place) const {
    return numbers_of(grid, layout, place, quantiser);
  }
};

void expect_same(const PatchNumbers& a, const PatchNumbers& b) {
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.voids, b.voids);
}

TEST(ModelledPatch, IsWhatItWas) {
  for (const auto& [columns, rows, voids, error] : {std::tuple{97, 65, false, 0.5},
                                                    {97, 65, true, 0.5},
                                                    {50, 91, true, 0.003},
                                                    {20, 3, true, 9.0}}) {
    const Coded coded(columns, rows, voids, StepRule::Same, error);
    SymbolCounts counts;
    const auto place_in = [](const PatchPlace& p) {
      return ChildPlace{p.px & 1, p.py & 1, p.level};
    };
    for (std::int64_t k = 1; k < coded.layout.patch_count(); ++k) {
      const PatchPlace p = coded.layout.place(k);
      count_symbols(coded.numbers(p.parent()), place_in(p), coded.numbers(p), counts);
    }
    ModelTables tables;
    for (std::size_t m = 0; m < kModels; ++m)
      tables.tables.emplace_back(rans_frequencies(counts.counts[m]));
    PatchNumbers root;
    ASSERT_TRUE(
        decode_root(encode_root(coded.numbers(coded.layout.root())), 16, StepRule::Same, root));
    expect_same(root, coded.numbers(coded.layout.root()));
    for (std::int64_t k = 1; k < coded.layout.patch_count(); ++k) {
      const PatchPlace p = coded.layout.place(k);
      const PatchNumbers parent = coded.numbers(p.parent()), child = coded.numbers(p);
      const Bytes bytes = encode_child(parent, place_in(p), child, tables);
      PatchNumbers again;
      ASSERT_TRUE(decode_child(parent, place_in(p), bytes, tables, again)) << k;
      expect_same(again, child);
      // A byte less, or one more, is no record.
      const std::span<const std::uint8_t> all(bytes);
      if (bytes.size() > 1) {
        EXPECT_FALSE(decode_child(parent, place_in(p), all.first(bytes.size() - 1), tables, again));
      }
      Bytes longer = bytes;
      longer.push_back(0);
      EXPECT_FALSE(decode_child(parent, place_in(p), longer, tables, again));
    }
  }
}

TEST(PublishedFamily, IsWhatItWas) {
  for (const auto& [columns, rows, voids, error] : {std::tuple{97, 65, false, 0.5},
                                                    {97, 65, true, 0.5},
                                                    {50, 91, true, 0.003},
                                                    {20, 3, true, 9.0}}) {
    const Coded coded(columns, rows, voids, StepRule::DoublesWithLevel, error);
    for (std::int64_t k = 0; k < coded.layout.patch_count(); ++k) {
      const PatchPlace p = coded.layout.place(k);
      if (p.level == 0) continue;
      Family children;
      std::array<bool, 4> there{};
      for (int c = 0; c < 4; ++c) {
        const PatchPlace child = p.child(c & 1, c >> 1);
        there[static_cast<std::size_t>(c)] = coded.layout.contains(child);
        if (coded.layout.contains(child))
          children[static_cast<std::size_t>(c)] = coded.numbers(child);
      }
      const PatchNumbers parent = coded.numbers(p);
      const Bytes bytes = encode_family(parent, children);
      Family again;
      ASSERT_TRUE(decode_family(parent, there, bytes, again));
      for (std::size_t c = 0; c < 4; ++c) {
        ASSERT_EQ(again[c].has_value(), there[c]);
        if (there[c]) expect_same(*again[c], *children[c]);
      }
    }
  }
}

// Bytes that nobody wrote are decoded to something, or to nothing, but never to harm.
TEST(PatchCodec, SurvivesRandomBytes) {
  Random random(77);
  const RansTable alike(rans_frequencies(std::array<std::uint64_t, kRansSymbols>{}));
  const ModelTables tables{std::vector<RansTable>(kModels, alike)};
  PatchNumbers parent{Grid<std::int32_t>(19, 19, most_number(StepRule::Same)), {}};
  PatchNumbers deep{Grid<std::int32_t>(19, 19, -most_number(StepRule::DoublesWithLevel)), {}};
  for (int round = 0; round < 300; ++round) {
    Bytes bytes;
    for (int k = random.integer(0, 600); k > 0; --k)
      bytes.push_back(static_cast<std::uint8_t>(random.integer(0, 255)));
    if (!bytes.empty() && random.chance(0.8)) bytes.front() = static_cast<std::uint8_t>(round % 3);
    PatchNumbers child;
    decode_child(parent, {1, 0, 0}, bytes, tables, child);
    decode_root(bytes, 16, StepRule::Same, child);
    Family family;
    decode_family(deep, {true, false, true, true}, bytes, family);
    for (const auto& each : family) {
      if (!each) continue;
      for (const std::int32_t q : each->q.values())
        EXPECT_LE(std::abs(q), most_number(StepRule::DoublesWithLevel));
    }
  }
}

}  // namespace
}  // namespace plumb::mesh::patch_quadtree
