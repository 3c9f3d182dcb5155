#include "audit/mesh_band_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "audit/coverage_parts.h"
#include "audit/mesh_edges.h"
#include "audit/pixel_scale.h"
#include "reference/triangle_distance.h"

namespace plumb::audit {
namespace {

constexpr double kStep = 0.25;  // of the band, along a ray
constexpr int kHalves = 20;     // of a step

}  // namespace

MeshBandWalk::MeshBandWalk(const MeshTruth& truth, const Camera& camera, const Band& band)
    : truth_(truth), local_(relative_to(camera, truth.mesh().origin_m)), band_(band) {
  band_.pixels = std::max(1.0, band_.pixels);
}

bool MeshBandWalk::may_pass(const glm::dvec3& from_eye_m) const {
  if (!truth_.nearest()) return true;
  const double met_m = glm::dot(from_eye_m, local_.forward);
  const double end = std::min(local_.far_m / met_m, std::max(1.0, leaves_at(from_eye_m)));
  return sinks(from_eye_m, end) ||
         follow(from_eye_m, 1.0, local_.near_m / met_m, Beyond::Blocks) == Way::Open;
}

bool MeshBandWalk::keeps(const glm::dvec3& from_eye_m) const {
  return truth_.nearest() &&
         !is_beyond(from_eye_m, truth_.nearest()->nearest(local_.eye_m + from_eye_m));
}

// In units of the ray, whose 1 is where the truth was met. What follows there is rock, or air where
// the eye is below ground: neither lets a ray pass that is beyond the band. From then on air does.
bool MeshBandWalk::sinks(const glm::dvec3& ray, double end) const {
  double at = 1.0;
  bool is_behind = true;
  while (at < end) {
    const reference::RayHit next =
        truth_.caster().cast({local_.eye_m, ray, at * (1.0 + kSameDepth), end});
    const double until = next ? next.t : end;
    if (std::isinf(until)) return !is_behind;
    const Way way =
        is_behind ? follow(ray, at, until, Beyond::Blocks) : follow(ray, at, until, Beyond::IsFree);
    if (way != Way::Unknown) return way == Way::Open;
    if (!next) return true;
    is_behind = enters_rock(ray, next.triangle);
    at = until;
  }
  return true;
}

// By steps so short that the distance from the truth changes by a part of the band at most; the
// place where it leaves the band or passes a rim, by halves.
MeshBandWalk::Way MeshBandWalk::follow(const glm::dvec3& ray, double from, double to,
                                       Beyond beyond) const {
  const double length_m = std::sqrt(glm::dot(ray, ray)), toward = to < from ? -1.0 : 1.0;
  reference::NearestPoint found;
  const auto way_at = [&](double at) {
    found = truth_.nearest()->nearest(local_.eye_m + at * ray,
                                      std::numeric_limits<double>::infinity(), found.triangle);
    const bool is_far = is_beyond(at * ray, found);
    if (beyond == Beyond::IsFree && is_far) return Way::Unknown;
    if (is_on_rim(found)) return Way::Open;
    return is_far ? Way::Blocked : Way::Unknown;
  };
  double away_m = 0.0;
  for (double at = from; at != to;) {
    double within = at;
    const double reach = reach_m(at * ray);
    at += toward * std::max(kStep * reach, away_m - reach) / length_m;
    if ((to - at) * toward < 0.0) at = to;
    Way way = way_at(at);
    away_m = found.distance_m;
    if (way == Way::Unknown) continue;
    for (int k = 0; k < kHalves; ++k) {
      const double middle = 0.5 * (within + at);
      const Way there = way_at(middle);
      (there == Way::Unknown ? within : at) = middle;
      if (there != Way::Unknown) way = there;
    }
    return way;
  }
  return Way::Unknown;
}

bool MeshBandWalk::is_beyond(const glm::dvec3& from_eye_m,
                             const reference::NearestPoint& found) const {
  return found.distance_m > reach_m(from_eye_m) + truth_.slack_m();
}

// Pixels count as what they span there across the view: along it a surface could move without end.
double MeshBandWalk::reach_m(const glm::dvec3& from_eye_m) const {
  return std::max(band_.metres, band_.pixels / pixels_per_metre(local_, from_eye_m));
}

bool MeshBandWalk::is_on_rim(const reference::NearestPoint& found) const {
  const TriangleMesh& mesh = truth_.mesh();
  const Triangle& corners = mesh.triangles[found.triangle];
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 &a = mesh.vertices_m[corners[k]], &b = mesh.vertices_m[corners[(k + 1) % 3]];
    if (border().rim_vertices[corners[k]] && glm::distance(found.point_m, a) <= truth_.slack_m())
      return true;
    if ((border().rim_edges[found.triangle] >> k & 1) != 0 &&
        glm::distance(found.point_m, reference::nearest_on_segment(found.point_m, a, b)) <=
            truth_.slack_m())
      return true;
  }
  return false;
}

bool MeshBandWalk::enters_rock(const glm::dvec3& ray, std::uint32_t triangle) const {
  const TriangleMesh& mesh = truth_.mesh();
  const Triangle& corners = mesh.triangles[triangle];
  const glm::dvec3& a = mesh.vertices_m[corners[0]];
  return glm::dot(ray, glm::cross(mesh.vertices_m[corners[1]] - a,
                                  mesh.vertices_m[corners[2]] - a)) < 0.0;
}

// Where the ray passes the sides of the mesh; straight down it never does.
double MeshBandWalk::leaves_at(const glm::dvec3& ray) const {
  double leaves = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    if (ray[axis] == 0.0) continue;
    const double wall = ray[axis] > 0.0 ? border().box.high[axis] : border().box.low[axis];
    leaves = std::min(leaves, (wall - local_.eye_m[axis]) / ray[axis]);
  }
  return leaves;
}

// Made when a doubtful pixel first asks: most pictures have none.
const MeshBandWalk::Border& MeshBandWalk::border() const {
  std::call_once(once_,
                 [&] { border_ = std::make_unique<const Border>(border_of(truth_.mesh())); });
  return *border_;
}

MeshBandWalk::Border MeshBandWalk::border_of(const TriangleMesh& mesh) {
  Border border;
  for (const glm::dvec3& vertex : mesh.vertices_m) border.box.add(vertex);
  border.rim_vertices.resize(mesh.vertices_m.size());
  border.rim_edges.resize(mesh.triangles.size());
  const MeshEdges edges(mesh);
  for (std::uint32_t low = 0; low < edges.vertices(); ++low) {
    edges.for_each_edge(low, [&](std::span<const HalfEdge> sides) {
      if (sides.size() != 1) return;
      const HalfEdge& side = sides[0];
      border.rim_vertices[low] = border.rim_vertices[side.high] = true;
      const Triangle& corners = mesh.triangles[side.triangle];
      const auto corner = std::find(corners.begin(), corners.end(), side.rising ? low : side.high) -
                          corners.begin();
      border.rim_edges[side.triangle] |= static_cast<std::uint8_t>(1 << corner);
    });
  }
  return border;
}

}  // namespace plumb::audit
