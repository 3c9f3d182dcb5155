// Properties of the tessellator: those that conformance suites ask of any ([VK-GL-CTS], invariance
// of tessellation), but exactly, and a cover of the square without gap or overlap.
#include "mesh/tessellation/tessellator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "support/random_factors.h"

namespace plumb::mesh::tessellation {
namespace {

using test_support::Random;

constexpr int kPatches = 6000;
constexpr std::uint32_t kOne = 65536;
constexpr std::array<Spacing, 4> kSpacings{Spacing::Integer, Spacing::PowerOfTwo,
                                           Spacing::FractionalOdd, Spacing::FractionalEven};

bool fractional(Spacing spacing) {
  return spacing == Spacing::FractionalOdd || spacing == Spacing::FractionalEven;
}

// The factor in range, as the headers of both interfaces word it.
float clamped(Spacing spacing, float factor) {
  const float low = spacing == Spacing::FractionalEven ? 2.0f : 1.0f;
  const float high = spacing == Spacing::FractionalOdd ? 63.0f : 64.0f;
  if (std::isnan(factor)) return low;
  float result = std::clamp(factor, low, high);
  if (!fractional(spacing)) result = std::ceil(result);
  if (spacing == Spacing::PowerOfTwo) result = std::exp2(std::ceil(std::log2(result)));
  return result;
}

// The segments of an edge: the next whole number, odd or even number, or power of two. In
// fractional spacing, of the factor as a multiple of 2^-16.
int segments(Spacing spacing, float factor) {
  double level = clamped(spacing, factor);
  if (fractional(spacing)) level = std::nearbyint(level * 65536.0) / 65536.0;
  int count = spacing == Spacing::FractionalEven ? 2 : 1;
  while (count < level) count += fractional(spacing) ? 2 : 1;
  return count;
}

bool culled(const Factors& factors) {
  return !std::ranges::all_of(factors.outer, [](float factor) { return factor > 0.0f; });
}

// Calls check(spacing, factors, tessellation) for every patch that is drawn.
template <class Check>
void for_random_patches(const Check& check) {
  for (const Spacing spacing : kSpacings) {
    Random random(21);
    Tessellation t;
    int drawn = 0;
    for (int k = 0; k < kPatches && !testing::Test::HasFailure(); ++k) {
      const Factors factors = test_support::random_factors(random, true);
      tessellate(spacing, factors, t);
      EXPECT_EQ(t.triangles.empty(), culled(factors));
      EXPECT_EQ(t.points.empty(), culled(factors));
      if (t.triangles.empty()) continue;
      ++drawn;
      check(spacing, factors, t);
    }
    EXPECT_GT(drawn, kPatches / 2);
  }
}

struct Rim {
  std::uint32_t points = 0;
  std::array<std::vector<std::uint32_t>, 4> edges;  // places, rising from 0 to kOne
};

// The rim comes first, from (0, 1) counter-clockwise; that of an undivided square from (0, 0).
Rim rim_of(Spacing spacing, const Factors& factors, const Tessellation& t) {
  Rim rim;
  std::array<std::uint32_t, 4> count{};
  for (std::size_t k = 0; k < 4; ++k)
    rim.points += count[k] = static_cast<std::uint32_t>(segments(spacing, factors.outer[k]));
  std::uint32_t at = t.points.size() == 4 ? 3 : 0;
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::uint32_t i = 0; i <= count[k]; ++i) {
      const DomainPoint& point = t.points[(at + i) % rim.points];
      EXPECT_EQ(k % 2 == 0 ? point.u : point.v, k < 2 ? 0 : kOne);
      rim.edges[k].push_back(k % 2 == 0 ? point.v : point.u);
    }
    at += count[k];
    if (k == 0 || k == 3) std::ranges::reverse(rim.edges[k]);
  }
  return rim;
}

TEST(TessellatorProperty, GivesTheSameForTheSameClampedFactors) {
  for_random_patches([](Spacing spacing, const Factors& factors, const Tessellation& t) {
    Factors same = factors;
    for (float& factor : same.outer) factor = clamped(spacing, factor);
    for (float& factor : same.inner) factor = clamped(spacing, factor);
    const Tessellation again = tessellate(spacing, same);
    EXPECT_EQ(again.points, t.points);
    EXPECT_EQ(again.triangles, t.triangles);
  });
}

TEST(TessellatorProperty, PlacesTheEdgesOfEachPatchByTheirOwnFactorsAlone) {
  for_random_patches([](Spacing spacing, const Factors& factors, const Tessellation& t) {
    const Rim rim = rim_of(spacing, factors, t);
    for (std::size_t k = 0; k < 4; ++k) {
      const float own = factors.outer[k];
      const Factors alike{{own, own, own, own}, {own, own}};
      EXPECT_EQ(rim.edges[k], rim_of(spacing, alike, tessellate(spacing, alike)).edges[3 - k]);
    }
  });
}

