// The full-detail surface as a function of place: the truth under a point.
#pragma once

#include <cstdint>

#include "terrain/heightfield.h"

namespace plumb::reference {

/// What stands at a place of a heightfield's full-detail surface.
struct SurfacePoint {
  double height_m;         // NaN where there is no surface
  std::uint32_t triangle;  // terrain::triangle_index; kNoPrimitive where there is none
};

/// Height of the full-detail surface over (x_m, y_m), relative to the terrain's origin.
///
/// On an edge between two triangles the one that exists is taken, of two the one with the lower
/// index. A place less than 1e-9 cells from the surface's rim (the terrain's border, a void's)
/// counts as on it: that is where rounding puts points of the rim. How much evaluation may round:
/// `evaluation_slack_m`.
SurfacePoint surface_at(const terrain::Heightfield& field, terrain::Diagonal diagonal, double x_m,
                        double y_m);

/// More than what rounding may add to a vertical distance between two surfaces evaluated in double,
/// metres: a height is interpolated with at most eight roundings on either side, each at most an
/// ulp of the largest height; a place on an edge is told from one beside it to within 8 ulp of the
/// terrain's extent (audit/flat_triangle.h) on either side, which counts times the slope of a
/// triangle, at most twice the steepest between neighbours.
double evaluation_slack_m(const terrain::Heightfield& field);

/// What rounding depends on.
struct SurfaceRounding {
  double slack_m = 0.0;  // evaluation_slack_m
  /// No full-detail triangle is steeper, rise over run: twice the steepest between neighbouring
  /// samples. A place that is off by a metre counts so many metres of height.
  double steepest_slope = 0.0;
};
SurfaceRounding surface_rounding(const terrain::Heightfield& field);

/// True if a full-detail triangle stands at the place; cheaper words for surface_at.
bool exists_at(const terrain::Heightfield& field, terrain::Diagonal diagonal, double x_m,
               double y_m);

/// Unit normal of a full-detail triangle, upwards.
glm::dvec3 triangle_normal(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                           std::uint32_t triangle);

}  // namespace plumb::reference
