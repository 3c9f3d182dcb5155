// Heights as whole numbers, never farther from what they were than a stated error.
#pragma once

#include <cmath>
#include <cstdint>

#include "terrain/height_grid.h"

namespace plumb::mesh::patch_quadtree {

/// How heights become whole numbers. By the paper the step doubles from level to level, so that a
/// coarse level costs little; by the modelled format it is the same everywhere, since a refined
/// number needs 1.5 bits to gain one.
enum class StepRule { DoublesWithLevel, Same };

/// q = floor((h - offset) / step_l + 1/2), h' = q step_l + offset, rounded to a float; step_l is
/// step_m 2^level or step_m by the rule.
///
///   (1) |h' - h| <= error_m(level), the float's rounding included.
///   (2) q depends on h and the level alone: patches that share a sample agree on it.
///   (3) With DoublesWithLevel q_l - 2 q_(l+1) is -1, 0 or 1.
struct Quantiser {
  double step_m = 1.0;
  double offset_m = 0.0;
  double rounding_m = 0.0;  // the largest that a height's float may be off at level 0
  StepRule rule = StepRule::Same;

  double step(int level) const {
    return rule == StepRule::Same ? step_m : std::ldexp(step_m, level);
  }
  std::int32_t number(float height_m, int level) const {
    return static_cast<std::int32_t>(
        std::floor((double{height_m} - offset_m) / step_m * scale(level) + 0.5));
  }
  float height(std::int32_t number, int level) const {
    return static_cast<float>(number * step(level) + offset_m);
  }
  double error_m(int level) const {
    // Heights that a coarser step reaches are larger, by no more than it is, and so is a float's
    // rounding.
    const double finest_m = 0.5 * step_m + rounding_m;
    return rule == StepRule::Same ? finest_m : std::ldexp(finest_m, level);
  }

 private:
  double scale(int level) const { return rule == StepRule::Same ? 1.0 : std::ldexp(1.0, -level); }
};

/// Numbers lie within +- this, so that sums of a few of them, weighted by 64ths, fit into 32 bits.
constexpr std::int32_t most_number(StepRule rule) {
  return rule == StepRule::Same ? 1 << 22 : 1 << 27;
}
/// What a decoder made of damaged bytes, as a number that can be one.
constexpr std::int32_t as_number(std::int64_t value, StepRule rule) {
  const std::int64_t most = most_number(rule);
  return static_cast<std::int32_t>(value < -most ? -most : value > most ? most : value);
}

/// The largest step that keeps every height of the grid within `error_m` at level 0. Of the rule
/// Same, heights that are multiples of a unit (whole metres, a file's codes) take the odd multiple
/// of it that is largest, if that is more than 2 error_m: whole metres within 1 m are thirds, not
/// halves, of a number.
/// Throws InputError unless error_m is finite and above what floats of such heights round to, and
/// the numbers are within most_number.
Quantiser quantiser_for(const terrain::HeightGrid& heights_m, double error_m, StepRule rule);

}  // namespace plumb::mesh::patch_quadtree
