#include "slicing/blended_rays.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/check.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"
#include "slicing/branch_walk.h"

namespace plumb::slicing {
namespace {

// (1 - e^-x) / x, 1 at 0.
double mean_of_decay(double x) {
  if (std::abs(x) < 1e-5) return 1.0 - 0.5 * x;  // off by x^2 / 6
  return (1.0 - reproducible_exp(-x)) / x;
}

// Fog on one ray. Densities are taken at the lower end of what is looked through, where they are
// greatest: a factor that vanishes times one without bound would be no number.
class FogAlongRay {
 public:
  FogAlongRay(const BlendOptions& options, const glm::dvec3& eye_m, const glm::dvec3& direction)
      : is_there_(options.fog_per_m != 0.0) {
    if (!is_there_) return;
    most_ = options.fog_per_m * std::sqrt(glm::dot(direction, direction));
    eye_heights_ = (eye_m.z - options.fog_base_m) / options.fog_height_m;
    climb_ = direction.z / options.fog_height_m;
  }

  double transmittance(double t) const {
    if (!is_there_) return 1.0;
    if (std::isinf(t)) return climb_ > 0.0 ? reproducible_exp(-density_at(0.0) / climb_) : 0.0;
    const double lower_t = climb_ < 0.0 ? t : 0.0;
    return reproducible_exp(-density_at(lower_t) * t * mean_of_decay(std::abs(climb_) * t));
  }

 private:
  // Light lost on a unit of t.
  double density_at(double t) const {
    return most_ * reproducible_exp(-(eye_heights_ + climb_ * t));
  }

  bool is_there_;
  double most_ = 0.0;         // at the base
  double eye_heights_ = 0.0;  // above the base, in heights over which fog thins to 1/e
  double climb_ = 0.0;        // of the ray, in the same, a unit of t
};

struct SoftFragment {
  double t;
  std::uint32_t bundle;
  double opacity;  // in (0, 1)

  bool in_place_of(const SoftFragment& other) const {
    return t == other.t && bundle == other.bundle;
  }
  bool operator<(const SoftFragment& other) const {
    if (t != other.t) return t < other.t;
    return bundle != other.bundle ? bundle < other.bundle : opacity > other.opacity;
  }
};

// The same cut with every bundle as much higher as its fragments may be seen above the ground: a
// slice ends where its opacity does, and not at the top of its box.
SlicingCut raised(SlicingCut cut, const Camera& camera, double falloff_per_t) {
  for (SliceBundle& bundle : cut.bundles) {
    double farthest_t = 0.0;
    for (int k = 0; k < 8; ++k)
      farthest_t = std::max(farthest_t, to_view(camera, bundle.reach.corner(k)).z);
    const double more_m = falloff_per_t * farthest_t;
    bundle.reach.high.z += more_m;
    bundle.greatest_z_m = std::numeric_limits<double>::infinity();
    if (bundle.axis == Axis::Z && bundle.spacing_m > 0.0) {
      constexpr double kMostMore = 1e6;  // planes
      bundle.count += static_cast<int>(std::min(kMostMore, std::ceil(more_m / bundle.spacing_m)));
    }
  }
  for (SliceBranch& branch : cut.branches) {  // those below come first
    if (branch.bundle != kNoPrimitive) {
      branch.reach = cut.bundles[branch.bundle].reach;
      continue;
    }
    for (const std::uint32_t below : branch.below) {
      if (below != kNoPrimitive) branch.reach.add(cut.branches[below].reach);
    }
  }
  return cut;
}

// The fragments of one ray that let light through.
class SoftSlices {
 public:
  SoftSlices(const SlicingCut& cut, const HeightLookup& heights, const Camera& camera,
             double falloff_px)
      : falloff_per_t_(falloff_px / camera.gamma_v),
        cut_(raised(cut, camera, falloff_per_t_)),
        heights_(heights),
        near_t_(camera.near_m) {}

