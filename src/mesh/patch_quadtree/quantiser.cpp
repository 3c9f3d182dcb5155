#include "mesh/patch_quadtree/quantiser.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::mesh::patch_quadtree {
namespace {

// What is known of all heights.
struct Heights {
  double largest = 0.0;  // |h|
  bool whole = true;     // every one a whole number

  void add(float height) {
    if (std::isnan(height)) return;
    largest = std::max(largest, std::abs(double{height}));
    whole = whole && height == std::floor(height);
  }
  void add(const Heights& other) {
    largest = std::max(largest, other.largest);
    whole = whole && other.whole;
  }
};

Heights heights_of(const terrain::HeightGrid& grid) {
  return parallel_ordered_reduce(
      grid.rows(), 64, Heights{},
      [&](std::int64_t begin, std::int64_t end, Heights heights) {
        std::vector<float> buffer;
        for (std::int64_t j = begin; j < end; ++j)
          for (const float height : grid.row(static_cast<int>(j), buffer)) heights.add(height);
        return heights;
      },
      [](Heights a, const Heights& b) {
        a.add(b);
        return a;
      });
}

// Half the distance of neighbouring floats at x.
double half_ulp(double x) {
  const auto value = static_cast<float>(x);
  return 0.5 * (double{std::nextafter(value, std::numeric_limits<float>::infinity())} - value);
}

// What all heights are multiples of, after the offset; 0 if nothing is known.
struct Unit {
  double metres = 0.0, offset_m = 0.0;
  double rounding_m = 0.0;  // of the floats that they are
};

Unit unit_of(const terrain::HeightGrid& grid, const Heights& heights, double rounding_m) {
  constexpr double kExact = 16777216.0;  // floats hold all whole numbers up to 2^24
  if (heights.whole && heights.largest < kExact) return {1.0, 0.0, 0.0};
  if (grid.is_coded()) return {grid.coding().scale, grid.coding().offset_m, 2.0 * rounding_m};
  return {};
}

}  // namespace

Quantiser quantiser_for(const terrain::HeightGrid& heights_m, double error_m, StepRule rule) {
  if (!(error_m > 0.0) || !std::isfinite(error_m))
    input_error("an error must be above zero and finite, got {} m", error_m);
  const Heights heights = heights_of(heights_m);
  Quantiser quantiser;
  quantiser.rule = rule;
  quantiser.rounding_m = half_ulp(heights.largest + error_m);
  quantiser.step_m = 2.0 * (error_m - quantiser.rounding_m);
  const Unit unit = unit_of(heights_m, heights, quantiser.rounding_m);
  if (rule == StepRule::Same && unit.metres > 0.0 && error_m >= unit.rounding_m) {
    const double odd = 2.0 * std::floor((error_m - unit.rounding_m) / unit.metres) + 1.0;
    if (odd * unit.metres > quantiser.step_m) {
      quantiser.step_m = odd * unit.metres;
      quantiser.offset_m = unit.offset_m;
      // Half a step reaches no multiple of the unit: half a unit of it is never used.
      quantiser.rounding_m = unit.rounding_m - 0.5 * unit.metres;
    }
  }
  if (!(quantiser.step_m > 0.0))
    input_error(
        "an error of {:g} m is below what single precision rounds heights of {:g} m to ({:.2g} m)",
        error_m, heights.largest, quantiser.rounding_m);
  const double most = most_number(rule);
  if (!((heights.largest + std::abs(quantiser.offset_m)) / quantiser.step_m < most))
    input_error("an error of {:g} m is too small for heights of {:g} m: at least {:.3g} m", error_m,
                heights.largest, 0.5 * heights.largest / most);
  return quantiser;
}

}  // namespace plumb::mesh::patch_quadtree
