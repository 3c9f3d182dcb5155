// What the tessellation stage gives: our tessellator and Mesa's, given the same factors.
#include <gtest/gtest.h>

#include <cstdio>
#include <optional>

#include "mesh/tessellation/tessellator.h"
#include "support/gl_tessellator.h"
#include "support/random_factors.h"

namespace plumb::mesh::tessellation {
namespace {

using test_support::GlSpacing;
using test_support::GlTessellation;
using test_support::GlTessellator;
using test_support::Random;
using test_support::SoftwareGl;

using Place = std::array<float, 2>;

Place place_of(const DomainPoint& point) {  // exact: 17 bits at most
  return {static_cast<float>(point.u) * 0x1p-16f, static_cast<float>(point.v) * 0x1p-16f};
}

std::vector<Place> points_of(const Tessellation& t) {
  std::vector<Place> places;
  for (const DomainPoint& point : t.points) places.push_back(place_of(point));
  return places;
}

std::vector<Place> corners_of(const Tessellation& t) {
  std::vector<Place> places;
  for (const auto& triangle : t.triangles) {
    for (const std::uint32_t corner : triangle) places.push_back(place_of(t.points[corner]));
  }
  return places;
}

std::string words(const Factors& factors) {
  std::string text;
  for (const float factor : factors.outer) text += std::to_string(factor) + " ";
  text += "|";
  for (const float factor : factors.inner) text += " " + std::to_string(factor);
  return text;
}

class TessellationBesideMesa : public testing::Test {
 protected:
  void SetUp() override {
    std::string why_not;
    gl_ = SoftwareGl::create(why_not);
    if (!gl_) GTEST_SKIP() << why_not;
    stage_.emplace(*gl_);
  }
  void TearDown() override { stage_.reset(); }

  // Points and triangles, the order of both and that of each triangle's corners.
  bool equal(Spacing spacing, GlSpacing gl_spacing, const Factors& factors) {
    tessellate(spacing, factors, ours_);
    const GlTessellation theirs = stage_->tessellate(gl_spacing, factors.outer, factors.inner);
    triangles_ += ours_.triangles.size();
    culled_ += ours_.triangles.empty() ? 1 : 0;
    return points_of(ours_) == theirs.points && corners_of(ours_) == theirs.corners;
  }
  void expect_equal_on_random_factors(Spacing spacing, GlSpacing gl_spacing) {
    constexpr int kPatches = 6000;
    Random random(11);
    int differ = 0;
    for (int k = 0; k < kPatches; ++k) {
      const Factors factors = test_support::random_factors(random, true);
      if (equal(spacing, gl_spacing, factors)) continue;
      if (++differ <= 3) ADD_FAILURE() << words(factors);
    }
    EXPECT_EQ(differ, 0) << gl_->renderer();
    EXPECT_GT(culled_, kPatches / 100);
    EXPECT_GT(triangles_, 1000u * kPatches);
    std::printf("%d patches, %d culled, %zu triangles, %d differ\n", kPatches, culled_, triangles_,
                differ);
  }
  std::unique_ptr<SoftwareGl> gl_;
  std::optional<GlTessellator> stage_;
  Tessellation ours_;
  std::size_t triangles_ = 0;
  int culled_ = 0;
};

TEST_F(TessellationBesideMesa, IsEqualForIntegerSpacing) {
  expect_equal_on_random_factors(Spacing::Integer, GlSpacing::Equal);
}
TEST_F(TessellationBesideMesa, IsEqualForFractionalOddSpacing) {
  expect_equal_on_random_factors(Spacing::FractionalOdd, GlSpacing::FractionalOdd);
}
TEST_F(TessellationBesideMesa, IsEqualForFractionalEvenSpacing) {
  expect_equal_on_random_factors(Spacing::FractionalEven, GlSpacing::FractionalEven);
}

TEST_F(TessellationBesideMesa, IsEqualForPairsOfInnerFactors) {
  for (int u = 1; u <= 64; ++u) {
    for (int v = 1; v <= 64; v += u % 7 == 0 ? 1 : 5) {
      const Factors factors{{3, 5, 8, 2}, {static_cast<float>(u), static_cast<float>(v)}};
      EXPECT_TRUE(equal(Spacing::Integer, GlSpacing::Equal, factors)) << words(factors);
    }
  }
}

// Those whose checksums the unit test holds; edges that run back beside the middle; the least
// factors that divide a square.
TEST_F(TessellationBesideMesa, IsEqualAtRemarkableFactors) {
  std::vector<Factors> cases{{{64.0f, 1.5f, 17.25f, 33.0f}, {13.7f, 41.0f}}};
  for (const float base : {1.0f, 2.0f, 6.0f, 30.0f, 62.0f, 63.0f, 64.0f}) {
    for (const float more : {0.0f, 0x1p-18f, 0x1p-17f, 0x1.8p-17f, 0x1p-16f, 0x1p-15f, 0x1p-8f}) {
      const float factor = base + more;
      cases.push_back({{factor, factor, factor, factor}, {factor, factor}});
      cases.push_back({{factor, 1.0f, 1.0f, 1.0f}, {1.0f, 1.0f}});
    }
  }
  for (const Factors& factors : cases) {
    EXPECT_TRUE(equal(Spacing::Integer, GlSpacing::Equal, factors)) << words(factors);
    EXPECT_TRUE(equal(Spacing::FractionalOdd, GlSpacing::FractionalOdd, factors)) << words(factors);
    EXPECT_TRUE(equal(Spacing::FractionalEven, GlSpacing::FractionalEven, factors))
        << words(factors);
  }
}

// OpenGL has no such spacing; where factors are powers of two it is that of whole numbers.
TEST_F(TessellationBesideMesa, IsEqualForPowersOfTwo) {
  Random random(12);
  for (int k = 0; k < 500; ++k) {
    Factors factors{};
    for (float& factor : factors.outer) factor = static_cast<float>(1 << random.integer(0, 6));
    for (float& factor : factors.inner) factor = static_cast<float>(1 << random.integer(0, 6));
    EXPECT_TRUE(equal(Spacing::PowerOfTwo, GlSpacing::Equal, factors)) << words(factors);
  }
}

}  // namespace
}  // namespace plumb::mesh::tessellation
