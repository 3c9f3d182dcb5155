// The terrain and the cameras that several stages look at.
#pragma once

#include "core/camera.h"
#include "core/hash.h"
#include "core/hit_image.h"
#include "core/triangle_mesh.h"
#include "terrain/camera_presets.h"
#include "terrain/generators.h"

namespace plumb::determinism {

/// Mountains with holes in them, far from the origin.
inline terrain::Heightfield mountains() {
  return terrain::generate(
      "generate:alpine?size=129&seed=7&voids=0.02&origin=512345.67,4523456.78");
}

inline Camera view_of(const terrain::Heightfield& field, const char* preset) {
  return make_camera(terrain::preset_camera(field, preset, 192, 108, 50.0));
}

inline void add(Checksum& sum, const glm::dvec3& v) { sum.add(v.x).add(v.y).add(v.z); }

inline void add(Checksum& sum, const HitImage& image) {
  sum.add(std::span<const double>(image.depth_m));
  for (const glm::dvec3& point : image.from_eye_m) add(sum, point);
  sum.add(std::span<const std::uint32_t>(image.primitive));
  sum.add(std::span<const std::uint16_t>(image.overdraw));
}

inline void add(Checksum& sum, const TriangleMesh& mesh) {
  add(sum, mesh.origin_m);
  for (const glm::dvec3& vertex : mesh.vertices_m) add(sum, vertex);
  sum.add(std::span<const Triangle>(mesh.triangles));
}

}  // namespace plumb::determinism
