#include "audit/temporal/frame_change.h"

#include <algorithm>
#include <cmath>

#include "audit/temporal/change_maps.h"
#include "core/check.h"

namespace plumb::audit::temporal {
namespace {

DrawnThere drawn_there(const Frame& frame, std::uint32_t primitive) {
  DrawnThere there;
  there.primitive = primitive;
  if (primitive == kNoPrimitive) return there;
  there.patch = frame.patch_at(primitive);
  if (there.patch >= 0)
    there.patch_name = frame.surface().patches[static_cast<std::size_t>(there.patch)].name;
  there.level = frame.level_of(primitive);
  return there;
}

Popping popping_of(ChangeMaps& maps, const Frames& frames) {
  Popping popping;
  popping.pixels = distribution_of(maps.px);
  popping.max_px = maps.max_px;
  popping.over_1px =
      std::count_if(maps.px.begin(), maps.px.end(), [](float px) { return px > 1.0f; });
  popping.px = std::move(maps.px);
  if (maps.worst_pixel < 0) return popping;
  const auto pixel = static_cast<std::size_t>(maps.worst_pixel);
  const int width = frames.now.camera().width_px;
  PoppedPlace worst;
  worst.x = static_cast<int>(maps.worst_pixel % width);
  worst.y = static_cast<int>(maps.worst_pixel / width);
  worst.world_m = maps.worst_m;
  worst.px = maps.max_px;
  worst.m = maps.max_m;
  worst.before = drawn_there(frames.before, maps.before[pixel]);
  worst.after = drawn_there(frames.now, maps.now[pixel]);
  popping.worst = worst;
  return popping;
}

Flicker flicker_of(const ChangeMaps& maps, const Frames& frames) {
  Flicker flicker;
  std::vector<std::int64_t> of_patch(frames.now.surface().patches.size(), 0);
  for (std::size_t pixel = 0; pixel < maps.now.size(); ++pixel) {
    const std::uint32_t now = maps.now[pixel];
    if (now == kNoPrimitive || maps.before[pixel] == kNoPrimitive ||
        maps.earlier[pixel] == kNoPrimitive)
      continue;
    ++flicker.compared;
    const int level = frames.now.level_of(now);
    if (frames.earlier->level_of(maps.earlier[pixel]) != level ||
        frames.before.level_of(maps.before[pixel]) == level)
      continue;
    ++flicker.pixels;
    const int patch = frames.now.patch_at(now);
    if (patch < 0) continue;
    std::int64_t& count = of_patch[static_cast<std::size_t>(patch)];
    flicker.patches += count++ == 0;
  }
  const auto most = std::max_element(of_patch.begin(), of_patch.end());
  if (most == of_patch.end() || *most == 0) return flicker;
  flicker.worst_pixels = *most;
  flicker.worst.patch = static_cast<int>(most - of_patch.begin());
  const Patch& patch = frames.now.surface().patches[static_cast<std::size_t>(flicker.worst.patch)];
  flicker.worst.patch_name = patch.name;
  flicker.worst.level = patch.lod;
  return flicker;
}

ChangeMaps maps_of(const TruthTerms& truth, const AuditResult& audited, const Frames& frames,
                   const ChangeOptions& options) {
  if (truth.mesh() != nullptr) return nearest_moved(*truth.mesh(), audited.true_hits, frames);
  return frames.now.has_mesh() ? heights_moved(*truth.heights(), audited.true_hits, frames)
                               : shown_moved(*truth.heights(), audited, frames, options.band);
}

}  // namespace

FrameChange change_between(const TruthTerms& truth, const AuditResult& audited, const Frame& now,
                           const Frame* before, const Frame* earlier,
                           const ChangeOptions& options) {
  FrameChange change;
  if (before == nullptr) return change;
  const bool levels =
      earlier != nullptr && now.has_levels() && before->has_levels() && earlier->has_levels();
  const Frames frames{now, *before, levels ? earlier : nullptr};
  require(now.has_mesh() == before->has_mesh() &&
              (earlier == nullptr || now.has_mesh() == earlier->has_mesh()) &&
              (truth.mesh() == nullptr || now.has_mesh()),
          "frames of a path are surfaces of one kind");
  require(audited.true_hits.width_px == now.camera().width_px &&
              audited.true_hits.height_px == now.camera().height_px,
          "the audit is not one of this frame: its picture is {} x {}, the camera's {} x {}",
          audited.true_hits.width_px, audited.true_hits.height_px, now.camera().width_px,
          now.camera().height_px);
  ChangeMaps maps = maps_of(truth, audited, frames, options);
  if (levels) change.flicker = flicker_of(maps, frames);
  change.popping = popping_of(maps, frames);
  if (options.vertices && now.has_mesh() && truth.heights() != nullptr)
    change.popping->vertices = vertices_moved(*truth.heights(), frames);
  return change;
}

}  // namespace plumb::audit::temporal
