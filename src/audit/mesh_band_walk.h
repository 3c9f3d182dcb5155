// Where a ray may go past a surface that strays from a mesh's truth within a band.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "audit/band_walk.h"
#include "audit/mesh_truth.h"
#include "core/box.h"
#include "core/camera.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// What BandWalk asks of heights, asked of a mesh by the distance of nearest points: that of the
/// band in metres, or what its pixels span there across the view, whichever is longer. Serves any
/// number of threads at once.
class MeshBandWalk {
 public:
  /// Keeps a reference to the truth.
  MeshBandWalk(const MeshTruth& truth, const Camera& camera, const Band& band);

  /// True if a surface that keeps to the band may let a pixel's ray pass where it meets the truth.
  ///
  /// Sunk, it lets the ray run on to `depth_m`, or to a place past the truth's rim: one whose
  /// nearest truth is a rim. All rock on the way is no farther from the truth than the band.
  /// Raised, it lets the ray slip below its rim: all air before the truth is within the band, back
  /// to a place past the rim. Rock has no end below.
  ///
  /// from_eye_m  to where the ray meets the truth, metres
  bool may_pass(const glm::dvec3& from_eye_m) const;

  /// True if there is truth no farther from the point than the band.
  bool keeps(const glm::dvec3& from_eye_m) const;

 private:
  using Way = BandWalk::Way;
  enum class Beyond { Blocks, IsFree };  // the band
  struct Border {
    Box box;
    std::vector<bool> rim_vertices;
    std::vector<std::uint8_t> rim_edges;  // of a triangle; bit k: from corner k to the next
  };

  bool sinks(const glm::dvec3& ray, double end) const;
  Way follow(const glm::dvec3& ray, double from, double to, Beyond beyond) const;
  double reach_m(const glm::dvec3& from_eye_m) const;
  bool is_beyond(const glm::dvec3& from_eye_m, const reference::NearestPoint& found) const;
  bool is_on_rim(const reference::NearestPoint& found) const;
  bool enters_rock(const glm::dvec3& ray, std::uint32_t triangle) const;
  double leaves_at(const glm::dvec3& ray) const;
  const Border& border() const;
  static Border border_of(const TriangleMesh& mesh);

  const MeshTruth& truth_;
  Camera local_;
  Band band_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<const Border> border_;
};

}  // namespace plumb::audit
