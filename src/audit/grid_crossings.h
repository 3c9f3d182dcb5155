// Where a straight line, seen from above, crosses the edges of the full-detail triangles.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "terrain/heightfield.h"

namespace plumb::audit {

/// Cells by which a place may be off a line of the grid and still count as on it.
inline constexpr double kOnLine = 1e-9;

/// Finds crossings one line after the other; keeps memory between them.
class GridCrossings {
 public:
  /// Keeps a reference to the terrain.
  GridCrossings(const terrain::Heightfield& field, terrain::Diagonal diagonal)
      : field_(field), diagonal_(diagonal) {}

  /// Calls visit(point) for each crossing between p and q (relative to the terrain's origin), in
  /// order from p; the ends are none. Grid lines are crossed outside the terrain as well.
  template <class Visit>
  void between(const glm::dvec3& p, const glm::dvec3& q, const Visit& visit) {
    const double pu = p.x / field_.dx_m, pv = p.y / field_.dy_m, du = q.x / field_.dx_m - pu,
                 dv = q.y / field_.dy_m - pv;
    find_shares(pu, du, pv, dv);
    const std::size_t count = shares_.size();
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const double from = shares_[k], to = shares_[k + 1];
      if (k > 0) visit(p + from * (q - p));
      const double middle = 0.5 * (from + to);
      const int i = static_cast<int>(std::floor(pu + middle * du)),
                j = static_cast<int>(std::floor(pv + middle * dv));
      // On the cell's diagonal (u - i) -+ (v - j) is 0 or 1; both ends on it means that the line
      // runs along it.
      const bool rises = rises_north_east(diagonal_, i, j);
      const auto side = [&](double share) {
        const double a = pu + share * du - i, b = pv + share * dv - j;
        return rises ? a - b : 1.0 - (a + b);
      };
      const double one = side(from), other = side(to);
      if ((one > kOnLine && other < -kOnLine) || (one < -kOnLine && other > kOnLine))
        visit(p + (from + (to - from) * (one / (one - other))) * (q - p));
    }
  }

 private:
  // The shares of the way at which the line crosses those of the grid, from 0 to 1.
  void find_shares(double pu, double du, double pv, double dv) {
    add_lines(pu, du, along_u_);
    add_lines(pv, dv, along_v_);
    shares_.assign(along_u_.size() + along_v_.size() + 2, 0.0);
    std::merge(along_u_.begin(), along_u_.end(), along_v_.begin(), along_v_.end(),
               shares_.begin() + 1);
    shares_.back() = 1.0;
  }

  static void add_lines(double from, double step, std::vector<double>& shares) {
    shares.clear();
    if (std::abs(step) < kOnLine) return;
    const double low = std::min(from, from + step), high = std::max(from, from + step);
    for (double line = std::floor(low) + 1.0; line < high; line += 1.0)
      shares.push_back((line - from) / step);
    if (step < 0.0) std::reverse(shares.begin(), shares.end());
  }

  const terrain::Heightfield& field_;
  terrain::Diagonal diagonal_;
  std::vector<double> along_u_, along_v_, shares_;  // of the way
};

}  // namespace plumb::audit
