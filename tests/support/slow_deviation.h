// How far drawn triangles lie from the full-detail surface, by plain arithmetic: every sample by
// barycentric coordinates, every drawn edge against every edge of the truth near it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/grid.h"
#include "terrain/heightfield.h"

namespace plumb::test_support {

/// A corner at a sample of the terrain.
struct DrawnCorner {
  int column, row;
  double height_m;
};
using DrawnTriangle = std::array<DrawnCorner, 3>;

/// The largest |drawn - truth| of triangles over a terrain, metres; triangles without area or with
/// a void corner cover no place, and voids of the terrain are no truth.
class SlowDeviation {
 public:
  SlowDeviation(const Grid<float>& heights_m, terrain::Diagonal diagonal)
      : heights_m_(heights_m), diagonal_(diagonal) {}

  double of(const std::vector<DrawnTriangle>& triangles) const {
    double largest = 0.0;
    for (const DrawnTriangle& t : triangles) largest = std::max(largest, of(t));
    return largest;
  }

 private:
  static double cross(const DrawnCorner& a, const DrawnCorner& b, double x, double y) {
    return (b.column - a.column) * (y - a.row) - (b.row - a.row) * (x - a.column);
  }

  double of(const DrawnTriangle& t) const {
    const double area = cross(t[0], t[1], t[2].column, t[2].row);
    if (area == 0.0 || std::isnan(t[0].height_m + t[1].height_m + t[2].height_m)) return 0.0;
    double largest = 0.0;
    const auto [west, east] = std::minmax({t[0].column, t[1].column, t[2].column});
    const auto [south, north] = std::minmax({t[0].row, t[1].row, t[2].row});
    for (int y = south; y <= north; ++y) {
      for (int x = west; x <= east; ++x) {
        const double a = cross(t[1], t[2], x, y) / area, b = cross(t[2], t[0], x, y) / area,
                     c = cross(t[0], t[1], x, y) / area;
        if (a < 0.0 || b < 0.0 || c < 0.0) continue;
        const double drawn = a * t[0].height_m + b * t[1].height_m + c * t[2].height_m;
        largest = std::fmax(largest, std::abs(drawn - double{heights_m_(x, y)}));
      }
    }
    for (std::size_t k = 0; k < 3; ++k)
      largest = std::max(largest, along_edge(t[k], t[(k + 1) % 3]));
    return largest;
  }

  // The edges of the truth that begin at each sample in the edge's box, those of its rim included.
  double along_edge(const DrawnCorner& a, const DrawnCorner& b) const {
    const auto [west, east] = std::minmax(a.column, b.column);
    const auto [south, north] = std::minmax(a.row, b.row);
    double largest = 0.0;
    for (int y = south; y <= north; ++y) {
      for (int x = west; x <= east; ++x) {
        largest = std::fmax(largest, at_crossing(a, b, x, y, x + 1, y));
        largest = std::fmax(largest, at_crossing(a, b, x, y, x, y + 1));
        largest = std::fmax(largest, terrain::rises_north_east(diagonal_, x, y)
                                         ? at_crossing(a, b, x, y, x + 1, y + 1)
                                         : at_crossing(a, b, x + 1, y, x, y + 1));
      }
    }
    return largest;
  }

  // Of a drawn edge and one of the truth from (x0, y0) to (x1, y1); 0 where they do not cross.
  double at_crossing(const DrawnCorner& a, const DrawnCorner& b, int x0, int y0, int x1,
                     int y1) const {
    if (!heights_m_.contains(x0, y0) || !heights_m_.contains(x1, y1)) return 0.0;
    const std::int64_t ax = b.column - a.column, ay = b.row - a.row, bx = x1 - x0, by = y1 - y0;
    const std::int64_t cx = x0 - a.column, cy = y0 - a.row;
    std::int64_t below = ax * by - ay * bx, drawn = cx * by - cy * bx, true_ = cx * ay - cy * ax;
    if (below == 0) return 0.0;  // along each other
    if (below < 0) {
      below = -below;
      drawn = -drawn;
      true_ = -true_;
    }
    if (drawn < 0 || drawn > below || true_ < 0 || true_ > below) return 0.0;
    const double t = static_cast<double>(drawn) / static_cast<double>(below),
                 s = static_cast<double>(true_) / static_cast<double>(below);
    const double from = heights_m_(x0, y0), to = heights_m_(x1, y1);
    const double off = (1.0 - t) * a.height_m + t * b.height_m - ((1.0 - s) * from + s * to);
    return std::isnan(off) ? 0.0 : std::abs(off);
  }

  const Grid<float>& heights_m_;
  terrain::Diagonal diagonal_;
};

}  // namespace plumb::test_support
