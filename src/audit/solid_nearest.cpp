#include "audit/solid_nearest.h"

#include <algorithm>
#include <array>
#include <limits>

#include "audit/apart_on_screen.h"
#include "audit/drawn_point.h"
#include "audit/pixel_tile.h"

namespace plumb::audit {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

NearestMaps nearest_maps(const HitImage& seen, const Camera& camera, const NearestSide& to,
                         std::span<const std::uint32_t> hint) {
  const Camera local = relative_to(camera, to.mesh.origin_m);
  NearestMaps maps{std::vector<float>(seen.size(), kNothing),
                   std::vector<float>(seen.size(), kNothing),
                   std::vector<std::uint32_t>(seen.size(), kNoPrimitive)};
  const double eye_reach = largest_coordinate(local.eye_m);
  for_each_tile(seen, [&](const PixelTile& tile) {
    std::array<std::size_t, PixelTile::kPixels> asked;
    std::array<reference::NearestQuery, PixelTile::kPixels> queries;
    std::array<reference::NearestPoint, PixelTile::kPixels> found;
    std::size_t count = 0;
    tile.for_each([&](std::size_t pixel) {
      if (!seen.hit(pixel)) return;
      maps.px[pixel] = maps.metres[pixel] = kInfinity;
      queries[count] = {local.eye_m + seen.from_eye_m[pixel],
                        std::numeric_limits<double>::infinity(), hint[pixel]};
      asked[count++] = pixel;
    });
    if (!to.nearest) return;
    to.nearest->nearest_together(std::span(queries).first(count), std::span(found).first(count));
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t pixel = asked[k];
      const double reach = std::max(eye_reach, largest_coordinate(seen.from_eye_m[pixel]));
      const bool apart = found[k].distance_m > to.slack_m + drawn_point_slack_m(reach);
      maps.triangle[pixel] = found[k].triangle;
      maps.metres[pixel] = apart ? static_cast<float>(found[k].distance_m) : 0.0f;
      maps.px[pixel] =
          apart ? static_cast<float>(apart_on_screen(local, queries[k].point_m, found[k].point_m))
                : 0.0f;
    }
  });
  return maps;
}

VertexDistances vertex_distances(const TriangleMesh& mesh, const NearestSide& to,
                                 const glm::dvec3& origin_m) {
  std::vector<char> used(mesh.vertices_m.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) used[v] = 1;
  }
  const glm::dvec3 shift = mesh.origin_m - to.mesh.origin_m;
  std::vector<glm::dvec3> points;
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) continue;
    points.push_back(mesh.vertices_m[v] + shift);
    vertices.push_back(v);
  }
  VertexDistances distances;
  distances.metres.assign(points.size(), kInfinity);
  std::vector<reference::NearestPoint> found(points.size());
  if (to.nearest) found = to.nearest->nearest(points);
  std::size_t worst = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double slack = to.slack_m + drawn_point_slack_m(largest_coordinate(points[k]));
    distances.metres[k] =
        found[k].distance_m > slack ? static_cast<float>(found[k].distance_m) : 0.0f;
    if (distances.metres[k] > distances.metres[worst]) worst = k;
  }
  distances.distribution = distribution_of(distances.metres);
  if (found.empty()) return distances;
  distances.worst_m = points[worst] + (to.mesh.origin_m - origin_m);
  distances.worst_vertex = vertices[worst];
  distances.worst_triangle = found[worst].triangle;
  return distances;
}

}  // namespace plumb::audit
