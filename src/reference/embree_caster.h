// Ground truth for any triangles, heightfields and meshes: candidates from Embree, hits in double.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/hit_image.h"
#include "core/triangle_mesh.h"
#include "reference/ray.h"
#include "terrain/heightfield.h"

namespace plumb::reference {

/// What casting took. It depends on the processor that Embree runs on: for logs, never for results.
struct CastStatistics {
  std::int64_t rays = 0;
  std::int64_t hits = 0;
  std::int64_t proposals = 0;  // boxes that Embree held out to a ray
  std::int64_t refused = 0;    // of these, the ones in which double arithmetic found nothing nearer
};

struct EmbreeOptions {
  std::string instruction_set = {};  // as BoxTree takes it; "" for the best there is
  /// Only what this camera's picture may show is held, for frames of this camera alone: so that a
  /// terrain whose tree would not fit into memory has its witness all the same. Heightfields only.
  std::optional<Camera> seen_by = std::nullopt;
};

/// Casts rays at full-detail triangles that are seen from both sides.
///
/// Embree, in single precision, proposes: its tree of boxes, widened by more than all its roundings
/// (BoxTree), names every block of 4 x 4 cells, or every triangle of a mesh, that the ray may meet.
/// Double arithmetic relative to the eye decides, with edges that neighbours share to the last bit.
///
///   (1) Watertight, for heightfields and for meshes whose triangles share vertices.
///   (2) The result is a function of ray and surface alone: the same bits on every instruction set
///       and number of threads.
///   (3) A ray through a shared edge or corner meets its triangles at the same t; the lowest index
///       is named. Heightfields number their triangles by terrain::triangle_index.
/// Nothing is left to what single precision sees: a spike narrower than a rounding is proposed as
/// well. Shares no code with the pyramid caster. Holds about 4 bytes a triangle of a heightfield,
/// 90 of a mesh. See docs/algorithms/ground-truth.md.
class EmbreeCaster {
 public:
  /// Keeps a reference to the field. Throws std::invalid_argument if it is not valid, InputError if
  /// memory does not suffice.
  EmbreeCaster(const terrain::Heightfield& field, terrain::Diagonal diagonal,
               const EmbreeOptions& options = {});
  /// Keeps a reference to the mesh. Throws std::invalid_argument unless the corners are vertices
  /// and the vertices finite.
  explicit EmbreeCaster(const TriangleMesh& mesh, const EmbreeOptions& options = {});
  EmbreeCaster(terrain::Heightfield&&, terrain::Diagonal, const EmbreeOptions& = {}) = delete;
  explicit EmbreeCaster(TriangleMesh&&, const EmbreeOptions& = {}) = delete;
  ~EmbreeCaster();
  EmbreeCaster(EmbreeCaster&&) noexcept;
  EmbreeCaster& operator=(EmbreeCaster&&) noexcept;

  /// ray.origin_m is relative to the terrain's or mesh's origin. Throws std::invalid_argument
  /// unless origin and direction are finite, the direction not zero and 0 <= t_min, and for a
  /// caster that holds what one camera sees alone.
  RayHit cast(const Ray& ray) const;
  /// The same for many rays, in parallel.
  std::vector<RayHit> cast(std::span<const Ray> rays) const;

  /// One ray through each pixel's centre; t in [near, far] is the view depth. The camera is in
  /// world coordinates, and `seen_by` if there is one (std::invalid_argument).
  HitImage cast_frame(const Camera& camera, CastStatistics* statistics = nullptr) const;

  /// The ray of a camera through an image point, in the surface's coordinates.
  Ray camera_ray(const Camera& camera, double x_px, double y_px) const;

 private:
  template <class Settler>
  void cast_tile(const Camera& camera, int x0, int y0, Settler& settler, HitImage& image) const;

  struct Scene;
  std::unique_ptr<const Scene> scene_;
};

}  // namespace plumb::reference
