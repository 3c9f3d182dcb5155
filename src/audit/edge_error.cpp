#include "audit/edge_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "audit/flat_triangle.h"
#include "audit/grid_crossings.h"
#include "audit/sample_error.h"
#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};
constexpr std::int64_t kGrain = 4096;  // vertices that one task takes

// Whole but for less than kOnLine; without a call for the rounding, which loops over edges feel.
bool is_whole(double u) {
  const double part = std::abs(u) - static_cast<double>(static_cast<std::int64_t>(std::abs(u)));
  return part < kOnLine || part > 1.0 - kOnLine;
}

bool on_sample(double u, double v) { return is_whole(u) && is_whole(v); }

// Vertical triangles (skirts) and those without area lie over no place: their edges count where
// another triangle shares them.
class PlacelessTriangles {
 public:
  explicit PlacelessTriangles(const TriangleMesh& mesh) : placeless_(mesh.triangles.size()) {
    parallel_for(static_cast<std::int64_t>(placeless_.size()), 1 << 14, [&](std::int64_t t) {
      const Triangle& corners = mesh.triangles[static_cast<std::size_t>(t)];
      const FlatTriangle flat(mesh.vertices_m[corners[0]], mesh.vertices_m[corners[1]],
                              mesh.vertices_m[corners[2]]);
      placeless_[static_cast<std::size_t>(t)] = flat.is_flat() ? 0 : 1;
    });
  }
  bool operator[](std::uint32_t triangle) const { return placeless_[triangle] != 0; }
  /// The first side that is of a triangle over a place; null if none is.
  const HalfEdge* first_placed(std::span<const HalfEdge> sides) const {
    for (const HalfEdge& side : sides)
      if (placeless_[side.triangle] == 0) return &side;
    return nullptr;
  }

 private:
  std::vector<std::uint8_t> placeless_;
};

// Goes through the places between the samples, in an order that the mesh alone decides.
class EdgeWalk {
 public:
  EdgeWalk(const HeightfieldTruth& truth, const TriangleMesh& mesh, const MeshEdges& edges,
           const PlacelessTriangles& placeless)
      : field_(truth.field()),
        mesh_(mesh),
        edges_(edges),
        placeless_(placeless),
        shift_(mesh.origin_m - field_.world_origin_m()),
        crossings_(field_, truth.diagonal()) {}

  // Of the vertices [begin, end) and the edges on which they are the lesser one; look(place drawn,
  // triangle).
  template <class Look>
  void operator()(std::int64_t begin, std::int64_t end, const Look& look) {
    for (auto low = static_cast<std::uint32_t>(begin); low < end; ++low) {
      const auto sides = edges_.from(low);
      const HalfEdge* first = placeless_.first_placed(sides);
      if (first == nullptr) continue;
      const glm::dvec3 p = mesh_.vertices_m[low] + shift_;
      vertex(p, first->triangle, look);
      std::uint32_t last = low;
      for (const HalfEdge& side : sides) {
        if (side.high == last) continue;  // the same edge, of another triangle
        if (placeless_[side.triangle]) continue;
        last = side.high;
        const glm::dvec3 q = mesh_.vertices_m[last] + shift_;
        edge(p, q, side.triangle, look);
        // A vertex that is the lesser of no edge has no turn of its own.
        if (placeless_.first_placed(edges_.from(last)) == nullptr) vertex(q, side.triangle, look);
      }
    }
  }

 private:
  // The inside of the edge from p to q.
  template <class Look>
  void edge(const glm::dvec3& p, const glm::dvec3& q, std::uint32_t triangle, const Look& look) {
    const double pu = p.x / field_.dx_m, pv = p.y / field_.dy_m, du = q.x / field_.dx_m - pu,
                 dv = q.y / field_.dy_m - pv;
    if (std::abs(du) < 1.5 && std::abs(dv) < 1.5 && on_sample(pu, pv) &&
        on_sample(pu + du, pv + dv)) {
      // From sample to neighbouring sample: only a cell's other diagonal can cross it, in the
      // middle.
      if (std::abs(du) > 0.5 && std::abs(dv) > 0.5) look(0.5 * (p + q), triangle);
      return;
    }
    crossings_.between(p, q, [&](const glm::dvec3& at) { look(at, triangle); });
  }

