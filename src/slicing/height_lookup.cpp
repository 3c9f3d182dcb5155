#include "slicing/height_lookup.h"

#include "core/parallel.h"
#include "core/reproducible_math.h"

namespace plumb::slicing {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// Texels of half the size, each the average of those of four that there are; a last odd row or
// column is its own.
template <class Samples>
Grid<float> halved(const Samples& fine) {
  Grid<float> coarse((fine.columns() + 1) / 2, (fine.rows() + 1) / 2);
  parallel_for(coarse.rows(), 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < coarse.columns(); ++i) {
      double sum = 0.0;
      int count = 0;
      for (int b = 2 * j; b < std::min(2 * j + 2, fine.rows()); ++b) {
        for (int a = 2 * i; a < std::min(2 * i + 2, fine.columns()); ++a) {
          const double height = fine(a, b);
          if (std::isnan(height)) continue;
          sum += height;
          ++count;
        }
      }
      coarse(i, j) =
          count > 0 ? static_cast<float>(sum / count) : std::numeric_limits<float>::quiet_NaN();
    }
  });
  return coarse;
}

}  // namespace

HeightLookup::HeightLookup(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                           Interpolation interpolation)
    : field_(&field),
      diagonal_(diagonal),
      interpolation_(interpolation),
      columns_per_m_(1.0 / field.dx_m),
      rows_per_m_(1.0 / field.dy_m) {
  if (interpolation == Interpolation::EightBit) {
    const Box box = terrain::bounds(field);
    if (!box.empty()) {
      low_m_ = box.low.z;
      step_m_ = (box.high.z - box.low.z) / 255.0;
      steps_per_m_ = step_m_ > 0.0 ? 1.0 / step_m_ : 0.0;
    }
  }
  if (interpolation != Interpolation::MipMapped) return;
  if (field.columns() > 2 && field.rows() > 2) levels_.push_back(halved(field.heights_m));
  while (!levels_.empty() && levels_.back().columns() > 2 && levels_.back().rows() > 2) {
    levels_.push_back(halved(levels_.back()));
  }
}

std::optional<LaneHeights> HeightLookup::for_lanes() const {
  const terrain::HeightGrid& heights = field_->heights_m;
  if (interpolation_ != Interpolation::Triangulated ||
      diagonal_ != terrain::Diagonal::Alternating ||
      heights.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    return std::nullopt;
  }
  return LaneHeights{terrain::stored(heights), static_cast<double>(field_->cell_columns()),
                     static_cast<double>(field_->cell_rows()), columns_per_m_, rows_per_m_};
}

double HeightLookup::alpha_at(double x_m, double y_m) const {
  Place place;
  if (!find(x_m * columns_per_m_, y_m * rows_per_m_, field_->heights_m, place)) return kNothing;
  const auto texel = [&](int a, int b) {
    return to_eight_bits(field_->heights_m(place.i + a, place.j + b));
  };
  return std::floor(bilinear(place.a, place.b, texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)) +
                    0.5);
}

// Level 0 is the terrain's own; `u` and `v` are its cells. A coarse texel stands in the middle of
// those that it averages, and the outermost ones reach to the rim.
double HeightLookup::in_level(std::size_t level, double u, double v) const {
  return level == 0 ? in_samples(field_->heights_m, 0, u, v)
                    : in_samples(levels_[level - 1], level, u, v);
}

template <class Samples>
double HeightLookup::in_samples(const Samples& samples, std::size_t level, double u, double v) {
  const double size = static_cast<double>(std::size_t{1} << level), half = 0.5 * (size - 1.0);
  const double i = std::clamp((u - half) / size, 0.0, samples.columns() - 1.0),
               j = std::clamp((v - half) / size, 0.0, samples.rows() - 1.0);
  Place place;
  find(i, j, samples, place);
  const auto texel = [&](int a, int b) {
    return static_cast<double>(samples(place.i + a, place.j + b));
  };
  return bilinear(place.a, place.b, texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1));
}

double HeightLookup::mipmapped_m(double x_m, double y_m, double texels) const {
  const double u = x_m * columns_per_m_, v = y_m * rows_per_m_;
  Place place;
  if (!find(u, v, field_->heights_m, place)) return kNothing;
  const auto last = static_cast<double>(levels_.size());
  const double level = texels > 1.0 ? std::min(reproducible_log2(texels), last) : 0.0;
  const auto below = static_cast<std::size_t>(level);
  const double share = level - static_cast<double>(below);
  const double fine = in_level(below, u, v);
  return share > 0.0 ? (1.0 - share) * fine + share * in_level(below + 1, u, v) : fine;
}

}  // namespace plumb::slicing
