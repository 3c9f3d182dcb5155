#include "audit/plan_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"

namespace plumb::audit {
namespace {

// Heights over points, and the points' own, where the terrain has some.
struct Pairs {
  std::vector<double> z, h;
};

Pairs pairs_at(const HeightfieldTruth& truth, std::span<const glm::dvec3> points, double east_m,
               double north_m) {
  const terrain::Heightfield& field = truth.field();
  const double width = field.cell_columns() * field.dx_m, depth = field.cell_rows() * field.dy_m;
  const bool moved = east_m != 0.0 || north_m != 0.0;
  const auto around = [](double value, double size) {
    return size > 0.0 ? value - std::floor(value / size) * size : value;
  };
  Pairs pairs;
  for (const glm::dvec3& p : points) {
    if (std::isnan(truth.height_at(p.x, p.y))) continue;  // the same points at every place
    const double h =
        moved ? truth.height_at(around(p.x + east_m, width), around(p.y + north_m, depth))
              : truth.height_at(p.x, p.y);
    if (std::isnan(h)) continue;
    pairs.z.push_back(p.z);
    pairs.h.push_back(h);
  }
  return pairs;
}

double spread_of(std::vector<double> values) {
  const double middle = middle_of(values);
  for (double& value : values) value = std::abs(value - middle);
  return middle_of(std::move(values));
}

std::vector<double> differences(const Pairs& pairs) {
  std::vector<double> off(pairs.z.size());
  for (std::size_t k = 0; k < off.size(); ++k) off[k] = pairs.z[k] - pairs.h[k];
  return off;
}

// Least squares, then again twice of the better half, so that outliers have no say.
void fit_line(const Pairs& pairs, PlanFit& fit) {
  double keep_below = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3; ++round) {
    double n = 0.0, sum_z = 0.0, sum_h = 0.0;
    const auto kept = [&](std::size_t k) {
      return std::abs(pairs.z[k] - fit.factor * pairs.h[k] - fit.offset_m) <= keep_below;
    };
    std::vector<std::size_t> chosen;
    for (std::size_t k = 0; k < pairs.z.size(); ++k) {
      if (!kept(k)) continue;
      chosen.push_back(k);
      n += 1.0;
      sum_z += pairs.z[k];
      sum_h += pairs.h[k];
    }
    if (chosen.empty()) return;
    double hh = 0.0, hz = 0.0;
    for (const std::size_t k : chosen) {
      hh += (pairs.h[k] - sum_h / n) * (pairs.h[k] - sum_h / n);
      hz += (pairs.h[k] - sum_h / n) * (pairs.z[k] - sum_z / n);
    }
    fit.factor = hh > 0.0 ? hz / hh : 1.0;
    fit.offset_m = sum_z / n - fit.factor * (sum_h / n);
    std::vector<double> left(pairs.z.size());
    for (std::size_t k = 0; k < left.size(); ++k)
      left[k] = std::abs(pairs.z[k] - fit.factor * pairs.h[k] - fit.offset_m);
    keep_below = fit.left_m = middle_of(std::move(left));
  }
}

}  // namespace

double middle_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

PlanFit plan_fit(const HeightfieldTruth& truth, std::span<const glm::dvec3> points) {
  PlanFit fit;
  const Pairs pairs = pairs_at(truth, points, 0.0, 0.0);
  fit.points = static_cast<std::int64_t>(points.size());
  fit.over_terrain = static_cast<std::int64_t>(pairs.z.size());
  std::vector<double> off = differences(pairs);
  fit.shift_m = middle_of(off);
  fit.spread_m = spread_of(off);
  for (double& value : off) value = std::abs(value);
  fit.off_m = middle_of(std::move(off));
  fit.relief_m = spread_of(pairs.h);
  fit_line(pairs, fit);
  return fit;
}

bool fits_best_here(const HeightfieldTruth& truth, std::span<const glm::dvec3> points) {
  const terrain::Heightfield& field = truth.field();
  std::array<double, kOtherPlaces + 1> spreads{};
  parallel_for(kOtherPlaces + 1, 1, [&](std::int64_t k) {
    const double east = static_cast<double>(k % kPlacesAcross) / kPlacesAcross,
                 north = static_cast<double>(k / kPlacesAcross) / kPlacesAcross;
    spreads[static_cast<std::size_t>(k)] =
        spread_of(differences(pairs_at(truth, points, east * field.cell_columns() * field.dx_m,
                                       north * field.cell_rows() * field.dy_m)));
  });
  return std::all_of(spreads.begin(), spreads.end(),
                     [&](double spread) { return spreads[0] <= spread + truth.slack_m; });
}

bool may_be_of_terrain(const HeightfieldTruth& truth, std::span<const glm::dvec3> points,
                       const PlanFit& fit) {
  if (fit.over_terrain < kFewestPoints) return true;
  return fit.spread_m <= kSurelyOfTerrain * fit.relief_m + truth.slack_m ||
         fits_best_here(truth, points);
}

}  // namespace plumb::audit
