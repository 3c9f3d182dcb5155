// The terrain's height at a place, as slices look it up.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/grid.h"
#include "slicing/slice_packet.h"
#include "terrain/heightfield.h"

namespace plumb::slicing {

/// How a height comes from the samples around a place.
enum class Interpolation {
  Triangulated,  // on the full-detail surface's own triangles
  Bilinear,      // a texture's
  Nearest,       // a texture's without filtering
  EightBit,      // bilinear between samples of eight bits, rounded to eight bits: an alpha channel
  MipMapped,     // bilinear in two averaged levels and between them, as the footprint asks
};

/// Looks heights up; NaN outside the terrain and over voids.
class HeightLookup {
 public:
  /// Keeps a reference to the terrain; only MipMapped holds anything of its own.
  HeightLookup(const terrain::Heightfield& field, terrain::Diagonal diagonal,
               Interpolation interpolation = Interpolation::Triangulated);

  Interpolation interpolation() const { return interpolation_; }

  /// Metres, at a place relative to the terrain's origin. Places outside by less than 1e-9 cells
  /// count as on its rim. MipMapped: of the finest level.
  double height_m(double x_m, double y_m) const {
    if (interpolation_ == Interpolation::EightBit) return from_eight_bits(alpha_at(x_m, y_m));
    Place place;
    if (!find(x_m * columns_per_m_, y_m * rows_per_m_, field_->heights_m, place))
      return std::numeric_limits<double>::quiet_NaN();
    return in_cell(place);
  }

  /// MipMapped: where one pixel covers `texels` samples' distances, >= 0, in its longer direction.
  /// A place over a void of the finer level is void.
  double mipmapped_m(double x_m, double y_m, double texels) const;

  /// What a slice's own height is compared as: itself, or the nearest one of eight bits.
  double reference_m(double z_m) const {
    return interpolation_ == Interpolation::EightBit ? from_eight_bits(to_eight_bits(z_m)) : z_m;
  }

  /// The same for the ray-slicer's lanes; nothing where they cannot look heights up so.
  std::optional<LaneHeights> for_lanes() const;

  /// Sample distances a metre, along x and along y.
  double columns_per_m() const { return columns_per_m_; }
  double rows_per_m() const { return rows_per_m_; }

 private:
  struct Place {
    int i = 0, j = 0;         // of the cell
    double a = 0.0, b = 0.0;  // in it
  };

  // False outside; `u` and `v` in cells of a grid of samples.
  template <class Samples>
  static bool find(double u, double v, const Samples& samples, Place& place) {
    constexpr double kRim = 1e-9;
    const int columns = samples.columns() - 1, rows = samples.rows() - 1;
    if (!(u >= -kRim && v >= -kRim && u <= columns + kRim && v <= rows + kRim)) return false;
    u = std::clamp(u, 0.0, static_cast<double>(columns));
    v = std::clamp(v, 0.0, static_cast<double>(rows));
    place.i = std::min(static_cast<int>(u), std::max(0, columns - 1));
    place.j = std::min(static_cast<int>(v), std::max(0, rows - 1));
    place.a = u - place.i;
    place.b = v - place.j;
    return true;
  }

  static double bilinear(double a, double b, double sw, double se, double nw, double ne) {
    return (1.0 - b) * ((1.0 - a) * sw + a * se) + b * ((1.0 - a) * nw + a * ne);
  }

  double in_cell(const Place& place) const {
    const auto [i, j, a, b] = place;
    const double sw = field_->heights_m(i, j), se = field_->heights_m(i + 1, j);
    const double nw = field_->heights_m(i, j + 1), ne = field_->heights_m(i + 1, j + 1);
    switch (interpolation_) {
      case Interpolation::Nearest:
        return b < 0.5 ? (a < 0.5 ? sw : se) : (a < 0.5 ? nw : ne);
      case Interpolation::Bilinear:
      case Interpolation::MipMapped:
        return bilinear(a, b, sw, se, nw, ne);
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

  // 0 for the terrain's lowest sample, 255 for its highest.
  double to_eight_bits(double height_m) const {
    return std::floor((height_m - low_m_) * steps_per_m_ + 0.5);
  }
  double from_eight_bits(double alpha) const { return low_m_ + alpha * step_m_; }
  double alpha_at(double x_m, double y_m) const;
  double in_level(std::size_t level, double u, double v) const;
  template <class Samples>
  static double in_samples(const Samples& samples, std::size_t level, double u, double v);

  const terrain::Heightfield* field_;
  terrain::Diagonal diagonal_;
  Interpolation interpolation_;
  double columns_per_m_, rows_per_m_;
  double low_m_ = 0.0, step_m_ = 0.0, steps_per_m_ = 0.0;  // of eight bits
  std::vector<Grid<float>> levels_;                        // of averages, above the samples
};

}  // namespace plumb::slicing
