#include "slicing/ray_slicer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/parallel.h"
#include "slicing/plane_run.h"

namespace plumb::slicing {
namespace {

constexpr int kFewPlanes = 3;  // of which setting up lanes would cost more than it saves

struct Interval {
  double begin, end;
  bool empty() const { return !(begin <= end); }
};

// Where the ray is inside the box, widened by more than the roundings of a difference and a
// product.
Interval inside(const SliceRay& ray, const Box& box, Interval all) {
  constexpr double kWider = 1e-12;
  for (int k = 0; k < 3; ++k) {
    if (ray.direction[k] == 0.0) {
      if (!(ray.eye_m[k] >= box.low[k] && ray.eye_m[k] <= box.high[k])) return {1.0, 0.0};
      continue;
    }
    const double a = (box.low[k] - ray.eye_m[k]) * ray.inverse[k],
                 b = (box.high[k] - ray.eye_m[k]) * ray.inverse[k];
    const double first = std::min(a, b), last = std::max(a, b);
    all.begin = std::max(all.begin, first - kWider * std::abs(first));
    all.end = std::min(all.end, last + kWider * std::abs(last));
  }
  return all;
}

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
    if (cut_.branches.empty()) return best;
    // A ray that runs west meets the eastern children first, one that runs south the northern ones.
    const std::size_t east = ray.direction.x < 0.0 ? 1 : 0, north = ray.direction.y < 0.0 ? 2 : 0;
    std::array<std::uint32_t, 3 * 16 + 1> stack;
    std::size_t count = 0;
    stack[count++] = static_cast<std::uint32_t>(cut_.branches.size()) - 1;
    while (count > 0) {
      const SliceBranch& branch = cut_.branches[stack[--count]];
      const Interval part = inside(ray, branch.reach, all_);
      if (part.empty() || part.begin > best.t) continue;
      if (branch.bundle != kNoPrimitive) {
        meet_bundle(branch.bundle, ray, part, best, tested);
        continue;
      }
      for (std::size_t k = 4; k-- > 0;) {
        const std::uint32_t below = branch.below[k ^ east ^ north];
        if (below != kNoPrimitive) stack[count++] = below;
      }
    }
    return best;
  }

 private:
  void meet_bundle(std::uint32_t number, const SliceRay& ray, const Interval& part, SliceHit& best,
                   std::int64_t& tested) const {
    const SliceBundle& bundle = cut_.bundles[number];
    if (bundle.closed) meet_closing_quads(number, ray, best, tested);
    const int n = index_of(bundle.axis);
    const double step = ray.direction[n];
    if (step == 0.0) return;  // along the planes
    // The planes between the ends of the part, and one more at each end for the roundings.
    const double from = ray.eye_m[n] + part.begin * step, to = ray.eye_m[n] + part.end * step;
    const auto plane_near = [&](double at) {
      const double j = bundle.spacing_m > 0.0 ? (at - bundle.first_m) / bundle.spacing_m : 0.0;
      return static_cast<int>(std::clamp(std::floor(j), -1.0, static_cast<double>(bundle.count)));
    };
    const int low = std::max(0, plane_near(std::min(from, to)) - 1),
              high = std::min(bundle.count - 1, plane_near(std::max(from, to)) + 1);
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
    const Box& box = cut_.bundles[number].reach;
    meet_quad(number, QuadKind::Closing, Axis::X, box.low.x, ray, best, tested);
    meet_quad(number, QuadKind::Closing, Axis::X, box.high.x, ray, best, tested);
    meet_quad(number, QuadKind::Closing, Axis::Y, box.low.y, ray, best, tested);
    meet_quad(number, QuadKind::Closing, Axis::Y, box.high.y, ray, best, tested);
    meet_quad(number, QuadKind::Closing, Axis::Z, box.low.z, ray, best, tested);
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
