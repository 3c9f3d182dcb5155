// What moved between two meshes over a heightfield: equation (15) of
// docs/algorithms/ground-truth.md.
#include <cmath>

#include "audit/surface_deviation.h"
#include "audit/temporal/change_maps.h"
#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb::audit::temporal {
namespace {

constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};

// Points of the truth, relative to the terrain's origin, with what two meshes draw over them.
struct Compared {
  std::vector<glm::dvec3> at_m;
  std::vector<Deviation> now, before;
};

void deviate(Compared& compared, const terrain::Heightfield& field, const Frames& frames) {
  compared.now = deviation_at(field, *frames.now.surface().mesh, compared.at_m);
  compared.before = frames.now.draws_as(frames.before)
                        ? compared.now
                        : deviation_at(field, *frames.before.surface().mesh, compared.at_m);
}

// Both heights were evaluated: what the slack of both explains is no motion.
Moved moved_at(const Compared& compared, std::size_t k, const Camera& local, double slack_m) {
  const Deviation &now = compared.now[k], &before = compared.before[k];
  if (!now.covered() || !before.covered()) return {};
  const double went_m = now.delta_m - before.delta_m;
  if (std::abs(went_m) <= 2.0 * slack_m) return {0.0, 0.0};
  const glm::dvec3 from = compared.at_m[k] + before.delta_m * kUp;
  return {screen_displacement_px(local, from, kUp, went_m), std::abs(went_m)};
}

// The places of a mesh's vertices on the truth that both cameras have in view.
void add_vertices(Compared& compared, const HeightfieldTruth& truth, const TriangleMesh& mesh,
                  const Camera& now, const Camera& before) {
  std::vector<char> used(mesh.vertices_m.size(), 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) used[vertex] = 1;
  }
  const glm::dvec3 shift = mesh.origin_m - truth.field().world_origin_m();
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) continue;
    glm::dvec3 place = mesh.vertices_m[v] + shift;
    place.z = truth.height_at(place.x, place.y);
    if (std::isnan(place.z) || !in_view(now, place) || !in_view(before, place)) continue;
    compared.at_m.push_back(place);
  }
}

}  // namespace

ChangeMaps heights_moved(const HeightfieldTruth& truth, const HitImage& true_hits,
                         const Frames& frames) {
  const glm::dvec3 origin = truth.field().world_origin_m();
  const Camera now = relative_to(frames.now.camera(), origin);
  const Camera before = relative_to(frames.before.camera(), origin);
  Compared compared;
  std::vector<std::size_t> pixels;
  for (std::size_t pixel = 0; pixel < true_hits.size(); ++pixel) {
    if (!true_hits.hit(pixel)) continue;
    const glm::dvec3 point = now.eye_m + true_hits.from_eye_m[pixel];
    if (!in_view(before, point)) continue;
    compared.at_m.push_back(point);
    pixels.push_back(pixel);
  }
  deviate(compared, truth.field(), frames);
  ChangeMaps maps(true_hits.size());
  std::vector<Moved> moved(true_hits.size());
  parallel_for(static_cast<std::int64_t>(pixels.size()), 4096, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    moved[pixels[k]] = moved_at(compared, k, now, truth.slack_m);
    maps.now[pixels[k]] = compared.now[k].triangle;
    maps.before[pixels[k]] = compared.before[k].triangle;
  });
  set_moved(maps, moved);
  if (maps.worst_pixel >= 0)
    maps.worst_m = frames.now.camera().eye_m +
                   true_hits.from_eye_m[static_cast<std::size_t>(maps.worst_pixel)];
  if (frames.earlier == nullptr) return maps;
  const Camera earlier = relative_to(frames.earlier->camera(), origin);
  const std::vector<Deviation> drawn =
      deviation_at(truth.field(), *frames.earlier->surface().mesh, compared.at_m);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    if (in_view(earlier, compared.at_m[k])) maps.earlier[pixels[k]] = drawn[k].triangle;
  }
  return maps;
}

PoppedVertices vertices_moved(const HeightfieldTruth& truth, const Frames& frames) {
  const glm::dvec3 origin = truth.field().world_origin_m();
  const Camera now = relative_to(frames.now.camera(), origin);
  const Camera before = relative_to(frames.before.camera(), origin);
  Compared compared;
  add_vertices(compared, truth, *frames.now.surface().mesh, now, before);
  if (!frames.now.draws_as(frames.before))
    add_vertices(compared, truth, *frames.before.surface().mesh, now, before);
  deviate(compared, truth.field(), frames);
  PoppedVertices vertices;
  for (std::size_t k = 0; k < compared.at_m.size(); ++k) {
    const Moved moved = moved_at(compared, k, now, truth.slack_m);
    if (moved.px < 0.0) continue;
    ++vertices.count;
    vertices.max_m = std::max(vertices.max_m, moved.m);
    if (!(moved.px > vertices.max_px)) continue;
    vertices.max_px = moved.px;
    vertices.worst_m = origin + compared.at_m[k];
  }
  return vertices;
}

}  // namespace plumb::audit::temporal
