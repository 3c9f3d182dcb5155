// Each stage of FLIP by itself, with every instruction set, on what can be computed by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compare/flip.h"
#include "compare/flip_kernels.h"
#include "support/flip_pictures.h"

namespace plumb::compare {
namespace {

using Row = std::vector<float>;

class FlipStages : public ::testing::TestWithParam<InstructionSet> {
 protected:
  const FlipKernels& kernels = flip_kernels(GetParam());
  const FlipConstants& constants = flip_constants();

  // A colour goes through a stage that works in place, whatever its lane.
  template <class Stage>
  glm::dvec3 through(const glm::dvec3& colour, const Stage& stage) const {
    Row rows[3];
    for (int c = 0; c < 3; ++c) rows[c].assign(kFlipLanes, static_cast<float>(colour[c]));
    float* const in_place[] = {rows[0].data(), rows[1].data(), rows[2].data()};
    stage(in_place);
    for (const Row& row : rows) EXPECT_EQ(row, Row(kFlipLanes, row[0]));
    return {rows[0][0], rows[1][0], rows[2][0]};
  }
  glm::dvec3 opponent(const glm::dvec3& rgb) const {
    return through(rgb, [&](float* const c[3]) { kernels.to_opponent(constants, kFlipLanes, c); });
  }
  glm::dvec3 hunt_lab(const glm::dvec3& seen) const {
    return through(seen, [&](float* const c[3]) { kernels.to_hunt_lab(constants, kFlipLanes, c); });
  }
  float colour_difference(const glm::dvec3& a, const glm::dvec3& b) const {
    Row rows[6];
    for (int c = 0; c < 3; ++c) {
      rows[c].assign(kFlipLanes, static_cast<float>(a[c]));
      rows[3 + c].assign(kFlipLanes, static_cast<float>(b[c]));
    }
    const float* const reference[] = {rows[0].data(), rows[1].data(), rows[2].data()};
    const float* const candidate[] = {rows[3].data(), rows[4].data(), rows[5].data()};
    Row out(kFlipLanes);
    kernels.differ_in_colour(constants, reference, candidate, kFlipLanes, out.data());
    return out[0];
  }
};

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << c;
}

// The relative error of a power of 2.4 is below 1e-6: log2 is good to three roundings of numbers up
// to 5 (9e-7), times 2.4 ln 2 where x is dark, and the power of 2 to three more.
TEST_P(FlipStages, MakesSrgbLinear) {
  Row codes(256 + kFlipLanes, 0.0f), linear(codes.size());
  for (int k = 0; k < 256; ++k) codes[k] = static_cast<float>(k) / 255.0f;
  const float others[] = {-1.0f, 2.0f, 0.04045f, 0.5f, 1e-9f, 1e30f};
  std::copy(std::begin(others), std::end(others), codes.begin() + 256);
  kernels.linearise(codes.data(), static_cast<int>(codes.size()), linear.data());
  for (std::size_t k = 0; k < codes.size(); ++k) {
    const double expected = testing::slow_linear(static_cast<double>(codes[k]));
    EXPECT_NEAR(linear[k], expected, 1.5e-6 * expected) << codes[k];
  }
  EXPECT_EQ(linear[0], 0.0f);
  EXPECT_EQ(linear[255], 1.0f);
  EXPECT_EQ(linear[256], 0.0f);
  EXPECT_EQ(linear[257], 1.0f);
  EXPECT_NEAR(linear[259], 0.214041, 1e-6);  // the usual example
}

TEST_P(FlipStages, TurnsRgbIntoOpponentColours) {
  expect_near(opponent({0, 0, 0}), {0, 0, 0}, 0.0);
  expect_near(opponent({1, 1, 1}), {1, 0, 0}, 1e-7);
  // Red has XYZ (0.4124, 0.2126, 0.0193) and white (0.9504, 1, 1.0889).
  expect_near(opponent({1, 0, 0}), {0.2126, 0.4124 / 0.9504 - 0.2126, 0.2126 - 0.0193 / 1.0889},
              1e-4);
  testing::FlipNumbers numbers(1);
  for (int k = 0; k < 100; ++k) {
    const glm::dvec3 rgb(numbers.next(), numbers.next(), numbers.next());
    const glm::dvec3 slow = testing::slow_ycxcz(rgb);
    expect_near(opponent(rgb), {(slow.x + 16.0) / 116.0, slow.y / 500.0, slow.z / 200.0}, 2e-7);
  }
}

TEST_P(FlipStages, TurnsWhatIsSeenIntoLabWithHuntsAdjustment) {
  expect_near(hunt_lab({1, 0, 0}), {100, 0, 0}, 1e-4);
  expect_near(hunt_lab({0, 0, 0}), {0, 0, 0}, 1e-5);
  // L*a*b* of green and blue as tables have them, a* and b* times L* / 100. Tables come from XYZ of
  // four digits: 5e-5 times 500 / (3 t^(2/3)), with Hunt's factor 0.016 for either colour.
  expect_near(hunt_lab(opponent({0, 1, 0})), {87.735, -86.183 * 0.87735, 83.179 * 0.87735}, 0.016);
  expect_near(hunt_lab(opponent({0, 0, 1})), {32.297, 79.188 * 0.32297, -107.860 * 0.32297}, 0.016);
  testing::FlipNumbers numbers(2);
  for (int k = 0; k < 200; ++k) {
    // From far outside what a screen can show to well inside; very dark ones too.
    const double scale = k % 4 == 0 ? 0.01 : 2.0;
    const glm::dvec3 rgb =
        scale * (glm::dvec3(numbers.next(), numbers.next(), numbers.next()) - 0.25);
    const glm::dvec3 slow = testing::slow_ycxcz(rgb);
    const glm::dvec3 seen((slow.x + 16.0) / 116.0, slow.y / 500.0, slow.z / 200.0);
    // Sums of float32 up to 3 are off by 4e-7 and a cube root, at its steepest 7.8 times that, by
    // 3e-6; 500 times as much in a* and b*.
    expect_near(hunt_lab(seen), testing::slow_hunt_lab(glm::clamp(rgb, 0.0, 1.0)), 2e-3);
  }
}

TEST_P(FlipStages, MeasuresColoursByHyab) {
  const double most = flip_largest_difference(), knee = 0.4 * most;
  EXPECT_EQ(colour_difference({50, 3, 4}, {50, 3, 4}), 0.0f);
  // |50 - 48| + |(3, 4)| = 7.
  EXPECT_NEAR(colour_difference({50, 3, 4}, {48, 0, 0}), 0.95 * std::pow(7.0, 0.7) / knee, 1e-6);
  EXPECT_EQ(colour_difference({50, 3, 4}, {48, 0, 0}), colour_difference({48, 0, 0}, {50, 3, 4}));
  // At the knee 0.95, halfway from there to the largest 0.975, at the largest 1.
  const auto at = [&](double difference) {
    return colour_difference({std::pow(difference, 1.0 / 0.7), 0, 0}, {0, 0, 0});
  };
  EXPECT_NEAR(at(knee), 0.95, 2e-6);
  EXPECT_NEAR(at(0.5 * (knee + most)), 0.975, 2e-6);
  EXPECT_NEAR(at(most), 1.0, 2e-6);
  EXPECT_EQ(at(2.0 * most), 1.0f);
}

// The four detectors' answers along the middle row of a picture of 48 x 48 luminances.
struct Responses {
  Row rows[kFlipResponses];
};

Responses responses(const FlipKernels& kernels, const FlipFilters& filters,
                    const std::function<double(int, int)>& luminance) {
  constexpr int kSize = 48;
  std::vector<Row> grey(kSize, Row(kSize)), none(kSize, Row(kSize, 0.0f));
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) grey[y][x] = static_cast<float>(luminance(x, y));
  }
  std::vector<const float*> up[3], down[3];
  for (int p = 0; p < 3; ++p) {
    for (int k = 0; k <= filters.reach; ++k) {
      up[p].push_back((p == 0 ? grey : none)[kSize / 2 - k].data());
      down[p].push_back((p == 0 ? grey : none)[kSize / 2 + k].data());
    }
  }
  const float* const* above[] = {up[0].data(), up[1].data(), up[2].data()};
  const float* const* below[] = {down[0].data(), down[1].data(), down[2].data()};
  std::vector<Row> between(kFlipFilters, Row(kSize + 2 * filters.reach, 0.0f));
  float* filtered[kFlipFilters];
  for (int f = 0; f < kFlipFilters; ++f) filtered[f] = between[f].data() + filters.reach;
  kernels.filter_down(filters.taps(), above, below, kSize, filtered);
  for (float* row : filtered) {
    std::fill(row - filters.reach, row, row[0]);
    std::fill(row + kSize, row + kSize + filters.reach, row[kSize - 1]);
  }
  const float* in[kFlipFilters];
  std::copy(std::begin(filtered), std::end(filtered), in);
  Responses result;
  float* out[kFlipResponses];
  for (int k = 0; k < kFlipResponses; ++k) {
    result.rows[k].resize(kSize);
    out[k] = result.rows[k].data();
  }
  kernels.filter_across(filters.taps(), in, kSize, out);
  return result;
}

