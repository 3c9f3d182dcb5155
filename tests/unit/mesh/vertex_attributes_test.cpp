// Gradients, normals and materials of vertices on densities that can be read off.
#include "mesh/dual_contouring/attributes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/test_lattices.h"

namespace plumb::mesh::dual_contouring {
namespace {

using testing::random_lattice;
using testing::sampled_lattice;

TEST(Gradients, AreExactForWhatIsLinear) {
  const glm::dvec3 slope(0.25, -0.125, 0.0625);
  const Lattice<float> density = sampled_lattice({{}, {5, 5, 5}}, [&](const glm::dvec3& p) {
    return 0.5 + slope.x * p.x + slope.y * p.y + slope.z * p.z;
  });
  EXPECT_EQ(sobel_gradient(density, {2, 2, 2}), slope);
  EXPECT_EQ(central_gradient(density, {2, 2, 2}), slope);
  EXPECT_EQ(central_gradient(density, {0, 4, 0}), slope);  // by the one neighbour that is there
  EXPECT_EQ(sobel_gradient(density, {0, 2, 2}).x, slope.x / 2);
}

TEST(Gradients, WeighTheirNeighboursAsSobelDoes) {
  Lattice<float> density({{}, {3, 3, 3}});
  density({2, 1, 0}) = 32.0F;
  EXPECT_EQ(sobel_gradient(density, {1, 1, 1}), glm::dvec3(2, 0, -2));
  EXPECT_EQ(central_gradient(density, {1, 1, 1}), glm::dvec3(0.0));
}

TEST(Gradients, HaveTheSameBitsForACellAsForItsCorners) {
  const Lattice<float> density = random_lattice({{-2, 0, 0}, {5, 4, 6}}, 8);
  const LatticeBox cells = cells_of(density.box());
  for (std::size_t k = 0; k < cells.count(); ++k) {
    const glm::ivec3 cell = cells.at(k);
    const auto central = central_gradients(density, cell), sobel = sobel_gradients(density, cell);
    for (int c = 0; c < 8; ++c) {
      const glm::ivec3 sample = cell + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
      EXPECT_EQ(central[static_cast<std::size_t>(c)], central_gradient(density, sample));
      EXPECT_EQ(sobel[static_cast<std::size_t>(c)], sobel_gradient(density, sample));
    }
  }
}

TEST(VertexNormals, PointOutOfTheGround) {
  const Lattice<float> density = sampled_lattice(
      {{}, {6, 6, 6}}, [](const glm::dvec3& p) { return std::clamp(3.0 - p.z, 0.0, 1.0); });
  const ActiveCells active = allocate(density, Variant::Conservative);
  const auto positions = vertex_positions(density, active, Placement::Mean);
  for (const glm::dvec3& n : vertex_normals(density, active, positions, quads_of(active)))
    EXPECT_EQ(n, glm::dvec3(0, 0, 1));
}

// Densities that alternate along x: Sobel's operator sees nothing, the faces do.
TEST(VertexNormals, ComeFromTheFacesWhereTheGradientVanishes) {
  const Lattice<float> density = sampled_lattice(
      {{}, {8, 5, 5}}, [](const glm::dvec3& p) { return std::fmod(p.x, 2.0) < 0.5 ? 0.0 : 1.0; });
  const ActiveCells active = allocate(density, Variant::Conservative);
  const auto positions = vertex_positions(density, active, Placement::Mean);
  const auto normals = vertex_normals(density, active, positions, quads_of(active));
  int seen = 0;
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const double x = positions[v].x;
    EXPECT_EQ(std::abs(normals[v].x), 1.0);
    if (x < 1.0 || x > 6.0) continue;  // the border repeats itself: there is a gradient
    EXPECT_EQ(normals[v], glm::dvec3(static_cast<int>(x) % 2 == 1 ? 1 : -1, 0, 0)) << x;
    ++seen;
  }
  EXPECT_EQ(seen, 5 * 16);
}

TEST(VertexMaterials, AreTheirPartsOfTheGround) {
  const Lattice<float> density =
      sampled_lattice({{}, {4, 4, 4}}, [](const glm::dvec3& p) { return p.z < 1.5 ? 1.0 : 0.0; });
  const ActiveCells active = allocate(density, Variant::Conservative);
  const auto positions = vertex_positions(density, active, Placement::Mean);
  Lattice<float> rock = density, sand = density;
  for (float& value : rock.values()) value *= 0.75F;
  for (float& value : sand.values()) value *= 0.25F;
  const std::vector<Lattice<float>> materials{rock, Lattice<float>(density.box()), sand};
  const std::vector<float> weights = vertex_materials(materials, active, positions);
  ASSERT_EQ(weights.size(), 9u * 3);
  for (std::size_t v = 0; v < 9; ++v) {
    EXPECT_EQ(weights[3 * v], 0.75F);
    EXPECT_EQ(weights[3 * v + 1], 0.0F);
    EXPECT_EQ(weights[3 * v + 2], 0.25F);
  }
}

TEST(VertexMaterials, AreZeroWhereNoMaterialIs) {
  Lattice<float> density({{-1, -1, -1}, {3, 3, 3}});
  density({0, 0, 0}) = 1.0F;
  const ActiveCells active = allocate(density, Variant::Conservative);
  const auto positions = vertex_positions(density, active, Placement::Mean);
  const std::vector<Lattice<float>> materials{Lattice<float>(density.box())};
  EXPECT_EQ(vertex_materials(materials, active, positions), std::vector<float>(8, 0.0F));
}

}  // namespace
}  // namespace plumb::mesh::dual_contouring
