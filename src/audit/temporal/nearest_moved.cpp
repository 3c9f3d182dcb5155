// What moved between two meshes of any kind: equation (17) of docs/algorithms/ground-truth.md.
#include <algorithm>
#include <array>
#include <span>

#include "audit/apart_on_screen.h"
#include "audit/drawn_point.h"
#include "audit/pixel_tile.h"
#include "audit/temporal/change_maps.h"

namespace plumb::audit::temporal {
namespace {

using reference::NearestPoint;
using reference::NearestQuery;

// A frame's mesh as the later camera sees it.
struct Side {
  const reference::MeshNearest* nearest;
  glm::dvec3 origin_m;  // of the mesh, relative to the terrain's
  double slack_m;

  Side(const Frame& frame, const glm::dvec3& origin)
      : nearest(frame.nearest()),
        origin_m(frame.surface().mesh->origin_m - origin),
        slack_m(mesh_slack_m(*frame.surface().mesh)) {}

  glm::dvec3 place(const NearestPoint& found) const { return found.point_m + origin_m; }
  NearestPoint to(const glm::dvec3& point_m, double radius_m, std::uint32_t hint) const {
    return nearest->nearest(point_m - origin_m, radius_m, hint);
  }
};

class Pairing {
 public:
  Pairing(const MeshTruth& truth, const Camera& local, const Side& now, const Side& before)
      : local_(local),
        now_(now),
        before_(before),
        slack_m_(truth.slack_m() + now.slack_m + before.slack_m) {}

  // How far the drawn counterpart of a point went: from the one frame's nearest point to the
  // other's, or from each to the nearest of the other mesh, whichever explains it by less.
  Moved operator()(const NearestPoint& now, const NearestPoint& before, double reach_m) const {
    if (!now || !before) return {};
    const glm::dvec3 a = before_.place(before), b = now_.place(now);
    const double slack = slack_m_ + drawn_point_slack_m(reach_m);
    const double apart_m = glm::length(b - a);
    if (apart_m <= slack) return {0.0, 0.0};
    const double radius = apart_m * (1.0 + 1e-6) + slack;
    const Moved there = gone(a, now_.to(a, radius, now.triangle), now_, slack);
    const Moved back = gone(b, before_.to(b, radius, before.triangle), before_, slack);
    const Moved longer = back.px > there.px ? back : there;
    const double straight_px = apart_on_screen(local_, a, b);
    return straight_px < longer.px ? Moved{straight_px, apart_m} : longer;
  }

 private:
  Moved gone(const glm::dvec3& from_m, const NearestPoint& found, const Side& to,
             double slack) const {
    if (found.distance_m <= slack) return {0.0, 0.0};
    return {apart_on_screen(local_, from_m, to.place(found)), found.distance_m};
  }

  const Camera& local_;
  const Side &now_, &before_;
  double slack_m_;
};

}  // namespace

ChangeMaps nearest_moved(const MeshTruth& truth, const HitImage& true_hits, const Frames& frames) {
  const glm::dvec3 origin = truth.field().world_origin_m();
  const Camera local = relative_to(frames.now.camera(), origin);
  const Camera before_camera = relative_to(frames.before.camera(), origin);
  ChangeMaps maps(true_hits.size());
  const Side now(frames.now, origin), before(frames.before, origin);
  if (now.nearest == nullptr || before.nearest == nullptr) return maps;
  const Pairing pairing(truth, local, now, before);
  const double eye_reach = largest_coordinate(local.eye_m);
  std::vector<Moved> moved(true_hits.size());
  const auto found_by = [](const Side& side, std::span<const glm::dvec3> points,
                           std::span<NearestPoint> found) {
    std::array<NearestQuery, PixelTile::kPixels> queries;
    for (std::size_t k = 0; k < points.size(); ++k) {
      queries[k] = {};
      queries[k].point_m = points[k] - side.origin_m;
    }
    side.nearest->nearest_together(std::span(queries).first(points.size()), found);
  };
  const auto for_points = [&](const Camera& view, const auto& visit) {
    for_each_tile(true_hits, [&](const PixelTile& tile) {
      std::array<std::size_t, PixelTile::kPixels> pixels;
      std::array<glm::dvec3, PixelTile::kPixels> points;
      std::size_t count = 0;
      tile.for_each([&](std::size_t pixel) {
        const glm::dvec3 point = local.eye_m + true_hits.from_eye_m[pixel];
        if (!true_hits.hit(pixel) || !in_view(view, point)) return;
        points[count] = point;
        pixels[count++] = pixel;
      });
      visit(std::span(pixels).first(count), std::span<const glm::dvec3>(points).first(count));
    });
  };
  for_points(
      before_camera, [&](std::span<const std::size_t> pixels, std::span<const glm::dvec3> points) {
        std::array<NearestPoint, PixelTile::kPixels> in_now, in_before;
        found_by(now, points, std::span(in_now).first(points.size()));
        found_by(before, points, std::span(in_before).first(points.size()));
        for (std::size_t k = 0; k < pixels.size(); ++k) {
          const std::size_t pixel = pixels[k];
          const double reach = std::max(eye_reach, largest_coordinate(true_hits.from_eye_m[pixel]));
          moved[pixel] = pairing(in_now[k], in_before[k], reach);
          maps.now[pixel] = in_now[k].triangle;
          maps.before[pixel] = in_before[k].triangle;
        }
      });
  set_moved(maps, moved);
  if (maps.worst_pixel >= 0)
    maps.worst_m = frames.now.camera().eye_m +
                   true_hits.from_eye_m[static_cast<std::size_t>(maps.worst_pixel)];
  if (frames.earlier == nullptr) return maps;
  const Side earlier(*frames.earlier, origin);
  if (earlier.nearest == nullptr) return maps;
  for_points(relative_to(frames.earlier->camera(), origin),
             [&](std::span<const std::size_t> pixels, std::span<const glm::dvec3> points) {
               std::array<NearestPoint, PixelTile::kPixels> found;
               found_by(earlier, points, std::span(found).first(points.size()));
               for (std::size_t k = 0; k < pixels.size(); ++k)
                 maps.earlier[pixels[k]] = found[k].triangle;
             });
  return maps;
}

}  // namespace plumb::audit::temporal
