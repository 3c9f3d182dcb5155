// How far one surface is from another.
#pragma once

#include <span>

#include "mesh/stacks/triangle_tree.h"

namespace plumb::mesh::stacks {

/// The distance from a point to the nearest triangle of some trees; +inf where they have none.
NearestTriangle nearest(const glm::dvec3& point, std::span<const TriangleTree* const> trees);

/// A bound, from above, of the distance from any point of some triangles to the nearest point of
/// the trees; `at_least` if that is more.
///
///   (1) At most a tenth above the largest distance from a corner or the middle of a piece that was
///       looked at, or `fine_m`.
/// The distance to one triangle is convex, so that over a piece of another triangle it is largest
/// at a corner: a piece whose corners are all near one triangle is near it everywhere; others are
/// cut into four.
double distance_bound(std::span<const Corners> triangles,
                      std::span<const TriangleTree* const> trees, double fine_m,
                      double at_least = 0.0);

}  // namespace plumb::mesh::stacks
