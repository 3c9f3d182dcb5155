// How points of a drawn surface lie over a terrain.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include "audit/truth.h"
#include "core/camera.h"
#include "core/claim.h"

namespace plumb::audit {

/// The middle one of some numbers, of an even count the upper; 0 of none.
double middle_of(std::vector<double> values);

/// Points of a drawn surface against the terrain above or below them.
struct PlanFit {
  std::int64_t points = 0;
  std::int64_t over_terrain = 0;  // of them; what follows is of these
  double off_m = 0.0;             // mean of |z - h|
  double shift_m = 0.0;           // middle of z - h
  double spread_m = 0.0;          // mean of |z - h - shift_m|
  double relief_m = 0.0;          // mean of |h - middle of h|: what a level plane would be off by
  /// z = factor * h + offset_m as most points have it, and what it leaves: mean of |z - that|.
  double factor = 1.0, offset_m = 0.0, left_m = 0.0;
};

/// points  relative to the terrain's origin
PlanFit plan_fit(const HeightfieldTruth& truth, std::span<const glm::dvec3> points);

/// Whether a point that stands `off_m` off the terrain keeps to a tolerance, in metres or as wide
/// as it looks from a camera (both relative to the terrain's origin); NaN, beside it, does not.
bool keeps_to(const Tolerance& tolerance, const Camera& local, const glm::dvec3& point_m,
              double off_m);

/// Fewer points over the terrain say nothing.
inline constexpr std::int64_t kFewestPoints = 16;

}  // namespace plumb::audit
