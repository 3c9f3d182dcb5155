// Vertices of cells whose surface is known: planes, corners of boxes, nothing known.
#include "mesh/dual_contouring/vertex_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "mesh/dual_contouring/cell_loops.h"
#include "mesh/dual_contouring/symmetric_eigen.h"

namespace plumb::mesh::dual_contouring {
namespace {

constexpr Placement kAll[] = {Placement::Mean, Placement::Qef, Placement::Particle};

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

glm::dvec3 corner(int c) { return {c & 1, c >> 1 & 1, c >> 2}; }

CellCorners sampled(const std::function<double(const glm::dvec3&)>& density,
                    const std::function<glm::dvec3(const glm::dvec3&)>& gradient) {
  CellCorners cell;
  for (int c = 0; c < 8; ++c) {
    cell.density[static_cast<std::size_t>(c)] = static_cast<float>(density(corner(c)));
    cell.gradient[static_cast<std::size_t>(c)] = gradient(corner(c));
  }
  return cell;
}

std::uint16_t crossing(const CellCorners& cell) {
  unsigned mask = 0;
  for (unsigned c = 0; c < 8; ++c) mask |= cell.density[c] > 0.5F ? 1U << c : 0U;
  return single_loop(static_cast<CellMask>(mask)).edges[0];
}

glm::dvec3 placed(const CellCorners& cell, Placement placement) {
  return place_vertex(cell, crossing(cell), placement);
}

// Half filled from below: the middle of the cell, to the bit.
TEST(PlaceVertex, LiesInTheMiddleOfAHalfFilledCell) {
  const CellCorners cell = sampled([](const auto& p) { return 1.0 - p.z; },
                                   [](const auto&) { return glm::dvec3(0, 0, -1); });
  for (const Placement placement : kAll)
    EXPECT_EQ(placed(cell, placement), glm::dvec3(0.5, 0.5, 0.5)) << name_of(placement);
}

// The densities are floats: 2^-25 off at most, which moves a crossing along its edge by that over
// the slope, and the plane at the vertex by no more than sqrt(3) * 2^-25 / |g| along the normal,
// |g| >= 0.3 here; all steps after that are doubles.
TEST(PlaceVertex, LiesOnAPlaneHoweverItIsPlaced) {
  const double bound = 2.0 * 0x1p-25 * std::sqrt(3.0) / 0.3;
  for (const glm::dvec3 g : {glm::dvec3(0.3, -0.2, -0.4), glm::dvec3(-0.1, 0.05, 0.3),
                             glm::dvec3(0.25, 0.25, 0.25), glm::dvec3(0.0, -0.45, 0.01)}) {
    for (double offset = -0.3; offset < 0.31; offset += 0.1) {
      const auto density = [&](const glm::dvec3& p) {
        return 0.5 + dot(g, p - 0.5) + 0.5 * offset * std::sqrt(dot(g, g));
      };
      const CellCorners cell = sampled(density, [&](const auto&) { return g; });
      for (const Placement placement : kAll) {
        const glm::dvec3 at = placed(cell, placement);
        EXPECT_LT(std::abs(density(at) - 0.5) / std::sqrt(dot(g, g)), bound) << name_of(placement);
      }
    }
  }
}

// Of many vertices on one plane, least squares takes the one nearest to the mean: the mean.
TEST(PlaceVertex, DoesNotMoveAlongAPlane) {
  const CellCorners cell =
      sampled([](const auto& p) { return 0.5 + 0.5 * (p.x + p.y + p.z) - 0.55; },
              [](const auto&) { return glm::dvec3(1.0); });
  const glm::dvec3 mean = placed(cell, Placement::Mean);
  for (const Placement placement : {Placement::Qef, Placement::Particle}) {
    const glm::dvec3 moved = placed(cell, placement) - mean;
    EXPECT_LT(std::sqrt(dot(moved, moved)), 1e-6);
  }
}

// The corner of a box at (0.6, 0.7, 0.4): solid below it on all three axes. Edges from corner 0
// cross one face each, at 0.6, 0.7 and 0.4, with that face's normal.
CellCorners box_corner(const glm::dvec3& at) {
  CellCorners cell;
  cell.density.fill(0.0F);
  cell.density[0] = 1.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const auto c = static_cast<std::size_t>(1 << axis);
    // (1/2 - 1) / (b - 1) = t
    cell.density[c] = static_cast<float>(1.0 - 0.5 / at[axis]);
    cell.gradient[c][axis] = -1.0;
  }
  return cell;
}

TEST(PlaceVertex, FindsTheCornerOfABoxByQef) {
  const glm::dvec3 corner(0.6, 0.7, 0.4);
  const glm::dvec3 at = placed(box_corner(corner), Placement::Qef);
  // Densities are floats below 1 in size: 2^-25 off; dt = t^2 / 0.5 * that.
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(at[axis], corner[axis], 0x1p-24);
}

// Mean of (0.6, 0, 0), (0, 0.7, 0) and (0, 0, 0.4).
TEST(PlaceVertex, CutsTheCornerOfABoxByItsMean) {
  const glm::dvec3 at = placed(box_corner({0.6, 0.7, 0.4}), Placement::Mean);
  EXPECT_NEAR(at.x, 0.6 / 3, 0x1p-24);
  EXPECT_NEAR(at.y, 0.7 / 3, 0x1p-24);
  EXPECT_NEAR(at.z, 0.4 / 3, 0x1p-24);
}

// Each step takes damping / 3 of what is left: the product of 1 - (1 - k/50) / 3 over 50 steps is
// below 1e-3, so the loop ends where the force is: 1e-3 over a stiffness of one.
TEST(PlaceVertex, ComesCloseToTheCornerOfABoxByTheParticle) {
  const glm::dvec3 corner(0.6, 0.7, 0.4);
  const glm::dvec3 at = placed(box_corner(corner), Placement::Particle);
  const glm::dvec3 left = at - corner;
  EXPECT_LT(std::sqrt(dot(left, left)), 1e-3);
  EXPECT_GT(std::sqrt(dot(left, left)), 1e-5);
}

// What the paper does: forces at the corners, interpolated where the particle is.
TEST(PlaceVertex, PullsTheParticleAsForcesTabulatedAtTheCornersDo) {
  const CellCorners cell = box_corner({0.6, 0.7, 0.4});
  std::array<glm::dvec3, 8> forces{};
  for (int c = 0; c < 8; ++c) {
    for (int axis = 0; axis < 3; ++axis)
      forces[static_cast<std::size_t>(c)][axis] = glm::dvec3(0.6, 0.7, 0.4)[axis] - corner(c)[axis];
  }
  glm::dvec3 at = placed(cell, Placement::Mean);
  for (int step = 0; step < 50; ++step) {
    const glm::dvec3 force = trilinear(forces, at);
    at += force * ((1.0 - step / 50.0) / 3.0);
    if (dot(force, force) < 1e-6) break;
  }
  const glm::dvec3 apart = at - placed(cell, Placement::Particle);
  EXPECT_LT(std::sqrt(dot(apart, apart)), 0x1p-23);  // the corner as the float densities have it
}

TEST(PlaceVertex, StaysAtTheMeanWhereNoGradientIsKnown) {
  CellCorners cell = box_corner({0.6, 0.7, 0.4});
  cell.gradient.fill(glm::dvec3(0.0));
  for (const Placement placement : {Placement::Qef, Placement::Particle})
    EXPECT_EQ(placed(cell, placement), placed(cell, Placement::Mean));
}

// Cells whose axes are exchanged in a ring: sums come in another order, a few rounding errors of
// places up to one; the truncation leaves condition numbers of the squares up to 100.
TEST(PlaceVertex, TurnsWithTheCell) {
  std::mt19937_64 random(7);
  const auto number = [&] { return static_cast<double>(random() >> 40) * 0x1p-24; };
  for (int trial = 0; trial < 200; ++trial) {
    CellCorners cell, turned;
    for (std::size_t c = 0; c < 8; ++c) {
      const std::size_t to = (c << 1 & 6) | c >> 2;  // x to y, y to z, z to x
      cell.density[c] = turned.density[to] = static_cast<float>(number());
      const glm::dvec3 g(number() - 0.5, number() - 0.5, number() - 0.5);
      cell.gradient[c] = g;
      turned.gradient[to] = {g.z, g.x, g.y};
    }
    if (crossing(cell) == 0) continue;
    for (const Placement placement : kAll) {
      const glm::dvec3 at = placed(cell, placement);
      const glm::dvec3 apart = placed(turned, placement) - glm::dvec3(at.z, at.x, at.y);
      EXPECT_LT(std::sqrt(dot(apart, apart)), 100 * 64 * 0x1p-53) << name_of(placement);
    }
  }
}

// Faces that meet beyond the cell: x = 0.9 and a slope that reaches it at z > 1.
TEST(PlaceVertex, StaysInTheCell) {
  CellCorners cell = box_corner({0.9, 0.9, 0.9});
  cell.gradient[1] = {-1.0, 0.0, 0.3};
  cell.gradient[2] = {0.0, -1.0, 0.3};
  cell.gradient[4] = {0.3, 0.3, -1.0};
  const glm::dvec3 at = placed(cell, Placement::Qef);
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(at[axis], 1.0);
}

// Nearly parallel planes: their line of intersection lies far off, the vertex stays on the mean's
// height along it. tan(4 degrees / 2) < 0.1.
TEST(PlaceVertex, DoesNotFollowPlanesThatAreNearlyParallel) {
  const double slope = std::tan(0.035);
  CellCorners cell =
      sampled([](const auto& p) { return 1.0 - p.z; },
              [&](const auto& p) { return glm::dvec3(p.x > 0.5 ? slope : -slope, 0, -1); });
  cell.density[1] = cell.density[3] = 0.9F;  // crosses at 4/9 instead of 1/2: not the planes' line
  EXPECT_EQ(placed(cell, Placement::Qef).y, 0.5);
  EXPECT_NEAR(placed(cell, Placement::Qef).x, 0.5, 0.01);
}

TEST(Trilinear, IsExactForWhatIsLinear) {
  std::array<float, 8> values{};
  for (int c = 0; c < 8; ++c)
    values[static_cast<std::size_t>(c)] =
        static_cast<float>(1 + 2 * (c & 1) + 4 * (c >> 1 & 1) + 8 * (c >> 2));
  EXPECT_EQ(trilinear(values, {0.5, 0.25, 0.125}), 1 + 1 + 1 + 1);
  EXPECT_EQ(trilinear(values, {1, 1, 1}), 15.0);
}

TEST(EigenOf, TakesAMatrixApart) {
  const SymmetricMatrix matrix{{2.0, 3.0, 5.0}, 0.7, -1.1, 0.4};
  const SymmetricEigen eigen = eigen_of(matrix);
  double trace = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3& v = eigen.vector[k];
    const glm::dvec3 image(2.0 * v.x + 0.7 * v.y - 1.1 * v.z, 0.7 * v.x + 3.0 * v.y + 0.4 * v.z,
                           -1.1 * v.x + 0.4 * v.y + 5.0 * v.z);
    const glm::dvec3 left = image - eigen.value[k] * v;
    // Rotations lose a few rounding errors of the largest value, 5.6.
    EXPECT_LT(std::sqrt(dot(left, left)), 32 * 0x1p-53 * 5.6);
    EXPECT_NEAR(dot(v, v), 1.0, 32 * 0x1p-53);
    EXPECT_NEAR(dot(v, eigen.vector[(k + 1) % 3]), 0.0, 32 * 0x1p-53);
    trace += eigen.value[k];
  }
  EXPECT_NEAR(trace, 10.0, 64 * 0x1p-53 * 5.6);
}

TEST(EigenOf, KeepsADiagonalMatrix) {
  const SymmetricEigen eigen = eigen_of({{2.0, 0.0, 5.0}});
  EXPECT_EQ(eigen.value, (std::array{2.0, 0.0, 5.0}));
  EXPECT_EQ(eigen.vector[1], glm::dvec3(0, 1, 0));
}

}  // namespace
}  // namespace plumb::mesh::dual_contouring
