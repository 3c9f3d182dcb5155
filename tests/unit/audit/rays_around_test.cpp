#include "audit/rays_around.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/coverage_parts.h"
#include "terrain/camera_presets.h"
#include "terrain/terrain_source.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Around every third pixel, and at depths before, at and behind what its centre sees: 12 x 12,
// 36 x 36 and 64 x 64 rays. A void in the last terrain.
TEST(RaysAround, AnswerAsOneRayAfterAnother) {
  for (const bool with_void : {false, true}) {
    terrain::Heightfield field = terrain::load_terrain("generate:alpine?size=65");
    if (with_void) {
      for (int k = 20; k < 30; ++k)
        field.heights_m.floats()(k, 30) = std::numeric_limits<float>::quiet_NaN();
    }
    const HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
    for (const char* preset : {"grazing", "oblique"}) {
      const Camera camera = make_camera(terrain::preset_camera(field, preset, 24, 15, 40.0));
      const RaysAround rays(truth, camera);
      int passing = 0, asked = 0, hitting = 0;
      for (int y = 0; y < camera.height_px; y += 3) {
        for (int x = 0; x < camera.width_px; x += 3) {
          const double centre =
              truth.caster.cast(truth.caster.camera_ray(camera, x + 0.5, y + 0.5)).t;
          for (const double reach : {1.0, 4.0, 9.0}) {
            const auto hits = [](const reference::RayHit& ray) { return static_cast<bool>(ray); };
            const bool any = any_ray_around(truth.caster, camera, x, y, reach, hits);
            EXPECT_EQ(rays.any_hits(x, y, reach), any) << x << " " << y << " " << reach;
            hitting += any;
            for (const double factor : {0.5, 1.0, 1.5, 4.0, kInfinity}) {
              const double depth = factor * centre;
              const bool passes =
                  any_ray_around(truth.caster, camera, x, y, reach,
                                 [&](const auto& ray) { return !ray || ray.t >= depth; });
              EXPECT_EQ(rays.any_passes(x, y, reach, depth), passes)
                  << x << " " << y << " " << reach << " " << depth;
              passing += passes;
              ++asked;
            }
          }
        }
      }
      EXPECT_GT(hitting, 0);
      EXPECT_GT(passing, 0);
      EXPECT_LT(passing, asked);
    }
  }
}

// Only one ray of all reaches as deep as the deepest, so that each has to be cast.
TEST(RaysAround, FindTheOneThatPasses) {
  const terrain::Heightfield field = terrain::load_terrain("generate:alpine?size=65");
  const HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  LookAt look;
  look.eye_m = {960.0, 700.0, 6000.0};
  look.target_m = {960.0, 960.0, 1500.0};
  look.fov_y_deg = 12.0;
  look.width_px = 24;
  look.height_px = 15;
  const Camera camera = make_camera(look);
  const RaysAround rays(truth, camera);
  int asked = 0;
  for (int y = 0; y < camera.height_px; y += 2) {
    for (int x = 0; x < camera.width_px; x += 2) {
      for (const double reach : {1.0, 4.0, 9.0}) {
        double deepest = 0.0;
        any_ray_around(truth.caster, camera, x, y, reach, [&](const reference::RayHit& ray) {
          deepest = std::max(deepest, ray ? ray.t : kInfinity);
          return false;
        });
        if (deepest == kInfinity) continue;
        EXPECT_TRUE(rays.any_passes(x, y, reach, deepest)) << x << " " << y << " " << reach;
        EXPECT_FALSE(rays.any_passes(x, y, reach, std::nextafter(deepest, kInfinity)))
            << x << " " << y << " " << reach;
        ++asked;
      }
    }
  }
  EXPECT_GT(asked, 50);
}

}  // namespace
}  // namespace plumb::audit