// Light from column 24 on. There the edge detector's whole bright half meets light and its dark
// half none: 1. Beside it, what of that half is still in the light.
TEST_P(FlipStages, SeesAStepAsAnEdge) {
  const FlipFilters filters = flip_filters(kFlipPixelsPerDegree);
  const Responses step =
      responses(kernels, filters, [](int x, int) { return x >= 24 ? 1.0 : 0.0; });
  EXPECT_NEAR(step.rows[kEdgeX][24], 1.0, 1e-6);
  double still_lit = 1.0;
  for (int d = 1; d <= filters.reach; ++d) {
    // The step lies between 23 and 24: 23 sees what 24 sees. From there tap after tap leaves it.
    EXPECT_NEAR(step.rows[kEdgeX][24 - d], still_lit, 1e-6) << d;
    still_lit -= filters.half[kEdge][d];
  }
  for (int x = 0; x < 48; ++x) {
    EXPECT_EQ(step.rows[kEdgeY][x], 0.0f);
    EXPECT_EQ(step.rows[kPointY][x], 0.0f);
  }
  const Responses turned =
      responses(kernels, filters, [](int, int y) { return y >= 24 ? 1.0 : 0.0; });
  EXPECT_NEAR(turned.rows[kEdgeY][10], 1.0, 1e-6);
  EXPECT_EQ(turned.rows[kEdgeX][10], 0.0f);
}