TEST(TessellatorProperty, PlacesTheInsideByTheInnerFactorsAlone) {
  for_random_patches([](Spacing spacing, const Factors& factors, const Tessellation& t) {
    if (t.points.size() == 4) return;
    Factors other = factors;
    other.outer = {5.0f, 64.0f, 2.5f, 1.0f};
    const Tessellation u = tessellate(spacing, other);
    const std::uint32_t rim = rim_of(spacing, factors, t).points;
    const std::uint32_t other_rim = rim_of(spacing, other, u).points;
    EXPECT_TRUE(std::equal(t.points.begin() + rim, t.points.end(), u.points.begin() + other_rim,
                           u.points.end()));
    // Triangles that do not touch the rim are the last, and the same but for their numbering.
    auto b = u.triangles.rbegin();
    for (auto a = t.triangles.rbegin(); a != t.triangles.rend(); ++a, ++b) {
      if (std::ranges::any_of(*a, [&](std::uint32_t corner) { return corner < rim; })) break;
      ASSERT_TRUE(b != u.triangles.rend());
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ((*a)[c] - rim, (*b)[c] - other_rim);
    }
  });
}

// Just above 6 and 30 the new segment begins beside the middle, where rounded reciprocals have
// summed up to 3 * 10923 = 32769 and 15 * 2185 = 32775 instead of 32768: the edge runs back by as
// much. At 30 + f the place is 32775 - 2055 f / 2, rounded, and no longer above the middle once f
// is 0.0073.
bool runs_back(Spacing spacing, float factor) {
  const float level = clamped(spacing, factor);
  return spacing == Spacing::FractionalEven &&
         ((level > 6.0f && level < 6.0005f) || (level > 30.0f && level < 30.0075f));
}

// The rounded reciprocal of a number of segments is off by half a unit at most, so a place, at most
// 32 of them away from its end, by 16 and its own rounding, a half; a segment between two such by
// 33. Conformance suites allow 0.001, which is 65.
TEST(TessellatorProperty, HasEdgesThatAreSymmetricAndOfTwoLengthsAtMost) {
  static constexpr int kTolerance = 33;
  for_random_patches([](Spacing spacing, const Factors& factors, const Tessellation& t) {
    const Rim rim = rim_of(spacing, factors, t);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::vector<std::uint32_t>& edge = rim.edges[k];
      std::vector<int> lengths;
      for (std::size_t i = 0; i < edge.size(); ++i) {
        EXPECT_EQ(edge[i] + edge[edge.size() - 1 - i], kOne);
        if (i > 0) lengths.push_back(static_cast<int>(edge[i]) - static_cast<int>(edge[i - 1]));
      }
      std::ranges::sort(lengths);
      EXPECT_GE(lengths[0], runs_back(spacing, factors.outer[k]) ? -7 : 0);
      const std::size_t shorter = fractional(spacing) && lengths.size() > 2 ? 2 : 0;
      EXPECT_LE(lengths.back() - lengths[shorter], kTolerance);
      EXPECT_TRUE(shorter == 0 || lengths[1] - lengths[0] <= kTolerance);
    }
  });
}

TEST(TessellatorProperty, PlacesPowersOfTwoExactly) {
  for (std::uint32_t n = 1; n <= 64; n *= 2) {
    const auto factor = static_cast<float>(n);
    const Factors factors{{factor, factor, factor, factor}, {factor, factor}};
    const Tessellation t = tessellate(Spacing::Integer, factors);
    for (const std::vector<std::uint32_t>& edge : rim_of(Spacing::Integer, factors, t).edges) {
      for (std::uint32_t k = 0; k <= n; ++k) EXPECT_EQ(edge[k], k * (kOne / n));
    }
    for (const DomainPoint& point : t.points) {
      EXPECT_EQ(point.u % (kOne / n), 0u);
      EXPECT_EQ(point.v % (kOne / n), 0u);
    }
    EXPECT_EQ(tessellate(Spacing::PowerOfTwo, factors).points, t.points);
    EXPECT_EQ(tessellate(Spacing::PowerOfTwo, factors).triangles, t.triangles);
  }
}

