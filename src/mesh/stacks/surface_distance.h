// How far one surface is from another.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "mesh/stacks/triangle_tree.h"

namespace plumb::mesh::stacks {

/// Trees side by side, the likeliest first.
class TreesTogether final : public Surface {
 public:
  explicit TreesTogether(std::vector<std::shared_ptr<const TriangleTree>> trees)
      : trees_(std::move(trees)) {}
  void look_for(const glm::dvec3& point, NearestTriangle& nearest) const override;

 private:
  std::vector<std::shared_ptr<const TriangleTree>> trees_;
};

/// A bound, from above, of the distance from any point of some triangles to the nearest point of a
/// surface; +inf where that has no triangle.
///
///   (1) At most a tenth above the largest distance, or `fine_m`, but where pieces of a 64th of a
///       triangle's sides do not settle it.
/// The distance to one triangle is convex, so that over a piece of another triangle it is largest
/// at a corner: a piece whose corners are all near one triangle is near it everywhere. Of all
/// pieces the one that may be farthest is cut into four, until none can be much farther than the
/// middle of one is.
double distance_bound(std::span<const Corners> triangles, const Surface& surface, double fine_m);

/// The same where no triangle is cut: never below it.
double rough_distance_bound(std::span<const Corners> triangles, const Surface& surface);

/// The largest distance from the triangles' middles alone: never above it.
double distance_of_middles(std::span<const Corners> triangles, const Surface& surface);

}  // namespace plumb::mesh::stacks