  // A vertex, unless it is a sample, which is measured as such.
  template <class Look>
  void vertex(const glm::dvec3& p, std::uint32_t triangle, const Look& look) const {
    if (!on_sample(p.x / field_.dx_m, p.y / field_.dy_m)) look(p, triangle);
  }

  const terrain::Heightfield& field_;
  const TriangleMesh& mesh_;
  const MeshEdges& edges_;
  const PlacelessTriangles& placeless_;
  glm::dvec3 shift_;
  GridCrossings crossings_;
};

// What is wrong at a place.
class PlaceMeasure {
 public:
  PlaceMeasure(const HeightfieldTruth& truth, const Camera& local)
      : truth_(truth), camera_(local), up_(direction_to_view(local, kUp)) {}

  void add(const glm::dvec3& drawn, std::uint32_t triangle, EdgeErrors& errors) const {
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

  // Where it is, and by how much it is off in `unit`; NaN where nothing is measured.
  EdgePlace at(const glm::dvec3& drawn, std::uint32_t triangle, Unit unit) const {
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
    const double height = truth_.height_at(drawn.x, drawn.y), delta = drawn.z - height;
    const glm::dvec3 point{drawn.x, drawn.y, height};
    if (std::isnan(height)) return {kNothing, point, triangle};
    if (unit == Unit::Metre) return {std::abs(delta), point, triangle};
    if (!in_frustum(camera_, point)) return {kNothing, point, triangle};
    const double pixels =
        delta == 0.0 ? 0.0
                     : screen_displacement_of_view_px(camera_, to_view(camera_, point), up_, delta);
    return {pixels, point, triangle};
  }

 private:
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

// Keeps the `most` worst; a place that comes later stands behind its equals.
void keep_place(std::vector<EdgePlace>& worst, const EdgePlace& place, std::size_t most) {
  if (worst.size() == most && (most == 0 || !(place.error > worst.back().error))) return;
  const auto is_worse = [](const EdgePlace& a, const EdgePlace& b) { return a.error > b.error; };
  worst.insert(std::upper_bound(worst.begin(), worst.end(), place, is_worse), place);
  if (worst.size() > most) worst.pop_back();
}

}  // namespace

EdgeErrors edge_errors(const HeightfieldTruth& truth, const TriangleMesh& mesh,
                       const MeshEdges& edges, const Camera& camera) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  const PlaceMeasure measure(truth, local);
  const PlacelessTriangles placeless(mesh);
  return parallel_ordered_reduce(
      edges.vertices(), kGrain, EdgeErrors{},
      [&](std::int64_t begin, std::int64_t end, EdgeErrors errors) {
        EdgeWalk(truth, mesh, edges, placeless)(
            begin, end, [&](const glm::dvec3& drawn, std::uint32_t triangle) {
              measure.add(drawn, triangle, errors);
            });
        return errors;
      },
      worse);
}

EdgePlacesOver edge_places_over(const HeightfieldTruth& truth, const TriangleMesh& mesh,
                                const MeshEdges& edges, const Camera& camera,
                                const Tolerance& bound, std::size_t most) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  const PlaceMeasure measure(truth, local);
  const PlacelessTriangles placeless(mesh);
  return parallel_ordered_reduce(
      edges.vertices(), kGrain, EdgePlacesOver{},
      [&](std::int64_t begin, std::int64_t end, EdgePlacesOver over) {
        EdgeWalk(truth, mesh, edges, placeless)(
            begin, end, [&](const glm::dvec3& drawn, std::uint32_t triangle) {
              const EdgePlace place = measure.at(drawn, triangle, bound.unit);
              if (!(place.error > bound.value)) return;
              ++over.count;
              keep_place(over.worst, place, most);
            });
        return over;
      },
      [&](EdgePlacesOver a, const EdgePlacesOver& b) {
        a.count += b.count;
        for (const EdgePlace& place : b.worst) keep_place(a.worst, place, most);
        return a;
      });
}

}  // namespace plumb::audit
