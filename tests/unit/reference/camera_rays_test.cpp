#include "reference/camera_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reference/beam_end.h"
#include "terrain/camera_presets.h"
#include "terrain/terrain_source.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;

Camera view_of(const terrain::Heightfield& field, const std::string& preset) {
  return make_camera(terrain::preset_camera(field, preset, 40, 24, 40.0));
}

// Points of the picture and a little around it, 256 and then 44 at a time.
TEST(CameraRays, HaveTheBitsOfOneRayAfterAnother) {
  for (const char* source : {"generate:alpine?size=65", "generate:urban?size=65"}) {
    const terrain::Heightfield field = terrain::load_terrain(source);
    for (const char* preset : {"grazing", "oblique", "top"}) {
      const Camera camera = view_of(field, preset);
      const PyramidCaster caster(field, Diagonal::Alternating);
      const CameraRays rays(caster, camera);
      CameraRays::Batch batch(rays);
      std::mt19937 random(7);
      std::uniform_real_distribution<double> x(-8.0, 48.0), y(-8.0, 32.0);
      for (const int count : {CameraRays::Batch::kMost, 44}) {
        std::vector<RayHit> expected;
        for (int k = 0; k < count; ++k) {
          const double x_px = x(random), y_px = y(random);
          batch.add(x_px, y_px);
          expected.push_back(caster.cast(caster.camera_ray(camera, x_px, y_px)));
        }
        batch.cast();
        for (int k = 0; k < count; ++k) {
          EXPECT_EQ(batch.hit(k), expected[static_cast<std::size_t>(k)]) << source << preset << k;
        }
        batch.clear();
      }
    }
  }
}

// Pixels of which an end is known: no ray within goes farther. It must be known of most that look
// at nothing but ground.
TEST(BeamEnd, IsBehindTheHitOfEveryRay) {
  for (const char* source :
       {"generate:alpine?size=65", "generate:urban?size=65", "generate:dunes?size=65"}) {
    const terrain::Heightfield field = terrain::load_terrain(source);
    for (const Diagonal diagonal : {Diagonal::Alternating, Diagonal::Fixed}) {
      for (const char* preset : {"grazing", "valley", "oblique", "top"}) {
        const Camera camera = view_of(field, preset);
        const PyramidCaster caster(field, diagonal);
        int known = 0, ground = 0;
        for (int y = 0; y < camera.height_px; ++y) {
          for (int x = 0; x < camera.width_px; ++x) {
            const double end =
                beam_end(field, diagonal, caster.pyramid(),
                         camera_beam(camera, field.world_origin_m(), x, y, x + 1.0, y + 1.0));
            double latest = 0.0;
            for (int k = 0; k < 36; ++k) {
              const RayHit hit =
                  caster.cast(caster.camera_ray(camera, x + 0.2 * (k % 6), y + 0.2 * (k / 6)));
              latest = std::max(latest, hit.t);
            }
            EXPECT_LE(latest, end) << source << preset << " (" << x << ", " << y << ")";
            known += std::isfinite(end);
            ground += std::isfinite(latest);
          }
        }
        EXPECT_GE(2 * known, ground) << source << preset;
      }
    }
  }
}

// A plane 10 m below the eye, looked straight down at: the rays meet it at a depth of 10 m.
TEST(BeamEnd, IsJustBehindAPlane) {
  const terrain::Heightfield field = terrain::load_terrain("generate:plane?size=9&spacing=1");
  const PyramidCaster caster(field, Diagonal::Alternating);
  const double ground = field.heights_m(4, 4);
  const Beam beam{{4.0, 4.0, ground + 10.0}, {-0.1, -0.1, -1.0}, {0.1, 0.1, -1.0}, 0.1, 100.0};
  const double end = beam_end(field, Diagonal::Alternating, caster.pyramid(), beam);
  EXPECT_GT(end, 10.0);
  EXPECT_LE(end, 10.5 * (1.0 + 1e-8));
  const Beam up{beam.origin_m, {-0.1, -0.1, 1.0}, {0.1, 0.1, 1.0}, 0.1, 100.0};
  EXPECT_TRUE(std::isinf(beam_end(field, Diagonal::Alternating, caster.pyramid(), up)));
}

}  // namespace
}  // namespace plumb::reference
