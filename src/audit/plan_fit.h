// Whether points belong to a terrain at all, whatever their errors.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include "audit/truth.h"

namespace plumb::audit {

/// The middle one of some numbers, of an even count the upper; 0 of none.
double middle_of(std::vector<double> values);

/// Points of a drawn surface against the terrain above or below them.
struct PlanFit {
  std::int64_t points = 0;
  std::int64_t over_terrain = 0;  // of them; what follows is of these
  double off_m = 0.0;             // middle of |z - h|
  double shift_m = 0.0;           // middle of z - h
  double spread_m = 0.0;          // middle of |z - h - shift_m|
  double relief_m = 0.0;          // middle of |h - middle of h|: what a level plane would be off by
  /// z = factor * h + offset_m as most points have it, and what it leaves: middle of |z - that|.
  double factor = 1.0, offset_m = 0.0, left_m = 0.0;
};

/// points  relative to the terrain's origin
PlanFit plan_fit(const HeightfieldTruth& truth, std::span<const glm::dvec3> points);

/// True if the points keep closer to the terrain where they are than they would where they are not:
/// `spread_m` is at most that of the terrain moved by each of kOtherPlaces shifts, cyclically, in
/// equal steps to the north and east. Those are terrains of the same kind that the points know
/// nothing of, so that points of another terrain, or through another camera, pass in one case of
/// kOtherPlaces + 1; those of a level of detail pass, however coarse, as long as any trace of the
/// terrain is left in them. Where all places are alike (a level plane) it is true.
bool fits_best_here(const HeightfieldTruth& truth, std::span<const glm::dvec3> points);

inline constexpr int kPlacesAcross = 8;
inline constexpr int kOtherPlaces = kPlacesAcross * kPlacesAcross - 1;

/// Points that are off by less than this share of what a level plane is off by are the terrain's;
/// beyond it fits_best_here decides. Two independent surfaces of one kind differ by about 1.4 times
/// as much as a level plane; by half of it if they were alike to 7 parts in 8.
inline constexpr double kSurelyOfTerrain = 0.5;

/// Fewer points over the terrain say nothing.
inline constexpr std::int64_t kFewestPoints = 16;

/// False only if the points say that they are of another terrain.
bool may_be_of_terrain(const HeightfieldTruth& truth, std::span<const glm::dvec3> points,
                       const PlanFit& fit);

}  // namespace plumb::audit