  /// Those before `last_t`, front to back.
  void find(const SliceRay& ray, double last_t, std::vector<SoftFragment>& found) const {
    found.clear();
    walk_bundles(
        cut_, ray, {near_t_, last_t}, last_t, [&](std::uint32_t number, const Interval& part) {
          const SliceBundle& bundle = cut_.bundles[number];
          const auto meet = [&](QuadKind kind, Axis axis, double at_m) {
            meet_quad(number, kind, axis, at_m, ray, last_t, found);
          };
          if (bundle.closed)
            for_each_closing_quad(
                bundle, [&](Axis axis, double at_m) { meet(QuadKind::Closing, axis, at_m); });
          const auto [low, high] = planes_within(bundle, ray, part);
          for (int j = low; j <= high; ++j) meet(QuadKind::Slice, bundle.axis, bundle.plane_m(j));
        });
    std::sort(found.begin(), found.end());
    // Where a slice lies in a closing quad, the two are one.
    const auto end =
        std::unique(found.begin(), found.end(),
                    [](const SoftFragment& a, const SoftFragment& b) { return b.in_place_of(a); });
    found.erase(end, found.end());
  }

 private:
  void meet_quad(std::uint32_t number, QuadKind kind, Axis axis, double at_m, const SliceRay& ray,
                 double last_t, std::vector<SoftFragment>& found) const {
    const SliceBundle& bundle = cut_.bundles[number];
    if (ray.direction[index_of(axis)] == 0.0) return;
    const PlanePoint met = meet_plane(ray, axis, at_m);
    if (!(met.t >= near_t_ && met.t < last_t) || !is_on_quad(bundle, kind, axis, met.point_m))
      return;
    const FragmentHeight height = fragment_height(bundle, kind, axis, heights_, ray, met);
    const double above_m = height.tested_m - height.terrain_m;  // NaN over voids
    const double opacity = 1.0 - above_m / (falloff_per_t_ * met.t);
    if (opacity > 0.0 && opacity < 1.0) found.push_back({met.t, number, opacity});
  }

  double falloff_per_t_;
  SlicingCut cut_;
  const HeightLookup& heights_;
  double near_t_;
};

struct RowLayers {
  std::vector<Layer> layers;
  std::vector<std::uint64_t> counts;  // a pixel each
};

void require_usable(const BlendOptions& options) {
  require(options.falloff_px >= 0.0 && std::isfinite(options.falloff_px),
          "falloff_px must be >= 0, got {}", options.falloff_px);
  require(options.fog_per_m >= 0.0 && std::isfinite(options.fog_per_m),
          "fog_per_m must be >= 0, got {}", options.fog_per_m);
  require(options.fog_height_m > 0.0 && std::isfinite(options.fog_height_m),
          "fog_height_m must be > 0, got {}", options.fog_height_m);
}

}  // namespace

double fog_transmittance(const BlendOptions& options, const glm::dvec3& eye_m,
                         const glm::dvec3& direction, double t) {
  return FogAlongRay(options, eye_m, direction).transmittance(t);
}

Layers blend_slices(const SlicingCut& cut, const Camera& camera, const HeightLookup& heights,
                    const HitImage& hits, const BlendOptions& options) {
  require_usable(options);
  const SoftSlices soft(options.falloff_px > 0.0 ? cut : SlicingCut{}, heights, camera,
                        options.falloff_px);
  Layers result;
  result.fog = options.fog;
  result.behind.resize(hits.size());
  std::vector<RowLayers> rows(static_cast<std::size_t>(hits.height_px));
  parallel_for(hits.height_px, 4, [&](std::int64_t row) {
    RowLayers& of_row = rows[static_cast<std::size_t>(row)];
    std::vector<SoftFragment> fragments;
    for (int x = 0; x < hits.width_px; ++x) {
      const std::size_t pixel = hits.index(x, static_cast<int>(row));
      const SliceRay ray(camera, x, static_cast<int>(row));
      const double last_t = std::min(hits.depth_m[pixel], camera.far_m);
      if (options.falloff_px > 0.0) soft.find(ray, last_t, fragments);
      const FogAlongRay fog(options, ray.eye_m, ray.direction);
      double covered = 0.0;
      std::uint64_t layers = 0;
      for (const SoftFragment& f : fragments) {
        if (f.opacity <= covered) continue;
        const double share = (f.opacity - covered) * fog.transmittance(f.t);
        of_row.layers.push_back({f.t * ray.direction, static_cast<float>(share)});
        covered = f.opacity;
        ++layers;
      }
      of_row.counts.push_back(layers);
      result.behind[pixel] =
          static_cast<float>((1.0 - covered) * fog.transmittance(hits.depth_m[pixel]));
    }
  });
  result.first.push_back(0);
  for (const RowLayers& row : rows) {
    for (const std::uint64_t count : row.counts)
      result.first.push_back(result.first.back() + count);
    result.layers.insert(result.layers.end(), row.layers.begin(), row.layers.end());
  }
  return result;
}

}  // namespace plumb::slicing
