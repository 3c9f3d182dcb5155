// The first triangle on a ray through a large heightfield, cell by cell in higher precision.
#pragma once

#include <algorithm>
#include <cmath>

#include "support/wide_ray.h"

namespace plumb::test_support {

/// Walks the columns of cells under the ray (rows, if it runs more to the north), takes in each
/// the cells that it may cross with one more to either side, and meets those whose heights come
/// within a metre of the ray. The walk is in long double, the meeting in Real.
template <class Real>
class MarchingCaster {
 public:
  MarchingCaster(const terrain::Heightfield& field, terrain::Diagonal diagonal)
      : field_(field), diagonal_(diagonal) {}

  WideHit<Real> cast(const WideRay<Real>& ray) const {
    const Line line{narrow(ray.origin), narrow(ray.direction), static_cast<long double>(ray.t_min),
                    static_cast<long double>(ray.t_max)};
    // Cells a unit of t in each direction.
    const bool columns = std::abs(line.d[0] / field_.dx_m) >= std::abs(line.d[1] / field_.dy_m);
    const int axis = columns ? 0 : 1;
    const int strips = columns ? field_.cell_columns() : field_.cell_rows();
    const long double step = columns ? field_.dx_m : field_.dy_m;
    WideHit<Real> best;
    for (int k = 0; k < strips; ++k) {
      const int strip = line.d[axis] >= 0 ? k : strips - 1 - k;
      // t within the strip, widened by a cell: more than any rounding.
      long double low = line.t_min, high = line.t_max;
      if (line.d[axis] != 0) {
        const long double a = ((strip - 1) * step - line.o[axis]) / line.d[axis];
        const long double b = ((strip + 2) * step - line.o[axis]) / line.d[axis];
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
      } else if (line.o[axis] < (strip - 1) * step || line.o[axis] > (strip + 2) * step) {
        continue;
      }
      if (low > high) continue;
      if (best.hit && low > static_cast<long double>(best.t)) break;
      meet_strip(ray, line, axis, strip, low, high, best);
    }
    return best;
  }

 private:
  struct Line {
    std::array<long double, 3> o, d;
    long double t_min, t_max;
  };
  static std::array<long double, 3> narrow(const WideVector<Real>& v) {
    return {static_cast<long double>(v.x), static_cast<long double>(v.y),
            static_cast<long double>(v.z)};
  }

  void meet_strip(const WideRay<Real>& ray, const Line& line, int axis, int strip, long double low,
                  long double high, WideHit<Real>& best) const {
    const int other = 1 - axis;
    const int count = axis == 0 ? field_.cell_rows() : field_.cell_columns();
    const long double step = axis == 0 ? field_.dy_m : field_.dx_m;
    int first = 0, last = count - 1;
    if (high < 1e30L) {
      const long double p = (line.o[other] + low * line.d[other]) / step;
      const long double q = (line.o[other] + high * line.d[other]) / step;
      first = static_cast<int>(std::clamp<long double>(std::floor(std::min(p, q)) - 1, 0, count));
      last =
          static_cast<int>(std::clamp<long double>(std::floor(std::max(p, q)) + 1, -1, count - 1));
    } else if (line.d[other] == 0) {
      const long double p = std::floor(line.o[other] / step);
      first = static_cast<int>(std::clamp<long double>(p - 1, 0, count));
      last = static_cast<int>(std::clamp<long double>(p + 1, -1, count - 1));
    }
    const long double z_low = line.o[2] + low * line.d[2];
    const long double z_high = high < 1e30L || line.d[2] == 0
                                   ? line.o[2] + (line.d[2] == 0 ? 0 : high * line.d[2])
                               : line.d[2] > 0 ? 1e30L
                                               : -1e30L;
    for (int k = first; k <= last; ++k) {
      const int i = axis == 0 ? strip : k, j = axis == 0 ? k : strip;
      if (near_ray(i, j, std::min(z_low, z_high) - 1, std::max(z_low, z_high) + 1)) {
        meet_wide_cell(ray, field_, diagonal_, i, j, best);
      }
    }
  }

  bool near_ray(int i, int j, long double z_low, long double z_high) const {
    bool below = false, above = false;
    for (int corner = 0; corner < 4; ++corner) {
      const long double z = field_.heights_m(i + (corner & 1), j + (corner >> 1));
      below = below || z <= z_high;
      above = above || z >= z_low;
    }
    return below && above;
  }

  const terrain::Heightfield& field_;
  terrain::Diagonal diagonal_;
};

}  // namespace plumb::test_support