// One lit pixel shows the filters themselves.
TEST_P(FlipStages, SeesADotAsAPoint) {
  const FlipFilters filters = flip_filters(kFlipPixelsPerDegree);
  const auto& half = filters.half;
  const Responses dot =
      responses(kernels, filters, [](int x, int y) { return x == 24 && y == 24 ? 1.0 : 0.0; });
  for (int d = 0; d <= filters.reach; ++d) {
    EXPECT_NEAR(dot.rows[kPointX][24 + d], half[kPoint][d] * half[kGauss][0], 1e-7) << d;
    EXPECT_NEAR(dot.rows[kPointY][24 - d], half[kPoint][0] * half[kGauss][d], 1e-7) << d;
    EXPECT_NEAR(dot.rows[kEdgeX][24 - d], half[kEdge][d] * half[kGauss][0], 1e-7) << d;
    EXPECT_NEAR(dot.rows[kSeenY][24 + d], half[kLuminance][d] * half[kLuminance][0], 1e-7) << d;
    EXPECT_EQ(dot.rows[kSeenCx][24 + d], 0.0f);
  }
  EXPECT_EQ(dot.rows[kEdgeX][24], 0.0f);
  EXPECT_LT(dot.rows[kPointX][24], -0.03);
}

TEST_P(FlipStages, SeesNothingInEvenLight) {
  const FlipFilters filters = flip_filters(kFlipPixelsPerDegree);
  const Responses even = responses(kernels, filters, [](int, int) { return 0.7; });
  for (int x = 0; x < 48; ++x) {
    for (const int detector : {kEdgeX, kEdgeY, kPointX, kPointY})
      EXPECT_EQ(even.rows[detector][x], 0.0f);
    EXPECT_NEAR(even.rows[kSeenY][x], 0.7, 3e-7);
  }
}

TEST_P(FlipStages, TakesTheLargerDifferenceOfFeatures) {
  const auto difference = [&](const float(&a)[4], const float(&b)[4]) {
    Row rows[8];
    const float *reference[4], *candidate[4];
    for (int k = 0; k < 4; ++k) {
      rows[k].assign(kFlipLanes, a[k]);
      rows[4 + k].assign(kFlipLanes, b[k]);
      reference[k] = rows[k].data();
      candidate[k] = rows[4 + k].data();
    }
    Row out(kFlipLanes);
    kernels.differ_in_features(reference, candidate, kFlipLanes, out.data());
    return out[0];
  };
  const double root_half = std::sqrt(0.5);
  // Edges of 1 and 0.5 (the directions do not matter), points of 0.1 and 0.
  EXPECT_NEAR(difference({0.6f, -0.8f, 0.1f, 0.0f}, {0.5f, 0.0f, 0.0f, 0.0f}),
              std::sqrt(0.5 * root_half), 1e-6);
  EXPECT_NEAR(difference({0.0f, 0.0f, 0.3f, 0.4f}, {0.0f, 0.1f, 0.0f, 0.0f}),
              std::sqrt(0.5 * root_half), 1e-6);
  EXPECT_EQ(difference({0.6f, 0.8f, 0.1f, 0.2f}, {-0.8f, 0.6f, -0.2f, 0.1f}), 0.0f);
}

TEST_P(FlipStages, RaisesTheColourDifferenceToWhatTheFeaturesLeave) {
  const float colours[] = {0.25f, 0.0f, 0.3f, 0.3f, 1.0f, 0.5f};
  const float features[] = {0.5f, 0.5f, 0.0f, 1.0f, 0.3f, 0.75f};
  const double expected[] = {0.5, 0.0, 0.3, 1.0, 1.0, std::pow(0.5, 0.25)};
  Row colour(kFlipLanes, 0.0f), feature(kFlipLanes, 0.0f), error(kFlipLanes);
  std::copy(std::begin(colours), std::end(colours), colour.begin());
  std::copy(std::begin(features), std::end(features), feature.begin());
  kernels.combine(colour.data(), feature.data(), kFlipLanes, error.data());
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(error[k], expected[k], 1e-6) << k;
  EXPECT_EQ(error[1], 0.0f);
}

INSTANTIATE_TEST_SUITE_P(All, FlipStages, ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace plumb::compare
