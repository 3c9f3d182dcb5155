// What the rules of others measure, each by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>

#include "compare/others_bilinear.h"
#include "compare/others_fuzzy.h"
#include "compare/others_pixelmatch.h"
#include "compare/others_similarity.h"
#include "grey_pictures.h"
#include "support/random_scene.h"

namespace plumb::compare {
namespace {

using image::Rgb8Image;

// A square of `side` pixels of another grey in the middle of 32 x 32.
Rgb8Image square(int side, int grey = 200) {
  return drawn(32, 32, [=](int x, int y) {
    return x >= 10 && x < 10 + side && y >= 10 && y < 10 + side ? grey : 100;
  });
}

// The generator's own published answers for seed 4789.
TEST(ConformanceRandom, IsTheSequenceOfTheSuites) {
  ConformanceRandom words(4789);
  for (const std::uint32_t expected :
       {3694588092u, 3135240271u, 882874943u, 2108407657u, 376640368u, 1395362929u, 2611849801u,
        3151830690u, 901476922u, 989608184u})
    EXPECT_EQ(words.next(), expected);
  ConformanceRandom integers(4789);
  for (const int expected : {-6628, -6483, 802, -7758, -8463, 3165, 9216, 3107, 1851, 8707})
    EXPECT_EQ(integers.integer(-10000, 10000), expected);
  ConformanceRandom units(4789);
  for (const double expected : {0.763413, 0.679680, 0.288965, 0.854431, 0.403095})
    EXPECT_NEAR(units.unit(), expected, 0.5e-6);  // six digits are printed
}

TEST(FuzzySum, ForgivesFourCodes) {
  EXPECT_EQ(fuzzy_sum(even(100), even(104)), 0.0);
  EXPECT_GT(fuzzy_sum(even(100), even(105)), 0.0);
}

// 3 * 251^2 = 189003, whose square is 35722134009 = 8 * 2^32 + 1362395641: the suites multiply in
// 32 bits, so that white on black counts a third of a pixel, not nine.
TEST(FuzzySum, LosesWhatDoesNotFit32Bits) {
  EXPECT_DOUBLE_EQ(fuzzy_sum(even(0), even(255)), 196.0 * 1362395641.0 / std::pow(251, 4));
}

// A line as thin as a pixel: the ground that it hides is beside it, whichever picture has it. (The
// blur spreads a tenth of its 40 codes there, which are forgiven.)
TEST(FuzzySum, IsBlindToALineOfOnePixel) {
  const Rgb8Image line = drawn(32, 32, [](int x, int) { return x == 13 ? 140 : 100; });
  EXPECT_EQ(fuzzy_sum(square(0), line), 0.0);
  EXPECT_EQ(fuzzy_sum(line, square(0)), 0.0);
  const Rgb8Image band = drawn(32, 32, [](int x, int) { return x >= 13 && x < 17 ? 200 : 100; });
  EXPECT_GT(fuzzy_sum(square(0), band), 0.05);
}

// Moved by a pixel, every colour is found next to its place.
TEST(FuzzySum, IsBlindToAShiftOfOnePixel) {
  test_support::Random random(8);
  Rgb8Image wide = drawn(41, 40, [&](int, int) { return random.integer(0, 255); });
  const auto cut = [&](int from) {
    return drawn(40, 40, [&](int x, int y) {
      return wide.rgb[static_cast<std::size_t>(3 * (41 * y + x + from))];
    });
  };
  EXPECT_EQ(fuzzy_sum(cut(0), cut(1)), 0.0);
  EXPECT_EQ(bilinear_mismatches(cut(0), cut(1), 0), 0);
}

TEST(BilinearMismatches, ToleratesSevenCodes) {
  EXPECT_EQ(bilinear_mismatches(even(100), even(107)), 0);
  EXPECT_EQ(bilinear_mismatches(even(100), even(108)), 256);
  EXPECT_EQ(bilinear_mismatches(even(100), even(108), 8), 0);
  EXPECT_THROW(bilinear_mismatches(even(100), even(100), -1), std::invalid_argument);
  EXPECT_THROW(bilinear_mismatches(even(100), even(100), 256), std::invalid_argument);
}

// What lies at the rim of a defect has ground beside it: only the inside counts.
TEST(BilinearMismatches, CountTheInsideOfADefect) {
  EXPECT_EQ(bilinear_mismatches(square(0), square(2)), 0);
  EXPECT_EQ(bilinear_mismatches(square(0), square(3)), 1);
  EXPECT_EQ(bilinear_mismatches(square(0), square(12)), 100);
  EXPECT_EQ(bilinear_mismatches(square(12), square(0)), 100);
}

// Half a pixel along a slope of 20 codes a pixel: 10 from each neighbour, met between them.
TEST(BilinearMismatches, LooksBetweenPixels) {
  const Rgb8Image slope = drawn(12, 12, [](int x, int) { return 20 * x; });
  EXPECT_EQ(bilinear_mismatches(slope, drawn(12, 12, [](int x, int) { return 20 * x + 10; })), 0);
}

// Grey by grey the distance is the difference, weighed with 0.5053; 35215 * 0.1^2 is 352.15, so 26
// codes (341.6) are below and 27 (368.4) above.
TEST(PixelmatchCounts, HaveTheirThresholdBetween26And27) {
  EXPECT_EQ(pixelmatch_counts(even(100), even(126)).all, 0);
  EXPECT_EQ(pixelmatch_counts(even(100), even(127)).all, 256);
  EXPECT_EQ(pixelmatch_counts(even(100), even(127)).remaining, 256);
  EXPECT_EQ(pixelmatch_counts(even(100), even(127), 0.2).all, 0);
  EXPECT_THROW(pixelmatch_counts(even(1), even(1), 1.5), std::invalid_argument);
}

// One channel alone: 0.5053 y^2 + 0.299 i^2 + 0.1957 q^2 is 0.1601, 0.2498 and 0.0565 of its
// square; the roots of 352.15 over those are 46.9, 37.5 and 78.9.
TEST(PixelmatchCounts, WeighChannels) {
  const int below[3] = {46, 37, 78};
  for (std::size_t c = 0; c < 3; ++c) {
    Rgb8Image candidate = even(100);
    candidate.rgb[3 * 20 + c] = static_cast<std::uint8_t>(100 + below[c]);
    candidate.rgb[3 * 90 + c] = static_cast<std::uint8_t>(100 - below[c]);
    EXPECT_EQ(pixelmatch_counts(even(100), candidate).all, 0) << c;
    ++candidate.rgb[3 * 20 + c];
    --candidate.rgb[3 * 90 + c];
    EXPECT_EQ(pixelmatch_counts(even(100), candidate).all, 2) << c;
  }
}

// One pixel, everything around it of one colour: no edge.
TEST(PixelmatchCounts, KeepALonePixel) {
  EXPECT_EQ(pixelmatch_counts(square(0), square(1)).all, 1);
  EXPECT_EQ(pixelmatch_counts(square(0), square(1)).remaining, 1);
}

// A column between black and white, grey in one picture: a smoothed outline.
TEST(PixelmatchCounts, LeaveOutASmoothedEdge) {
  const Rgb8Image sharp = drawn(16, 16, [](int x, int) { return x < 8 ? 0 : 255; });
  const Rgb8Image smooth = drawn(16, 16, [](int x, int) { return x < 8 ? 0 : x == 8 ? 128 : 255; });
  for (const auto& counts : {pixelmatch_counts(sharp, smooth), pixelmatch_counts(smooth, sharp)}) {
    EXPECT_EQ(counts.all, 16);
    EXPECT_EQ(counts.remaining, 0);
  }
}

// A pixel that differs beside black ones, ground of ever other greys around: the black ones are an
// even area from four on, of which each has three like it.
TEST(PixelmatchCounts, NeedThreeLikePixelsForAnEvenArea) {
  const auto beside = [](int black, int grey) {
    return drawn(24, 24, [=](int x, int y) {
      const int k = 2 * (y - 10) + (x - 10);
      if (x >= 10 && x < 12 && y >= 10 && y < 12 && k < black) return 0;
      return x == 12 && y == 10 ? grey : 150 + (7 * x + 13 * y) % 50;
    });
  };
  EXPECT_EQ(pixelmatch_counts(beside(3, 100), beside(3, 140)).remaining, 1);
  EXPECT_EQ(pixelmatch_counts(beside(4, 100), beside(4, 140)).all, 1);
  EXPECT_EQ(pixelmatch_counts(beside(4, 100), beside(4, 140)).remaining, 0);
}

// Window by window, as the formula reads, variances as sums of squared deviations.
double slow_similarity(const Rgb8Image& a, const Rgb8Image& b) {
  double sum = 0.0;
  int count = 0;
  for (int c = 0; c < 3; ++c) {
    for (int top = 0; top + 7 <= a.height_px; ++top) {
      for (int left = 0; left + 7 <= a.width_px; ++left) {
        const auto mean = [&](const std::function<double(double, double)>& f) {
          double total = 0.0;
          for (int k = 0; k < 49; ++k) {
            const auto at =
                static_cast<std::size_t>(3 * ((top + k / 7) * a.width_px + left + k % 7) + c);
            total += f(a.rgb[at], b.rgb[at]);
          }
          return total / 49.0;
        };
        const double x = mean([](double p, double) { return p; });
        const double y = mean([](double, double q) { return q; });
        const double xx = mean([&](double p, double) { return (p - x) * (p - x); }) * 49.0 / 48.0;
        const double yy = mean([&](double, double q) { return (q - y) * (q - y); }) * 49.0 / 48.0;
        const double xy = mean([&](double p, double q) { return (p - x) * (q - y); }) * 49.0 / 48.0;
        const double c1 = 2.55 * 2.55, c2 = 7.65 * 7.65;
        sum += (2 * x * y + c1) * (2 * xy + c2) / ((x * x + y * y + c1) * (xx + yy + c2));
        ++count;
      }
    }
  }
  return sum / count;
}

TEST(BoxSimilarity, IsTheFormulaWindowByWindow) {
  test_support::Random random(9);
  for (const auto& [width, height] : {std::pair(7, 7), std::pair(30, 8), std::pair(19, 26)}) {
    Rgb8Image a = drawn(width, height, [](int, int) { return 0; }), b = a;
    for (std::size_t k = 0; k < a.rgb.size(); ++k) {
      a.rgb[k] = static_cast<std::uint8_t>(random.integer(0, 255));
      b.rgb[k] = static_cast<std::uint8_t>((a.rgb[k] + random.integer(0, 120)) / 2);
    }
    // Some hundred roundings of 2^-53 in sums of one size.
    EXPECT_NEAR(box_similarity(a, b), slow_similarity(a, b), 1e-13);
  }
}

}  // namespace
}  // namespace plumb::compare
