// The deviation between the samples: where drawn edges cross true ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "audit/sample_error.h"
#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};
constexpr double kOnLine = 1e-9;  // cells

bool on_sample(double u, double v) {
  return std::abs(u - std::round(u)) < kOnLine && std::abs(v - std::round(v)) < kOnLine;
}

class EdgeWalk {
 public:
  EdgeWalk(const HeightfieldTruth& truth, const Camera& local) : truth_(truth), camera_(local) {}

  void edge(const glm::dvec3& p, const glm::dvec3& q, std::uint32_t triangle, EdgeErrors& errors) {
    const terrain::Heightfield& field = truth_.field();
    const double pu = p.x / field.dx_m, pv = p.y / field.dy_m, du = q.x / field.dx_m - pu,
                 dv = q.y / field.dy_m - pv;
    const bool from_sample = on_sample(pu, pv), to_sample = on_sample(pu + du, pv + dv);
    if (!from_sample) look(p, triangle, errors);
    if (from_sample && to_sample && std::abs(du) < 1.5 && std::abs(dv) < 1.5) {
      // From sample to neighbouring sample: only a cell's other diagonal can cross it, in the
      // middle.
      if (std::abs(du) > 0.5 && std::abs(dv) > 0.5) look(0.5 * (p + q), triangle, errors);
      return;
    }
    shares_.assign({0.0, 1.0});
    add_lines(pu, du);
    add_lines(pv, dv);
    std::sort(shares_.begin(), shares_.end());
    const std::size_t count = shares_.size();
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const double from = shares_[k], to = shares_[k + 1];
      if (k > 0) look(p + from * (q - p), triangle, errors);
      const double middle = 0.5 * (from + to);
      const int i = static_cast<int>(std::floor(pu + middle * du)),
                j = static_cast<int>(std::floor(pv + middle * dv));
      // On the cell's diagonal (u - i) -+ (v - j) is 0 or 1; both ends on it means that the edge
      // runs along it.
      const bool rises = rises_north_east(truth_.diagonal(), i, j);
      const auto side = [&](double share) {
        const double a = pu + share * du - i, b = pv + share * dv - j;
        return rises ? a - b : 1.0 - (a + b);
      };
      const double one = side(from), other = side(to);
      if ((one > kOnLine && other < -kOnLine) || (one < -kOnLine && other > kOnLine)) {
        look(p + (from + (to - from) * (one / (one - other))) * (q - p), triangle, errors);
      }
    }
  }

 private:
  void add_lines(double from, double step) {
    if (std::abs(step) < kOnLine) return;
    const double low = std::min(from, from + step), high = std::max(from, from + step);
    for (double line = std::floor(low) + 1.0; line < high; line += 1.0)
      shares_.push_back((line - from) / step);
  }

  void look(const glm::dvec3& drawn, std::uint32_t triangle, EdgeErrors& errors) {
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
    if (metres == 0.0 || !in_frustum(camera_, point)) return;
    const double pixels = screen_displacement_px(camera_, point, kUp, delta);
    if (pixels > errors.max_px) {
      errors.max_px = pixels;
      errors.pixels_per_metre = pixels / metres;
      errors.worst_px = point;
      errors.triangle_px = triangle;
    }
  }

  const HeightfieldTruth& truth_;
  const Camera& camera_;
  std::vector<double> shares_;  // of the way from p to q
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

EdgeErrors edge_errors(const HeightfieldTruth& truth, const DrawnSurface& surface,
                       const Camera& camera) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  const TriangleMesh& mesh = *surface.mesh;
  const glm::dvec3 shift = mesh.origin_m - truth.field().world_origin_m();
  return parallel_ordered_reduce(
      static_cast<std::int64_t>(mesh.triangles.size()), 4096, EdgeErrors{},
      [&](std::int64_t begin, std::int64_t end, EdgeErrors errors) {
        EdgeWalk walk(truth, local);
        for (std::int64_t t = begin; t < end; ++t) {
          const Triangle& corners = mesh.triangles[static_cast<std::size_t>(t)];
          std::array<glm::dvec3, 3> p;
          for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.vertices_m[corners[k]] + shift;
          for (std::size_t k = 0; k < 3; ++k)
            walk.edge(p[k], p[(k + 1) % 3], static_cast<std::uint32_t>(t), errors);
        }
        return errors;
      },
      worse);
}

}  // namespace plumb::audit
