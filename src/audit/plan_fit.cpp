#include "audit/plan_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/screen_error.h"

namespace plumb::audit {
namespace {

// Heights over points, and the points' own, where the terrain has some.
struct Pairs {
  std::vector<double> z, h;
};

Pairs pairs_at(const HeightfieldTruth& truth, std::span<const glm::dvec3> points) {
  Pairs pairs;
  for (const glm::dvec3& p : points) {
    const double h = truth.height_at(p.x, p.y);
    if (std::isnan(h)) continue;
    pairs.z.push_back(p.z);
    pairs.h.push_back(h);
  }
  return pairs;
}

double mean_size(const std::vector<double>& values, double from) {
  double sum = 0.0;
  for (const double value : values) sum += std::abs(value - from);
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
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
    fit.left_m = mean_size(left, 0.0);
    keep_below = middle_of(std::move(left));
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
  const Pairs pairs = pairs_at(truth, points);
  fit.points = static_cast<std::int64_t>(points.size());
  fit.over_terrain = static_cast<std::int64_t>(pairs.z.size());
  const std::vector<double> off = differences(pairs);
  fit.shift_m = middle_of(off);
  fit.off_m = mean_size(off, 0.0);
  fit.spread_m = mean_size(off, fit.shift_m);
  fit.relief_m = mean_size(pairs.h, middle_of(pairs.h));
  fit_line(pairs, fit);
  return fit;
}

bool keeps_to(const Tolerance& tolerance, const Camera& local, const glm::dvec3& point_m,
              double off_m) {
  if (std::isnan(off_m)) return false;
  constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};
  return tolerance.unit == Unit::Metre
             ? std::abs(off_m) <= tolerance.value
             : screen_displacement_px(local, point_m, kUp, off_m) <= tolerance.value;
}

}  // namespace plumb::audit
