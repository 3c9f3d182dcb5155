// What the stages of several modules look at, and how they are summed up.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "core/hash.h"
#include "core/hit_image.h"
#include "terrain/camera_presets.h"
#include "terrain/generators.h"

namespace plumb::determinism {

/// Odd sizes, unequal spacings, voids and coordinates with many digits: hills that leave nothing
/// out.
inline terrain::Heightfield hills() {
  return terrain::generate("generate:alpine?size=61x83&spacing=30,25&voids=0.04&utm=1&seed=5");
}

inline Camera camera_for(const terrain::Heightfield& field, const std::string& preset,
                         int width_px = 97, int height_px = 61) {
  return make_camera(terrain::preset_camera(field, preset, width_px, height_px, 50.0));
}

inline void add(Checksum& sum, const glm::dvec3& v) { sum.add(v.x).add(v.y).add(v.z); }

inline void add(Checksum& sum, const HitImage& image) {
  for (std::size_t k = 0; k < image.size(); ++k) {
    sum.add(image.depth_m[k]).add(image.primitive[k]);
    add(sum, image.from_eye_m[k]);
  }
  sum.add(std::span<const std::uint16_t>(image.overdraw));
}

inline void add(Checksum& sum, const Cost& cost) {
  sum.add(cost.vertices).add(cost.triangles).add(cost.fragments).add(cost.nodes_visited);
}

inline void add(Checksum& sum, const DrawnSurface& surface) {
  for (const glm::dvec3& vertex : surface.mesh->vertices_m) add(sum, vertex);
  for (const Triangle& triangle : surface.mesh->triangles)
    sum.add(triangle[0]).add(triangle[1]).add(triangle[2]);
  sum.add(std::span<const std::uint8_t>(surface.triangle_lod));
  for (const Patch& patch : surface.patches)
    sum.add(patch.first_triangle).add(patch.lod).add(std::string_view(patch.name));
  for (const Claim& claim : surface.claims)
    sum.add(static_cast<int>(claim.measure)).add(claim.bound).add(claim.patch);
  add(sum, surface.cost);
}

}  // namespace plumb::determinism
