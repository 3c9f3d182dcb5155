// The terrain's height at a place, as slices look it up.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/heightfield.h"

namespace plumb::slicing {

/// How a height comes from the samples around a place.
enum class Interpolation {
  Triangulated,  // on the full-detail surface's own triangles
  Bilinear,      // a texture's
  Nearest,       // a texture's without filtering
};

/// Looks heights up; NaN outside the terrain and over voids.
class HeightLookup {
 public:
  /// Keeps a reference to the terrain.
  HeightLookup(const terrain::Heightfield& field, terrain::Diagonal diagonal,
               Interpolation interpolation = Interpolation::Triangulated)
      : field_(&field),
        diagonal_(diagonal),
        interpolation_(interpolation),
        columns_per_m_(1.0 / field.dx_m),
        rows_per_m_(1.0 / field.dy_m) {}

  /// Metres, at a place relative to the terrain's origin. Places outside by less than 1e-9 cells
  /// count as on its rim.
  double height_m(double x_m, double y_m) const {
    constexpr double kRim = 1e-9;
    double u = x_m * columns_per_m_, v = y_m * rows_per_m_;
    const int columns = field_->cell_columns(), rows = field_->cell_rows();
    if (!(u >= -kRim && v >= -kRim && u <= columns + kRim && v <= rows + kRim))
      return std::numeric_limits<double>::quiet_NaN();
    u = std::clamp(u, 0.0, static_cast<double>(columns));
    v = std::clamp(v, 0.0, static_cast<double>(rows));
    const int i = std::min(static_cast<int>(u), columns - 1),
              j = std::min(static_cast<int>(v), rows - 1);
    return in_cell(i, j, u - i, v - j);
  }

 private:
  double in_cell(int i, int j, double a, double b) const {
    const double sw = field_->heights_m(i, j), se = field_->heights_m(i + 1, j);
    const double nw = field_->heights_m(i, j + 1), ne = field_->heights_m(i + 1, j + 1);
    switch (interpolation_) {
      case Interpolation::Nearest:
        return b < 0.5 ? (a < 0.5 ? sw : se) : (a < 0.5 ? nw : ne);
      case Interpolation::Bilinear:
        return (1.0 - b) * ((1.0 - a) * sw + a * se) + b * ((1.0 - a) * nw + a * ne);
      default:
        break;
    }
    if (rises_north_east(diagonal_, i, j)) {
      return a >= b ? (1.0 - a) * sw + (a - b) * se + b * ne
                    : (1.0 - b) * sw + a * ne + (b - a) * nw;
    }
    return a + b <= 1.0 ? (1.0 - a - b) * sw + a * se + b * nw
                        : (1.0 - b) * se + (a + b - 1.0) * ne + (1.0 - a) * nw;
  }

  const terrain::Heightfield* field_;
  terrain::Diagonal diagonal_;
  Interpolation interpolation_;
  double columns_per_m_, rows_per_m_;
};

}  // namespace plumb::slicing
