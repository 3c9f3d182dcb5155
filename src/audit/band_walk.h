// Where a ray may go past a surface that strays from the truth within a band.
#pragma once

#include <glm/vec3.hpp>

#include "audit/truth.h"
#include "core/camera.h"

namespace plumb::audit {

/// How far silhouettes may move: the tolerance that the surface was asked to keep.
struct Band {
  double pixels = 1.0;  // at least one counts
  double metres = 0.0;  // vertical
};

/// Follows rays along the truth.
class BandWalk {
 public:
  enum class Way { Unknown, Open, Blocked };
  enum class Side { Below, Above };

  /// Keeps a reference to the truth.
  BandWalk(const HeightfieldTruth& truth, const Camera& camera, const Band& band);

  /// Along a line to the first place without surface, which is Open, or the first that is farther
  /// from the truth on one side than the band, Blocked. Distance from triangles is linear between
  /// their edges. Points are relative to the terrain's origin.
  Way follow(const glm::dvec3& from, const glm::dvec3& to, Side side) const;

  /// True if the line meets a place without surface first, or nowhere, its end included, is farther
  /// from the truth on that side than the band.
  bool is_free(const glm::dvec3& from, const glm::dvec3& to, Side side) const {
    const Way way = follow(from, to, side);
    return way == Way::Open || (way == Way::Unknown && !is_beyond(to, side));
  }

  /// True if the point is farther from the truth above or below it than the band.
  bool is_beyond(const glm::dvec3& point, Side side) const;

  /// True if there is truth above or below the point, no farther than the band.
  bool keeps(const glm::dvec3& point) const;

 private:
  Way follow_piece(const glm::dvec3& from, const glm::dvec3& to, Side side) const;

  const HeightfieldTruth& truth_;
  Camera local_;
  Band band_;
};

}  // namespace plumb::audit
