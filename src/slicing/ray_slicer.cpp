#include "slicing/ray_slicer.h"

#include <algorithm>
#include <optional>

#include "core/parallel.h"
#include "slicing/branch_walk.h"
#include "slicing/plane_run.h"

namespace plumb::slicing {
namespace {

constexpr int kFewPlanes = 3;  // of which setting up lanes would cost more than it saves

class RaySlicer {
 public:
  RaySlicer(const SlicingCut& cut, const HeightLookup& heights, double near_m, double far_m)
      : cut_(cut),
        heights_(heights),
        all_{near_m, far_m},
        meet_planes_(meet_planes(instruction_set())),
        run_heights_(heights.for_plane_runs()) {}

  SliceHit cast(const SliceRay& ray, std::int64_t& tested) const {
    SliceHit best;
    walk_bundles(cut_, ray, all_, best.t, [&](std::uint32_t bundle, const Interval& part) {
      meet_bundle(bundle, ray, part, best, tested);
    });
    return best;
  }

 private:
  void meet_bundle(std::uint32_t number, const SliceRay& ray, const Interval& part, SliceHit& best,
                   std::int64_t& tested) const {
    const SliceBundle& bundle = cut_.bundles[number];
    if (bundle.closed) meet_closing_quads(number, ray, best, tested);
    const auto [low, high] = planes_within(bundle, ray, part);
    const double step = ray.direction[index_of(bundle.axis)];
    if (run_heights_ && high - low >= kFewPlanes) {
      meet_run(number, ray, step > 0.0 ? low : high, step > 0.0 ? 1.0 : -1.0, high - low + 1, best,
               tested);
      return;
    }
    for (int k = 0; k <= high - low; ++k) {
      const int j = step > 0.0 ? low + k : high - k;
      if (meet_quad(number, QuadKind::Slice, bundle.axis, bundle.plane_m(j), ray, best, tested))
        return;
    }
  }

  // The same for many planes at once.
  void meet_run(std::uint32_t number, const SliceRay& ray, int first, double step, int count,
                SliceHit& best, std::int64_t& tested) const {
    const SliceBundle& bundle = cut_.bundles[number];
    PlaneRun run;
    for (int k = 0; k < 3; ++k) {
      run.eye_m[k] = ray.eye_m[k];
      run.direction[k] = ray.direction[k];
      run.low_m[k] = bundle.reach.low[k];
      run.high_m[k] = bundle.reach.high[k];
    }
    run.axis = index_of(bundle.axis);
    run.inverse = ray.inverse[run.axis];
    run.first_plane = first;
    run.step = step;
    run.count = count;
    run.first_m = bundle.first_m;
    run.spacing_m = bundle.spacing_m;
    run.near_t = all_.begin;
    run.far_t = all_.end;
    run.best_t = best.t;
    run.raise_m = bundle.raise_m;
    run.least_z_m = bundle.least_z_m;
    run.greatest_z_m = bundle.greatest_z_m;
    const PlaneRunEnd end = meet_planes_(run, *run_heights_);
    tested += end.tested;
    if (end.plane >= 0) best = std::min(best, SliceHit{end.t, number});
  }

  void meet_closing_quads(std::uint32_t number, const SliceRay& ray, SliceHit& best,
                          std::int64_t& tested) const {
    for_each_closing_quad(cut_.bundles[number], [&](Axis axis, double at_m) {
      meet_quad(number, QuadKind::Closing, axis, at_m, ray, best, tested);
    });
  }

  // True if no plane behind this one can be nearer than the best.
  bool meet_quad(std::uint32_t number, QuadKind kind, Axis axis, double at_m, const SliceRay& ray,
                 SliceHit& best, std::int64_t& tested) const {
    const SliceBundle& bundle = cut_.bundles[number];
    if (ray.direction[index_of(axis)] == 0.0) return false;
    const PlanePoint met = meet_plane(ray, axis, at_m);
    if (met.t > best.t) return true;
    if (!(met.t >= all_.begin && met.t <= all_.end) || !is_on_quad(bundle, axis, met.point_m))
      return false;
    ++tested;
    if (!passes(bundle, kind, axis, heights_, ray, met)) return false;
    best = std::min(best, SliceHit{met.t, number});
    return true;
  }

  const SlicingCut& cut_;
  const HeightLookup& heights_;
  Interval all_;  // near and far
  MeetPlanes meet_planes_;
  std::optional<PlaneRunHeights> run_heights_;
};

}  // namespace

SlicedImage slice_rays(const SlicingCut& cut, const Camera& camera, const HeightLookup& heights) {
  SlicedImage result;
  result.image = HitImage(camera.width_px, camera.height_px);
  result.image.overdraw.assign(result.image.size(), 0);
  const RaySlicer slicer(cut, heights, camera.near_m, camera.far_m);
  std::vector<std::int64_t> tested(static_cast<std::size_t>(camera.height_px), 0);
  parallel_for(camera.height_px, 4, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < camera.width_px; ++x) {
      const SliceRay ray(camera, x, y);
      std::int64_t met = 0;
      const SliceHit hit = slicer.cast(ray, met);
      tested[static_cast<std::size_t>(row)] += met;
      const std::size_t pixel = result.image.index(x, y);
      result.image.overdraw[pixel] = static_cast<std::uint16_t>(std::min<std::int64_t>(met, 65535));
      if (!hit) continue;
      result.image.depth_m[pixel] = hit.t;
      result.image.from_eye_m[pixel] = hit.t * ray.direction;
      result.image.primitive[pixel] = hit.bundle;
    }
  });
  for (const std::int64_t of_row : tested) result.fragments += of_row;
  return result;
}

}  // namespace plumb::slicing
