// Ground truth for heightfields: rays against the full-detail surface, in double, through a min/max
// quadtree.
#pragma once

#include <cstdint>

#include "core/camera.h"
#include "core/hit_image.h"
#include "reference/height_pyramid.h"
#include "reference/ray.h"
#include "terrain/heightfield.h"

namespace plumb::reference {

struct LaneScene;
struct LaneRays;

/// Casts rays at the full-detail triangles of a heightfield, a sheet that is seen from both sides.
///
///   (1) Watertight: a ray that passes from above the surface to below it hits, wherever it
///   crosses, also through samples,
///       along edges and along grid lines. Voids are open: a ray through one goes on.
///   (2) The result is a function of the ray and the terrain alone: the same bits on every machine
///       and thread count.
///   (3) Of triangles met at the same t the one with the lowest index (terrain::triangle_index) is
///   named.
/// Holds 1.33 bytes a triangle beside the field's own 2, of heights in 16 bits 0.67 beside 1, and
/// keeps a reference to the field.
/// Source: [Tevs, Ihrke & Seidel 2008, maximum mipmaps], with minima, in double; see
/// docs/algorithms/ground-truth.md.
class PyramidCaster {
 public:
  PyramidCaster(const terrain::Heightfield& field, terrain::Diagonal diagonal);

  const terrain::Heightfield& field() const { return field_; }
  terrain::Diagonal diagonal() const { return diagonal_; }
  const HeightPyramid& pyramid() const { return pyramid_; }

  /// ray.origin_m is relative to the terrain's origin. Throws std::invalid_argument unless origin
  /// and direction are finite, the direction not zero and 0 <= t_min.
  RayHit cast(const Ray& ray) const;

  /// One ray through each pixel's centre; t in [near, far] is the view depth. The camera is in
  /// world coordinates.
  HitImage cast_frame(const Camera& camera) const;

  /// The ray of a camera through an image point, in the terrain's coordinates.
  Ray camera_ray(const Camera& camera, double x_px, double y_px) const;

  std::int64_t bytes() const { return pyramid_.bytes(); }

 private:
  void cast_rect(const Camera& camera, const LaneScene& scene, LaneRays& rays, int x0, int y0,
                 HitImage& image) const;

  const terrain::Heightfield& field_;
  terrain::Diagonal diagonal_;
  HeightPyramid pyramid_;
};

}  // namespace plumb::reference
