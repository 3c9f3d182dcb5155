#include "compare/structural_similarity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.h"
#include "support/random_scene.h"

namespace plumb::compare {
namespace {

using test_support::Random;

Grid<float> noise(Random& random, int columns, int rows) {
  Grid<float> grid(columns, rows);
  for (float& value : grid.values()) value = static_cast<float>(random.uniform(0.0, 1.0));
  return grid;
}

// Window by window, weight by weight, with the variances as sums of squared deviations.
double slow_mean(const Grid<float>& a, const Grid<float>& b) {
  const int window = 11;
  double weights[11][11], total = 0.0;
  for (int j = 0; j < window; ++j) {
    for (int i = 0; i < window; ++i)
      total += weights[j][i] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / 4.5);
  }
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y + window <= a.rows(); ++y) {
    for (int x = 0; x + window <= a.columns(); ++x) {
      double mean_a = 0.0, mean_b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
      for (int j = 0; j < window; ++j) {
        for (int i = 0; i < window; ++i) {
          mean_a += weights[j][i] / total * a(x + i, y + j);
          mean_b += weights[j][i] / total * b(x + i, y + j);
        }
      }
      for (int j = 0; j < window; ++j) {
        for (int i = 0; i < window; ++i) {
          const double w = weights[j][i] / total;
          const double da = a(x + i, y + j) - mean_a, db = b(x + i, y + j) - mean_b;
          aa += w * da * da;
          bb += w * db * db;
          ab += w * da * db;
        }
      }
      sum += (2 * mean_a * mean_b + 0.0001) * (2 * ab + 0.0009) /
             ((mean_a * mean_a + mean_b * mean_b + 0.0001) * (aa + bb + 0.0009));
      ++count;
    }
  }
  return sum / count;
}

TEST(StructuralSimilarity, IsTheFormulaWindowByWindow) {
  Random random(5);
  for (const auto& [columns, rows] : {std::pair(11, 11), std::pair(40, 23), std::pair(13, 70)}) {
    const Grid<float> a = noise(random, columns, rows), b = noise(random, columns, rows);
    // Variances as differences of means of squares: 2^-52 of one, over C2 = 9e-4.
    EXPECT_NEAR(structural_similarity(a, b).mean, slow_mean(a, b), 1e-11);
  }
}

// Two flat pictures: (2 x y + C1) / (x^2 + y^2 + C1), by hand.
TEST(StructuralSimilarity, OfFlatPicturesIsTheirLuminanceTerm) {
  const Grid<float> a(20, 20, 0.5f), b(20, 20, 0.25f);
  const double expected = (2 * 0.5 * 0.25 + 1e-4) / (0.25 + 0.0625 + 1e-4);
  EXPECT_NEAR(structural_similarity(a, b).mean, expected, 1e-12);
}

TEST(StructuralSimilarity, OfEqualPicturesIsOne) {
  Random random(6);
  const Grid<float> a = noise(random, 33, 21);
  EXPECT_NEAR(structural_similarity(a, a).mean, 1.0, 1e-12);
}

TEST(StructuralSimilarity, NamesTheWorstWindow) {
  Grid<float> a(64, 48, 0.5f), b = a;
  b(30, 20) = 1.0f;
  const StructuralSimilarity found = structural_similarity(a, b);
  EXPECT_EQ(found.least_x, 30);
  EXPECT_EQ(found.least_y, 20);
  EXPECT_LT(found.least, 0.2);
}

TEST(StructuralSimilarity, TakesPicturesSmallerThanItsWindow) {
  const Grid<float> a(1, 1, 0.5f), b(1, 1, 0.25f), c(3, 40, 0.5f);
  EXPECT_NEAR(structural_similarity(a, b).mean, (0.25 + 1e-4) / (0.3125 + 1e-4), 1e-12);
  EXPECT_NEAR(structural_similarity(c, c).mean, 1.0, 1e-12);
  EXPECT_THROW(structural_similarity(a, c), std::invalid_argument);
}

TEST(StructuralSimilarity, SameBitsOnAnyNumberOfThreads) {
  Random random(7);
  const Grid<float> a = noise(random, 150, 200), b = noise(random, 150, 200);
  const StructuralSimilarity all = structural_similarity(a, b);
  const ThreadLimit limit(7);
  EXPECT_EQ(structural_similarity(a, b).mean, all.mean);
  EXPECT_EQ(structural_similarity(a, b).least, all.least);
}

}  // namespace
}  // namespace plumb::compare
