#include "reference/surface_height.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "core/triangle_mesh.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;

constexpr double kBorder = 1e-9;  // cells

// Height at (a, b) in [0, 1]^2 of one half of a cell, and how far inside the half the place lies
// (cells, negative outside).
struct Half {
  double height, inside;
};

// A sum of corner heights weighted by nearness.
Half half_at(const Heightfield& field, bool north_east, int half, int i, int j, double a,
             double b) {
  const double sw = field.heights_m(i, j), se = field.heights_m(i + 1, j);
  const double nw = field.heights_m(i, j + 1), ne = field.heights_m(i + 1, j + 1);
  if (north_east) {
    if (half == 0) return {(1.0 - a) * sw + (a - b) * se + b * ne, a - b};
    return {(1.0 - b) * sw + a * ne + (b - a) * nw, b - a};
  }
  if (half == 0) return {(1.0 - a - b) * sw + a * se + b * nw, 1.0 - (a + b)};
  return {(1.0 - b) * se + (a + b - 1.0) * ne + (1.0 - a) * nw, a + b - 1.0};
}

struct Place {
  int cell;
  double fraction;
};

// The cell that holds a grid coordinate; -1 if none does.
Place locate(double coordinate, int cells) {
  if (!(coordinate >= -kBorder && coordinate <= cells + kBorder) || cells == 0) return {-1, 0.0};
  const int cell = std::clamp(static_cast<int>(std::floor(coordinate)), 0, cells - 1);
  return {cell, std::clamp(coordinate - cell, 0.0, 1.0)};
}

constexpr SurfacePoint kNowhere{std::numeric_limits<double>::quiet_NaN(), kNoPrimitive};

// The first half of the cell that exists and holds the place, give or take `slack` cells.
SurfacePoint in_cell(const Heightfield& field, Diagonal diagonal, int i, int j, double a, double b,
                     double slack) {
  const bool north_east = rises_north_east(diagonal, i, j);
  for (int half = 0; half < 2; ++half) {
    const Half found = half_at(field, north_east, half, i, j, a, b);
    if (found.inside >= -slack && !std::isnan(found.height)) {
      return {found.height, terrain::triangle_index(field.cell_columns(), i, j, half)};
    }
  }
  return kNowhere;
}

// Looks for surface on the other side of whatever edge the place is on.
SurfacePoint beside(const Heightfield& field, Diagonal diagonal, Place x, Place y) {
  for (int dj = -1; dj <= 1; ++dj) {
    for (int di = -1; di <= 1; ++di) {
      const double a = x.fraction - di, b = y.fraction - dj;
      const int i = x.cell + di, j = y.cell + dj;
      if (i < 0 || j < 0 || i >= field.cell_columns() || j >= field.cell_rows()) continue;
      if (a < -kBorder || a > 1.0 + kBorder || b < -kBorder || b > 1.0 + kBorder) continue;
      const SurfacePoint found =
          in_cell(field, diagonal, i, j, std::clamp(a, 0.0, 1.0), std::clamp(b, 0.0, 1.0), kBorder);
      if (found.triangle != kNoPrimitive) return found;
    }
  }
  return kNowhere;
}

// The largest |height|, and the steepest slope between neighbours.
struct Extremes {
  double height = 0.0, slope = 0.0;
};

Extremes extremes_of(const Heightfield& field) {
  return parallel_ordered_reduce(
      field.rows(), 64, Extremes{},
      [&](std::int64_t begin, std::int64_t end, Extremes e) {
        std::vector<float> buffer, north_buffer;
        for (int j = static_cast<int>(begin); j < end; ++j) {
          const auto row = field.heights_m.row(j, buffer);
          const auto north_row =
              j + 1 < field.rows() ? field.heights_m.row(j + 1, north_buffer) : row;
          for (std::size_t i = 0; i < row.size(); ++i) {
            const double here = row[i];
            if (std::isnan(here)) continue;
            e.height = std::max(e.height, std::abs(here));
            const double east = i + 1 < row.size() ? row[i + 1] - here : 0.0;
            const double north = north_row[i] - here;  // of the last row to itself: 0
            if (!std::isnan(east)) e.slope = std::max(e.slope, std::abs(east) / field.dx_m);
            if (!std::isnan(north)) e.slope = std::max(e.slope, std::abs(north) / field.dy_m);
          }
        }
        return e;
      },
      [](Extremes a, Extremes b) {
        return Extremes{std::max(a.height, b.height), std::max(a.slope, b.slope)};
      });
}

}  // namespace

SurfacePoint surface_at(const Heightfield& field, Diagonal diagonal, double x_m, double y_m) {
  const Place x = locate(x_m / field.dx_m, field.cell_columns()),
              y = locate(y_m / field.dy_m, field.cell_rows());
  if (x.cell < 0 || y.cell < 0) return kNowhere;
  const SurfacePoint here = in_cell(field, diagonal, x.cell, y.cell, x.fraction, y.fraction, 0.0);
  // Where this cell is void, rounding may have put a place of its rim into it.
  return here.triangle != kNoPrimitive ? here : beside(field, diagonal, x, y);
}

bool exists_at(const Heightfield& field, Diagonal diagonal, double x_m, double y_m) {
  return surface_at(field, diagonal, x_m, y_m).triangle != kNoPrimitive;
}

SurfaceRounding surface_rounding(const Heightfield& field) {
  const Extremes found = extremes_of(field);
  const double ulp = std::numeric_limits<double>::epsilon();
  const double extent = std::max(field.cell_columns() * field.dx_m, field.cell_rows() * field.dy_m);
  return {ulp * (16.0 * found.height + 32.0 * extent * found.slope), 2.0 * found.slope};
}

double evaluation_slack_m(const Heightfield& field) { return surface_rounding(field).slack_m; }

glm::dvec3 triangle_normal(const Heightfield& field, Diagonal diagonal, std::uint32_t triangle) {
  const auto cell = static_cast<int>(triangle / 2), cells = field.cell_columns();
  const int i = cell % cells, j = cell / cells, half = static_cast<int>(triangle & 1u);
  const double sw = field.heights_m(i, j), se = field.heights_m(i + 1, j);
  const double nw = field.heights_m(i, j + 1), ne = field.heights_m(i + 1, j + 1);
  const bool north_east = rises_north_east(diagonal, i, j);
  const double across = (half == 0 ? se - sw : ne - nw) / field.dx_m;
  const double up = ((half == 0) == north_east ? ne - se : nw - sw) / field.dy_m;
  const double length = std::sqrt(across * across + up * up + 1.0);
  return {-across / length, -up / length, 1.0 / length};
}

}  // namespace plumb::reference
