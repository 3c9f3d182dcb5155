// The filter on densities whose smoothed values can be read off.
#include "mesh/dual_contouring/smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/test_lattices.h"

namespace plumb::mesh::dual_contouring {
namespace {

Lattice<float> noise(const LatticeBox& box) { return testing::random_lattice(box, 3); }

// A single sample of 1 spreads as the product of the weights 1/4, 1/2, 1/4.
TEST(Smoothing, SpreadsOneSampleByBinomialWeights) {
  Lattice<float> density({{-3, 0, 2}, {5, 5, 5}});
  density({-1, 2, 4}) = 1.0F;
  const Lattice<float> result = smoothed(density, {Kernel::Gauss, 1});
  EXPECT_EQ(result.box(), (LatticeBox{{-2, 1, 3}, {3, 3, 3}}));
  EXPECT_EQ(result({-1, 2, 4}), 1.0F / 8);
  EXPECT_EQ(result({-2, 2, 4}), 1.0F / 16);
  EXPECT_EQ(result({-2, 3, 4}), 1.0F / 32);
  EXPECT_EQ(result({0, 3, 5}), 1.0F / 64);
}

// Radius 2: 1 4 6 4 1 over 16.
TEST(Smoothing, WidensWithItsRadius) {
  Lattice<float> density({{}, {9, 5, 5}});
  density({4, 2, 2}) = 1.0F;
  const Lattice<float> result = smoothed(density, {Kernel::Gauss, 2});
  const auto row = result.row(2, 2);
  const float across = 6.0F / 16 * 6 / 16;
  EXPECT_EQ(
      std::vector<float>(row.begin(), row.end()),
      (std::vector<float>{across / 16, across / 4, across * 6 / 16, across / 4, across / 16}));
}

TEST(Smoothing, WeighsABoxEqually) {
  Lattice<float> density({{}, {3, 3, 3}});
  density({0, 1, 2}) = 27.0F;
  EXPECT_EQ(smoothed(density, {Kernel::Box, 1}).values(), std::vector<float>{1.0F});
}

TEST(Smoothing, KeepsConstantDensitiesToTheBit) {
  for (const Kernel kernel : {Kernel::Box, Kernel::Gauss}) {
    for (int radius = 0; radius <= 4; ++radius) {
      for (const float value : {0.0F, 0.5F, 1.0F}) {
        const Lattice<float> density({{}, {11, 9, 10}}, value);
        const Lattice<float> result = smoothed(density, {kernel, radius});
        EXPECT_EQ(result, Lattice<float>(density.box().grown(-radius), value));
      }
    }
  }
}

TEST(Smoothing, DoesNothingWithoutARadius) {
  const Lattice<float> density = noise({{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(smoothed(density, {Kernel::Gauss, 0}), density);
}

TEST(Smoothing, IsTheSameInEveryBox) {
  const Lattice<float> density = noise({{-4, 0, 0}, {21, 13, 12}});
  for (const Filter& filter : {Filter{Kernel::Gauss, 1}, {Kernel::Gauss, 4}, {Kernel::Box, 2}}) {
    const Lattice<float> whole = smoothed(density, filter);
    Lattice<float> part({{-1, 1, 1}, {13, 11, 10}});
    for (std::size_t k = 0; k < part.values().size(); ++k)
      part.values()[k] = density(part.box().at(k));
    const Lattice<float> result = smoothed(part, filter);
    for (std::size_t k = 0; k < result.values().size(); ++k)
      EXPECT_EQ(result.values()[k], whole(result.box().at(k)));
  }
}

TEST(Smoothing, MirrorsToTheBit) {
  const Lattice<float> density = noise({{}, {12, 9, 9}});
  Lattice<float> mirrored = density;
  for (int z = 0; z < 9; ++z) {
    for (int y = 0; y < 9; ++y) std::reverse(mirrored.row(y, z).begin(), mirrored.row(y, z).end());
  }
  const Lattice<float> a = smoothed(density, {Kernel::Gauss, 2});
  const Lattice<float> b = smoothed(mirrored, {Kernel::Gauss, 2});
  for (std::size_t k = 0; k < a.values().size(); ++k) {
    const glm::ivec3 p = a.box().at(k);
    EXPECT_EQ(a(p), b({11 - p.x, p.y, p.z}));
  }
}

TEST(Smoothing, RefusesWhatItCannotFilter) {
  const Lattice<float> density({{}, {5, 5, 3}});
  EXPECT_THROW(smoothed(density, {Kernel::Gauss, 5}), std::invalid_argument);
  EXPECT_THROW(smoothed(density, {Kernel::Gauss, -1}), std::invalid_argument);
  EXPECT_THROW(smoothed(density, {Kernel::Gauss, 2}), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::mesh::dual_contouring
