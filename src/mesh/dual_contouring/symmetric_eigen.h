// Eigenvalues and vectors of a symmetric 3x3 matrix, with the same bits everywhere.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace plumb::mesh::dual_contouring {

/// A symmetric matrix by the places on and above its diagonal.
struct SymmetricMatrix {
  glm::dvec3 diagonal{0.0};
  double xy = 0.0, xz = 0.0, yz = 0.0;
};

struct SymmetricEigen {
  std::array<double, 3> value{};
  std::array<glm::dvec3, 3> vector{};  // unit, perpendicular to one another
};

/// Cyclic Jacobi rotations, at most five sweeps, no libm but sqrt. It converges quadratically:
/// after three or four sweeps nothing is left but rounding, and what lies below the rounding of the
/// trace is taken for zero, so that the last sweeps cost nothing.
inline SymmetricEigen eigen_of(const SymmetricMatrix& matrix) {
  constexpr int kSweeps = 5;
  double a[3][3] = {{matrix.diagonal.x, matrix.xy, matrix.xz},
                    {matrix.xy, matrix.diagonal.y, matrix.yz},
                    {matrix.xz, matrix.yz, matrix.diagonal.z}};
  double v[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const double nothing = 0x1p-53 * (std::abs(a[0][0]) + std::abs(a[1][1]) + std::abs(a[2][2]));
  constexpr int kPlaces[3][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}};  // p, q and the third
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const auto& [p, q, r] : kPlaces) {
      if (std::abs(a[p][q]) <= nothing) continue;
      const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
      const double root = std::sqrt(theta * theta + 1.0);  // infinite where theta^2 is: t is 0
      const double t = theta < 0.0 ? 1.0 / (theta - root) : 1.0 / (theta + root);
      const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
      a[p][p] -= t * a[p][q];
      a[q][q] += t * a[p][q];
      a[p][q] = a[q][p] = 0.0;
      const double rp = a[r][p], rq = a[r][q];
      a[r][p] = a[p][r] = c * rp - s * rq;
      a[r][q] = a[q][r] = s * rp + c * rq;
      for (auto& row : v) {
        const double vp = row[p], vq = row[q];
        row[p] = c * vp - s * vq;
        row[q] = s * vp + c * vq;
      }
    }
  }
  SymmetricEigen eigen;
  for (std::size_t k = 0; k < 3; ++k) {
    eigen.value[k] = a[k][k];
    eigen.vector[k] = {v[0][k], v[1][k], v[2][k]};
  }
  return eigen;
}

}  // namespace plumb::mesh::dual_contouring
