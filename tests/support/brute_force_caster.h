// The first triangle on a ray, found by trying them all in higher precision.
#pragma once

#include "core/camera.h"
#include "core/hit_image.h"
#include "core/parallel.h"
#include "support/wide_ray.h"

namespace plumb::test_support {

template <class Real>
WideHit<Real> brute_force(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                          const WideRay<Real>& ray) {
  WideHit<Real> best;
  for (int j = 0; j < field.cell_rows(); ++j) {
    for (int i = 0; i < field.cell_columns(); ++i) {
      meet_wide_cell(ray, field, diagonal, i, j, best);
    }
  }
  return best;
}

template <class Real>
WideHit<Real> brute_force(const TriangleMesh& mesh, const WideRay<Real>& ray) {
  WideHit<Real> best;
  for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
    const Triangle& t = mesh.triangles[k];
    meet_wide<Real>(ray,
                    {widen<Real>(mesh.vertices_m[t[0]]), widen<Real>(mesh.vertices_m[t[1]]),
                     widen<Real>(mesh.vertices_m[t[2]])},
                    k, best);
  }
  return best;
}

/// A frame by brute force; cast(ray) -> WideHit<Real>. `surface_origin_m` as in wide_ray.
template <class Real, class Cast>
HitImage brute_force_frame(const Camera& camera, const glm::dvec3& surface_origin_m,
                           const Cast& cast) {
  HitImage image(camera.width_px, camera.height_px);
  parallel_for(camera.height_px, 1, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < camera.width_px; ++x) {
      const glm::dvec3 direction = ray_direction(camera, x + 0.5, y + 0.5);
      const auto hit = cast(
          wide_ray<Real>(camera.eye_m, surface_origin_m, direction, camera.near_m, camera.far_m));
      if (!hit.hit) continue;
      const std::size_t pixel = image.index(x, y);
      image.depth_m[pixel] = static_cast<double>(hit.t);
      image.from_eye_m[pixel] = image.depth_m[pixel] * direction;
      image.primitive[pixel] = hit.triangle;
    }
  });
  return image;
}

}  // namespace plumb::test_support
