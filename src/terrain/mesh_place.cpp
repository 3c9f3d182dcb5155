#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/mesh_file.h"

namespace plumb::terrain {
namespace {

constexpr double kLeastShare = 0.01;  // of the smaller box's area

struct PlanBox {
  glm::dvec2 low, high;

  double area_m2() const { return (high.x - low.x) * (high.y - low.y); }
  std::string text() const {
    return fmt::format("x {:.9g} to {:.9g}, y {:.9g} to {:.9g}", low.x, high.x, low.y, high.y);
  }
};

PlanBox box_of(const TriangleMesh& mesh) {
  const Box box = bounds(mesh);
  const glm::dvec2 origin_m(mesh.origin_m.x, mesh.origin_m.y);
  return {origin_m + glm::dvec2(box.low.x, box.low.y),
          origin_m + glm::dvec2(box.high.x, box.high.y)};
}

PlanBox box_of(const Heightfield& field) {
  return {field.origin_m, field.origin_m + glm::dvec2(field.cell_columns() * field.dx_m,
                                                      field.cell_rows() * field.dy_m)};
}

// A coordinate relative to the terrain's origin; a sample's, if rounding alone keeps it from that.
double settled(double in_file, double shift, double spacing) {
  const double moved = in_file + shift;
  const double sample = std::round(moved / spacing) * spacing;
  const double rounding = kPlaceRoundings * std::numeric_limits<double>::epsilon() *
                          std::max(std::abs(in_file), std::abs(shift));
  return std::abs(moved - sample) <= rounding ? sample : moved;
}

}  // namespace

std::optional<std::string> misplacement(const TriangleMesh& mesh, const Heightfield& field) {
  const PlanBox a = box_of(mesh), b = box_of(field);
  const PlanBox common{{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)},
                       {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y)}};
  const bool apart = common.low.x > common.high.x || common.low.y > common.high.y;
  const double smaller_m2 = std::min(a.area_m2(), b.area_m2());
  const double common_m2 = apart ? 0.0 : common.area_m2();
  if (!apart && common_m2 >= kLeastShare * smaller_m2) return std::nullopt;
  const std::string overlap =
      common_m2 > 0.0
          ? fmt::format("overlap by {:.2g} % of the smaller one", 100.0 * common_m2 / smaller_m2)
          : "do not overlap";
  return fmt::format(
      "seen from above, mesh and terrain {}: the mesh lies at {}, the terrain at {} m; look at the "
      "mesh's place (--offset), its upward axis (--up) and its unit (--scale)",
      overlap, a.text(), b.text());
}

void move_to_origin_of(const Heightfield& field, TriangleMesh& mesh) {
  const glm::dvec2 shift(mesh.origin_m.x - field.origin_m.x, mesh.origin_m.y - field.origin_m.y);
  if (shift == glm::dvec2(0.0)) return;
  for (glm::dvec3& p : mesh.vertices_m) {
    p.x = settled(p.x, shift.x, field.dx_m);
    p.y = settled(p.y, shift.y, field.dy_m);
  }
  mesh.origin_m = {field.origin_m, mesh.origin_m.z};
}

}  // namespace plumb::terrain
