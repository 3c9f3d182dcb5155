// Blended slices beside a loop over every plane, and fog beside its integral.
#include "slicing/blended_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "slicing/ray_slicer.h"
#include "support/every_quad.h"
#include "support/random_slices.h"

namespace plumb::slicing {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;
using test_support::Random;

struct Seen {
  double t;
  std::uint32_t bundle;
  double opacity;
};

// Every quad of every bundle, one after the other, with the opacity that the header states.
std::vector<Seen> by_trying_all(const SlicingCut& cut, const HeightLookup& heights,
                                const SliceRay& ray, const Camera& camera, double falloff_px,
                                double last_t) {
  std::vector<Seen> seen;
  test_support::for_each_quad_met(
      cut, ray, camera.near_m,
      [&](std::uint32_t number, QuadKind kind, Axis axis, const PlanePoint& met) {
        if (met.t >= last_t) return;
        const FragmentHeight height =
            fragment_height(cut.bundles[number], kind, axis, heights, ray, met);
        const double opacity =
            1.0 - (height.tested_m - height.terrain_m) / (falloff_px / camera.gamma_v * met.t);
        if (opacity > 0.0 && opacity < 1.0) seen.push_back({met.t, number, opacity});
      });
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return a.t < b.t || (a.t == b.t && a.bundle < b.bundle);
  });
  std::vector<Seen> single;  // of one bundle at one place the most opaque
  for (const Seen& s : seen) {
    if (single.empty() || single.back().t != s.t || single.back().bundle != s.bundle)
      single.push_back(s);
    else
      single.back().opacity = std::max(single.back().opacity, s.opacity);
  }
  return single;
}

// Its bundles as much higher as falloff_px is at their farthest corner.
SlicingCut higher(SlicingCut cut, const Camera& camera, double falloff_px) {
  for (SliceBundle& bundle : cut.bundles) {
    double farthest = 0.0;
    for (int k = 0; k < 8; ++k) {
      const glm::dvec3 corner{k & 1 ? bundle.reach.high.x : bundle.reach.low.x,
                              k & 2 ? bundle.reach.high.y : bundle.reach.low.y,
                              k & 4 ? bundle.reach.high.z : bundle.reach.low.z};
      farthest = std::max(farthest, glm::dot(corner - camera.eye_m, camera.forward));
    }
    const double more_m = falloff_px / camera.gamma_v * farthest;
    bundle.reach.high.z += more_m;
    bundle.greatest_z_m = std::numeric_limits<double>::infinity();
    if (bundle.axis == Axis::Z)
      bundle.count += static_cast<int>(std::ceil(more_m / bundle.spacing_m));
  }
  return cut;
}

bool same(const Layers& a, const Layers& b) {
  const auto equal = [](const Layer& x, const Layer& y) {
    return x.from_eye_m == y.from_eye_m && x.weight == y.weight;
  };
  return a.first == b.first && a.behind == b.behind &&
         std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(), equal);
}

// Weights are rounded to float once, so that a pixel's sum is off by half an ulp a layer at most.
TEST(BlendedRays, HaveTheLayersThatALoopOverEveryPlaneFinds) {
  Random random(61);
  std::size_t layers = 0;
  for (std::uint32_t round = 0; round < 60; ++round) {
    const Heightfield field = test_support::random_ground(random, round);
    const SlicingTree tree(field, Diagonal::Alternating, 8);
    const Camera camera =
        relative_to(test_support::random_view(random, field), field.world_origin_m());
    const SlicingCut cut = cut_tree(tree, camera, test_support::random_cut_options(random));
    const HeightLookup heights(field, Diagonal::Alternating);
    const SlicedImage sliced = slice_rays(cut, camera, heights);
    BlendOptions options;
    options.falloff_px = random.uniform(0.5, 8.0);
    if (random.chance(0.5)) options.fog_per_m = random.uniform(1e-5, 1e-2);
    const Layers found = blend_slices(cut, camera, heights, sliced.image, options);
    const SlicingCut raised = higher(cut, camera, options.falloff_px);
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const std::size_t pixel = sliced.image.index(x, y);
        const SliceRay ray(camera, x, y);
        const double depth_m = sliced.image.depth_m[pixel];
        std::vector<Seen> expected;  // each more opaque than all before it
        for (const Seen& seen : by_trying_all(raised, heights, ray, camera, options.falloff_px,
                                              std::min(depth_m, camera.far_m))) {
          if (expected.empty() || seen.opacity > expected.back().opacity) expected.push_back(seen);
        }
        const std::size_t first = found.first[pixel];
        ASSERT_EQ(found.first[pixel + 1] - first, expected.size())
            << round << ": " << x << "," << y;
        double covered = 0.0, sum = static_cast<double>(found.behind[pixel]);
        for (std::size_t k = 0; k < expected.size(); ++k) {
          const double fog = fog_transmittance(options, ray.eye_m, ray.direction, expected[k].t);
          EXPECT_EQ(found.layers[first + k].weight,
                    static_cast<float>((expected[k].opacity - covered) * fog));
          EXPECT_EQ(found.layers[first + k].from_eye_m, expected[k].t * ray.direction);
          covered = expected[k].opacity;
          sum += static_cast<double>(found.layers[first + k].weight);
        }
        const double roundings = 1e-7 * static_cast<double>(expected.size() + 1);
        EXPECT_LE(sum, 1.0 + roundings);
        if (options.fog_per_m == 0.0) {
          EXPECT_NEAR(sum, 1.0, roundings);
        }
        layers += expected.size();
      }
    }
    for (const int threads : {1, 7}) {
      const ThreadLimit limit(threads);
      EXPECT_TRUE(same(blend_slices(cut, camera, heights, sliced.image, options), found));
    }
  }
  EXPECT_GT(layers, 10'000u);
}

