// The deviation between the samples: where drawn edges cross true ones.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "audit/grid_crossings.h"
#include "audit/sample_error.h"
#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};

// Whole but for less than kOnLine; without a call for the rounding, which loops over edges feel.
bool is_whole(double u) {
  const double part = std::abs(u) - static_cast<double>(static_cast<std::int64_t>(std::abs(u)));
  return part < kOnLine || part > 1.0 - kOnLine;
}

bool on_sample(double u, double v) { return is_whole(u) && is_whole(v); }

class EdgeWalk {
 public:
  EdgeWalk(const HeightfieldTruth& truth, const Camera& local)
      : truth_(truth),
        camera_(local),
        up_(direction_to_view(local, kUp)),
        crossings_(truth.field(), truth.diagonal()) {}

  // The inside of the edge from p to q.
  void edge(const glm::dvec3& p, const glm::dvec3& q, std::uint32_t triangle, EdgeErrors& errors) {
    const terrain::Heightfield& field = truth_.field();
    const double pu = p.x / field.dx_m, pv = p.y / field.dy_m, du = q.x / field.dx_m - pu,
                 dv = q.y / field.dy_m - pv;
    if (std::abs(du) < 1.5 && std::abs(dv) < 1.5 && on_sample(pu, pv) &&
        on_sample(pu + du, pv + dv)) {
      // From sample to neighbouring sample: only a cell's other diagonal can cross it, in the
      // middle.
      if (std::abs(du) > 0.5 && std::abs(dv) > 0.5) look(0.5 * (p + q), triangle, errors);
      return;
    }
    crossings_.between(p, q, [&](const glm::dvec3& at) { look(at, triangle, errors); });
  }

  // A vertex, unless it is a sample, which is measured as such.
  void vertex(const glm::dvec3& p, std::uint32_t triangle, EdgeErrors& errors) const {
    const terrain::Heightfield& field = truth_.field();
    if (!on_sample(p.x / field.dx_m, p.y / field.dy_m)) look(p, triangle, errors);
  }

 private:
  void look(const glm::dvec3& drawn, std::uint32_t triangle, EdgeErrors& errors) const {
    const double height = truth_.height_at(drawn.x, drawn.y);
    if (std::isnan(height)) return;
    ++errors.places;
    const double delta = drawn.z - height, metres = std::abs(delta);
    const glm::dvec3 point{drawn.x, drawn.y, height};
    if (metres > errors.max_m) {
      errors.max_m = metres;
      errors.worst_m = point;
      errors.triangle_m = triangle;
    }
    const glm::dvec3 view = to_view(camera_, point);
    if (metres == 0.0 || is_surely_less(view, delta, errors.max_px) || !in_frustum(camera_, point))
      return;
    const double pixels = screen_displacement_of_view_px(camera_, view, up_, delta);
    if (pixels > errors.max_px) {
      errors.max_px = pixels;
      errors.pixels_per_metre = pixels / metres;
      errors.worst_px = point;
      errors.triangle_px = triangle;
    }
  }

  // True only if the displacement on screen is below `most_px`: squared, without root or quotient.
  bool is_surely_less(const glm::dvec3& view, double delta, double most_px) const {
    constexpr double kRoundings = 1e-9;
    const double moved = view.z + delta * up_.z;
    if (!(view.z > 0.0) || !(moved > 0.0)) return false;
    const glm::dvec2 n = screen_velocity(camera_, view, up_);
    const double limit = most_px * view.z * moved;
    return delta * delta * glm::dot(n, n) < limit * limit * (1.0 - kRoundings);
  }

  const HeightfieldTruth& truth_;
  const Camera& camera_;
  glm::dvec3 up_;  // in view coordinates
  GridCrossings crossings_;
};

EdgeErrors worse(EdgeErrors a, const EdgeErrors& b) {
  if (b.max_m > a.max_m) {
    a.max_m = b.max_m;
    a.worst_m = b.worst_m;
    a.triangle_m = b.triangle_m;
  }
  if (b.max_px > a.max_px) {
    a.max_px = b.max_px;
    a.pixels_per_metre = b.pixels_per_metre;
    a.worst_px = b.worst_px;
    a.triangle_px = b.triangle_px;
  }
  a.places += b.places;
  return a;
}

}  // namespace

EdgeErrors edge_errors(const HeightfieldTruth& truth, const TriangleMesh& mesh,
                       const MeshEdges& edges, const Camera& camera) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  const glm::dvec3 shift = mesh.origin_m - truth.field().world_origin_m();
  return parallel_ordered_reduce(
      edges.vertices(), 4096, EdgeErrors{},
      [&](std::int64_t begin, std::int64_t end, EdgeErrors errors) {
        EdgeWalk walk(truth, local);
        for (auto low = static_cast<std::uint32_t>(begin); low < end; ++low) {
          const auto sides = edges.from(low);
          if (sides.empty()) continue;
          const glm::dvec3 p = mesh.vertices_m[low] + shift;
          walk.vertex(p, sides.front().triangle, errors);
          std::uint32_t last = low;
          for (const HalfEdge& side : sides) {
            if (side.high == last) continue;  // the same edge, of another triangle
            last = side.high;
            const glm::dvec3 q = mesh.vertices_m[last] + shift;
            walk.edge(p, q, side.triangle, errors);
            // A vertex that is the lesser of no edge has no turn of its own.
            if (edges.from(last).empty()) walk.vertex(q, side.triangle, errors);
          }
        }
        return errors;
      },
      worse);
}

}  // namespace plumb::audit