// At equal factors, as bounds on the error of a block rely on; in a middle row or column either
// way is as near.
TEST(TessellatorProperty, LeansDiagonalsToTheCentre) {
  for (int n = 2; n <= 64; ++n) {
    const auto factor = static_cast<float>(n);
    const Tessellation t =
        tessellate(Spacing::Integer, {{factor, factor, factor, factor}, {factor, factor}});
    for (const auto& triangle : t.triangles) {
      for (std::size_t c = 0; c < 3; ++c) {
        const DomainPoint a = t.points[triangle[c]], b = t.points[triangle[(c + 1) % 3]];
        if (a.u == b.u || a.v == b.v || a.u + b.u == kOne || a.v + b.v == kOne) continue;
        const bool rising = (a.u < b.u) == (a.v < b.v);
        EXPECT_EQ(rising, (a.u + b.u < kOne) == (a.v + b.v < kOne)) << n;
      }
    }
  }
}

// ---- the cover

// Twice the area, in units of the domain; positive if counter-clockwise.
std::int64_t twice_area(const Tessellation& t, const std::array<std::uint32_t, 3>& triangle) {
  const auto at = [&](std::size_t c) { return t.points[triangle[c]]; };
  const auto less = [](std::uint32_t a, std::uint32_t b) { return std::int64_t{a} - b; };
  return less(at(1).u, at(0).u) * less(at(2).v, at(0).v) -
         less(at(2).u, at(0).u) * less(at(1).v, at(0).v);
}

// A new segment has no length while it is short of half a unit, which 1/256 above a whole number
// it never is: that is 128 units of the half side's share, and the segment a 64th of it or more.
bool just_above_whole(Spacing spacing, float factor) {
  const float level = clamped(spacing, factor);
  return level > std::floor(level) && level - std::floor(level) < 1.0f / 256.0f;
}

// Whether a patch has segments that may be without length, or run back.
bool has_short_segments(Spacing spacing, const Factors& factors) {
  const auto short_segment = [&](float factor) {
    // An undivided inside is framed as if it were just above one.
    return just_above_whole(spacing, factor) || runs_back(spacing, factor) ||
           (spacing == Spacing::FractionalOdd && clamped(spacing, factor) == 1.0f);
  };
  return fractional(spacing) && (std::ranges::any_of(factors.outer, short_segment) ||
                                 std::ranges::any_of(factors.inner, short_segment));
}

TEST(TessellatorProperty, CoversTheSquareOnceAndCounterClockwise) {
  std::size_t flat = 0, turned = 0, all = 0;
  for_random_patches([&](Spacing spacing, const Factors& factors, const Tessellation& t) {
    const auto back = [&](float factor) { return runs_back(spacing, factor); };
    const bool may_turn =
        std::ranges::any_of(factors.outer, back) || std::ranges::any_of(factors.inner, back);
    const bool may_be_flat = has_short_segments(spacing, factors);
    std::int64_t sum = 0;
    for (const auto& triangle : t.triangles) {
      const std::int64_t area = twice_area(t, triangle);
      EXPECT_TRUE(area > 0 || (area == 0 && may_be_flat) || (area < 0 && may_turn)) << area;
      flat += area == 0 ? 1 : 0;
      turned += area < 0 ? 1 : 0;
      sum += area;
    }
    EXPECT_EQ(sum, 2 * std::int64_t{kOne} * kOne);
    all += t.triangles.size();
  });
  std::printf("of %zu triangles %zu have no area, %zu run clockwise\n", all, flat, turned);
}

// Each direction of an edge is used once; the other direction too, but along the rim.
TEST(TessellatorProperty, SharesEveryEdgeInsideBetweenTwoTriangles) {
  constexpr std::size_t kMostPoints = 4225;
  std::vector<bool> used(kMostPoints * kMostPoints);
  for_random_patches([&](Spacing spacing, const Factors& factors, const Tessellation& t) {
    const std::uint32_t rim = rim_of(spacing, factors, t).points;
    ASSERT_LE(t.points.size(), kMostPoints);
    const auto for_edges = [&](const auto& visit) {
      for (const auto& triangle : t.triangles) {
        for (std::size_t c = 0; c < 3; ++c) visit(triangle[c], triangle[(c + 1) % 3]);
      }
    };
    for_edges([&](std::size_t a, std::size_t b) {
      ASSERT_LT(a, t.points.size());
      ASSERT_FALSE(used[a * kMostPoints + b]);
      used[a * kMostPoints + b] = true;
    });
    std::uint32_t alone = 0;
    for_edges([&](std::size_t a, std::size_t b) {
      if (used[b * kMostPoints + a]) return;
      ++alone;
      EXPECT_TRUE(a < rim && b == (a + 1) % rim);
    });
    EXPECT_EQ(alone, rim);
    for_edges([&](std::size_t a, std::size_t b) { used[a * kMostPoints + b] = false; });
  });
}

}  // namespace
}  // namespace plumb::mesh::tessellation
