// Small scenes, audited, for tests of what an audit says.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "mesh/full/full_detail.h"

namespace plumb::audit {

inline constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

// Spacing 10 m; height `twist` * i * j: where it is not zero, the two diagonals of every cell lie
// half of it apart in the middle.
inline terrain::Heightfield twisted(int size, double twist) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(size, size);
  field.dx_m = field.dy_m = 10.0;
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i)
      field.heights_m.floats()(i, j) = static_cast<float>(twist * i * j);
  }
  return field;
}

inline terrain::Heightfield plane(int size) { return twisted(size, 0.0); }

inline DrawnSurface full_detail(const terrain::Heightfield& field,
                                terrain::Diagonal diagonal = terrain::Diagonal::Alternating) {
  DrawnSurface surface = mesh::full::draw(mesh::full::prepare(field, {diagonal}), Camera{}, {});
  surface.claims.clear();
  return surface;
}

// Two triangles over a square from the origin, level.
inline DrawnSurface sheet(double side_m, double height_m) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices_m = {
      {0, 0, height_m}, {side_m, 0, height_m}, {side_m, side_m, height_m}, {0, side_m, height_m}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  DrawnSurface surface;
  surface.mesh = mesh;
  return surface;
}

// Straight down from above the middle of a square, or straight up into the sky.
inline Camera vertical_view(double side_m, double height_m, bool down = true) {
  LookAt look;
  look.eye_m = {side_m / 2, side_m / 2, height_m};
  look.target_m = look.eye_m + glm::dvec3(0.0, 0.0, down ? -1.0 : 1.0);
  look.width_px = look.height_px = 100;
  look.fov_y_deg = 50.0;
  return make_camera(look);
}

inline AuditResult audit(const terrain::Heightfield& field, const DrawnSurface& surface,
                         const Camera& camera, const std::vector<std::string>& limits = {}) {
  AuditOptions options;
  for (const std::string& limit : limits) options.limits.push_back(parse_limit(limit));
  return audit_surface(HeightfieldTruth(field, terrain::Diagonal::Alternating), surface, camera,
                       options);
}

inline const ClaimResult& claim(const AuditResult& result, const std::string& label) {
  return *std::find_if(result.claims.begin(), result.claims.end(),
                       [&](const ClaimResult& c) { return c.label == label; });
}

inline std::int64_t breaking(const AuditResult& result, const std::string& label) {
  return std::count_if(result.offenders.begin(), result.offenders.end(),
                       [&](const Offender& o) { return o.breaks == label; });
}

}  // namespace plumb::audit
