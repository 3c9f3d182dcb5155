// Small terrains of stacks whose surfaces are known, audited, for tests of what an audit says.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "audit/method.h"
#include "audit/solid_audit.h"
#include "support/drawn_stacks.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::audit {

inline constexpr int kSide = 17;  // stacks, a metre apart

/// `letters(i, j)` as written_stacks has them: a letter a metre from the bottom up.
inline terrain::Heightfield solid(const std::function<std::string(int i, int j)>& letters) {
  std::vector<std::string> stacks;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) stacks.push_back(letters(i, j));
  }
  auto written =
      std::make_shared<const terrain::StackField>(test_support::written_stacks(kSide, stacks));
  terrain::Heightfield field = terrain::top_surface(*written);
  field.stacks = std::move(written);
  return field;
}

inline bool in_the_middle(int i, int j) { return i >= 6 && i <= 10 && j >= 6 && j <= 10; }

/// Level ground at 4 m. The filter weighs 1/4, 1/2, 1/4, so that the densities of the voxels on
/// both sides are 3/4 and 1/4 and the surface lies at 4 m to the last bit.
inline terrain::Heightfield level_ground() {
  return solid([](int, int) { return "rrrr......"; });
}

inline MeshTruth truth_of(const terrain::Heightfield& field) {
  return MeshTruth(field, full_detail_of_stacks(built_in_methods(), field));
}

inline DrawnSurface full_detail(const terrain::Heightfield& field) {
  return full_detail_of_stacks(built_in_methods(), field);
}

/// The same surface with another mesh.
inline DrawnSurface with_mesh(const DrawnSurface& surface, TriangleMesh mesh) {
  DrawnSurface changed = surface;
  changed.vertex_colours.clear();
  changed.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return changed;
}

inline TriangleMesh raised(TriangleMesh mesh, double by_m) {
  for (glm::dvec3& vertex : mesh.vertices_m) vertex.z += by_m;
  return mesh;
}

/// Without the triangle that covers (x, y) and lies highest there.
inline TriangleMesh without_top_triangle_at(TriangleMesh mesh, double x, double y) {
  std::size_t highest = mesh.triangles.size();
  double height = -std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 &a = mesh.vertices_m[c[k]], &b = mesh.vertices_m[c[(k + 1) % 3]];
      inside = inside && (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0.0;
    }
    if (!inside || !(mesh.vertices_m[c[0]].z > height)) continue;
    height = mesh.vertices_m[c[0]].z;
    highest = t;
  }
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(highest));
  return mesh;
}

/// 100 x 100 pixels straight down from 20 m over the middle: 9.3 m each way are seen of what lies
/// 20 m below, 7.5 m of what lies 16 m below.
inline Camera from_20_m() {
  LookAt look;
  look.eye_m = {8.0, 8.0, 20.0};
  look.target_m = {8.0, 8.0, 0.0};
  look.width_px = look.height_px = 100;
  look.fov_y_deg = 50.0;
  return make_camera(look);
}

inline AuditResult audit_solid(const terrain::Heightfield& field, const DrawnSurface& surface,
                               const std::vector<std::string>& limits = {}) {
  AuditOptions options;
  for (const std::string& limit : limits) options.limits.push_back(parse_limit(limit));
  const MeshTruth truth = truth_of(field);
  return audit_surface(truth, surface, from_20_m(), options);
}

inline std::int64_t pixels_drawn(const AuditResult& result) {
  std::int64_t count = 0;
  for (std::size_t pixel = 0; pixel < result.drawn.size(); ++pixel)
    count += result.drawn.hit(pixel);
  return count;
}

}  // namespace plumb::audit