TEST(BlendedRays, HaveNoLayersWithoutFalloff) {
  Random random(62);
  const Heightfield field = test_support::random_ground(random, 1);
  const SlicingTree tree(field, Diagonal::Alternating, 8);
  const Camera camera =
      relative_to(test_support::random_view(random, field), field.world_origin_m());
  const SlicingCut cut = cut_tree(tree, camera, {});
  const HeightLookup heights(field, Diagonal::Alternating);
  const SlicedImage sliced = slice_rays(cut, camera, heights);
  BlendOptions options;
  options.fog_per_m = 1e-3;
  const Layers found = blend_slices(cut, camera, heights, sliced.image, options);
  EXPECT_TRUE(found.layers.empty());
  for (std::size_t pixel = 0; pixel < sliced.image.size(); ++pixel) {
    const int x = static_cast<int>(pixel) % camera.width_px;
    const SliceRay ray(camera, x, static_cast<int>(pixel) / camera.width_px);
    EXPECT_EQ(found.behind[pixel],
              static_cast<float>(fog_transmittance(options, ray.eye_m, ray.direction,
                                                   sliced.image.depth_m[pixel])));
  }
}

// Simpson's rule in 2000 steps: its error is (fall * t / 2000)^4 / 180 of the integral, and
// |fall * t| is at most 30 here.
double optical_depth(const BlendOptions& options, const glm::dvec3& eye_m,
                     const glm::dvec3& direction, double t) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int k = 0; k <= kSteps; ++k) {
    const double z = eye_m.z + direction.z * t * k / kSteps;
    const double density =
        options.fog_per_m * std::exp((options.fog_base_m - z) / options.fog_height_m);
    sum += density * (k == 0 || k == kSteps ? 1.0 : k % 2 == 1 ? 4.0 : 2.0);
  }
  return sum * t / (3.0 * kSteps) * std::sqrt(glm::dot(direction, direction));
}

TEST(Fog, LetsThroughWhatItsIntegralSays) {
  Random random(63);
  for (int round = 0; round < 2000; ++round) {
    BlendOptions options;
    options.fog_per_m = random.uniform(0.0, 0.01);
    options.fog_height_m = random.uniform(20.0, 500.0);
    options.fog_base_m = random.uniform(-50.0, 50.0);
    const glm::dvec3 eye{0.0, 0.0, random.uniform(-50.0, 300.0)};
    const double slope = random.chance(0.1) ? 0.0 : random.uniform(-1.0, 1.0);
    const glm::dvec3 direction{random.uniform(-1.0, 1.0), 1.0, slope};
    const double t = random.uniform(0.0, 600.0);
    const double depth = optical_depth(options, eye, direction, t);
    EXPECT_NEAR(fog_transmittance(options, eye, direction, t), std::exp(-depth),
                1e-9 + 1e-9 * depth);
  }
}

// From so high that there is no fog at the eye, down to where there is.
TEST(Fog, IsFoundFarBelowTheEye) {
  BlendOptions options;
  options.fog_per_m = 0.01;
  options.fog_height_m = 2.0;
  const glm::dvec3 eye{0.0, 0.0, 5000.0};
  // Straight down to the base: the integral of 0.01 e^(-z / 2) over z > 0 is 0.02.
  EXPECT_NEAR(fog_transmittance(options, eye, {0.0, 0.0, -1.0}, 5000.0), std::exp(-0.02), 1e-12);
  EXPECT_NEAR(fog_transmittance(options, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 5000.0), std::exp(-0.02),
              1e-12);
  EXPECT_EQ(fog_transmittance(options, eye, {0.0, 0.0, -1.0}, 1000.0), 1.0);
}

TEST(Fog, EndsAboveAndNeverBelow) {
  BlendOptions options;
  options.fog_per_m = 1e-3;
  const glm::dvec3 eye{0.0, 0.0, 30.0};
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(fog_transmittance(options, eye, {0.0, 1.0, 0.5}, infinity),
              fog_transmittance(options, eye, {0.0, 1.0, 0.5}, 1e5), 1e-12);
  EXPECT_EQ(fog_transmittance(options, eye, {0.0, 1.0, 0.0}, infinity), 0.0);
  EXPECT_EQ(fog_transmittance(options, eye, {0.0, 1.0, -0.1}, infinity), 0.0);
  EXPECT_EQ(fog_transmittance({}, eye, {0.0, 1.0, -0.1}, infinity), 1.0);
}

}  // namespace
}  // namespace plumb::slicing
