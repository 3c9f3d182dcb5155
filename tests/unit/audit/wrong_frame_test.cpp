// Frames that are merely wrong are named nothing, however wrong they are.
#include "audit/depth_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "frame_views.h"

namespace plumb::audit {
namespace {

using test_support::decimated;
using test_support::noise;

void expect_nothing(const Ground& there, const image::DepthBuffer& buffer, const Camera& camera,
                    const std::string& what) {
  const auto found = misfit(there, buffer, {}, camera, {0.5, Unit::Pixel});
  EXPECT_FALSE(found) << what << ": " << found->text;
}

TEST(DepthFit, NamesNothingInAnExactFrame) {
  for_every_view([](const Ground& there, const Camera& camera) {
    for (const DepthConvention convention : kConventions) {
      for (const bool up : {false, true}) {
        const DepthMeaning meaning{convention, up};
        const image::DepthBuffer buffer =
            written(there.truth.caster.cast_frame(camera), camera, meaning);
        const auto found = misfit(there, buffer, meaning, camera, {0.0, Unit::Pixel});
        EXPECT_FALSE(found) << name_of(convention) << ": " << found->text;
      }
    }
  });
}

TEST(DepthFit, NamesNothingInACoarseLevelOfDetail) {
  for_every_view([](const Ground& there, const Camera& camera) {
    // Of less than eight cells a side nothing is left but chance; in a valley a coarse ground
    // covers the eye.
    const bool in_valley = camera.height_px == 121;
    for (int stride = 2; stride <= (in_valley ? 4 : 16); stride *= 2) {
      const auto coarse = decimated(there.field, stride);
      expect_nothing(there, written(coarse->truth.caster.cast_frame(camera), camera, {}), camera,
                     fmt::format("stride {}", stride));
    }
  });
}

TEST(DepthFit, NamesNothingInNoiseHolesAndCracks) {
  for_every_view([](const Ground& there, const Camera& camera) {
    const HitImage hits = there.truth.caster.cast_frame(camera);
    for (const double size : {1e-4, 1e-2, 0.1}) {
      HitImage noisy = hits;
      for (std::size_t k = 0; k < noisy.size(); ++k)
        noisy.depth_m[k] *= 1.0 + size * (noise(1, static_cast<int>(k), 0) - 0.5);
      expect_nothing(there, written(noisy, camera, {}), camera, fmt::format("noise of {}", size));
    }
    for (const int period : {2, 3, 7, 31}) {
      HitImage torn = hits;
      for (std::size_t k = 0; k < torn.size(); ++k) {
        const auto column = static_cast<int>(k % static_cast<std::size_t>(torn.width_px));
        if (column % period == 0) torn.depth_m[k] = kNoHit;
      }
      expect_nothing(there, written(torn, camera, {}), camera,
                     fmt::format("a crack every {}", period));
    }
    HitImage half = hits;
    std::fill_n(half.depth_m.begin(), half.size() / 3, kNoHit);
    expect_nothing(there, written(half, camera, {}), camera, "a third of it missing");
  });
}

TEST(DepthFit, NamesNothingWhereThereIsOnlySky) {
  const auto there = ground("generate:alpine?size=129&seed=7");
  Camera camera = there->camera("oblique", 80, 45);
  camera.forward = glm::dvec3(0.0, 0.0, 1.0);
  camera.up = glm::dvec3(0.0, 1.0, 0.0);
  camera.right = glm::dvec3(-1.0, 0.0, 0.0);
  const HitImage sky(80, 45);
  for (const DepthConvention convention : kConventions) {
    const DepthMeaning meaning{convention};
    EXPECT_FALSE(misfit(*there, written(sky, camera, meaning), meaning, camera));
  }
}

TEST(DepthFit, RefusesAFrameInWhichNothingIsDrawn) {
  const auto there = ground("generate:alpine?size=129&seed=7");
  const Camera camera = there->camera("oblique", 80, 45);
  const auto found = misfit(*there, written(HitImage(80, 45), camera, {}), {}, camera);
  ASSERT_TRUE(found);
  EXPECT_NE(found->text.find("shows something in 0 % of its pixels"), std::string::npos)
      << found->text;
}

// A pyramid is the same turned and mirrored, which says nothing of a frame that is merely coarse.
TEST(DepthFit, TakesACoarseFrameOfGroundThatIsTheSameTurned) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(129, 129);
  field.dx_m = field.dy_m = 10.0;
  for (int j = 0; j < 129; ++j) {
    for (int i = 0; i < 129; ++i)
      field.heights_m.floats()(i, j) =
          static_cast<float>(5 * std::min({i, j, 128 - i, 128 - j}) + 3 * ((i + j) % 2));
  }
  const Ground there(std::move(field));
  const auto coarse = decimated(there.field, 8);
  for (const View& view : kViews) {
    const Camera camera = there.camera(view.preset, view.width, view.height);
    expect_nothing(there, written(coarse->truth.caster.cast_frame(camera), camera, {}), camera,
                   view.preset);
  }
}

// A survey of mountains, and one of a town from the air, which has voids.
TEST(DepthFit, DoesTheSameOnRealTerrains) {
  bool any = false;
  for (const char* name : {"jacksboro_fault_403x344.tif", "ahn_dsm_0p5m_963x840.tif"}) {
    const std::string file = std::string(PLUMB_SOURCE_DIR "/../shared/data/") + name;
    if (!std::filesystem::exists(file)) continue;
    any = true;
    SCOPED_TRACE(name);
    const auto there = ground(file);
    const Camera camera = there->camera("oblique", 131, 75);
    for (const DepthConvention convention :
         {DepthConvention::Distance, DepthConvention::Window, DepthConvention::ReverseZ})
      expect_named(*there, camera, {camera, {convention}},
                   std::string("--depth-convention ") + name_of(convention));
    expect_named(*there, camera, {camera, {DepthConvention::Linear, true}}, "--depth-y up");
    Camera wide = camera;
    wide.gamma_h *= 131.0 / 75.0;
    wide.gamma_v *= 131.0 / 75.0;
    expect_named(*there, camera, {wide, {}}, "was taken for the horizontal one");
    const HitImage hits = there->truth.caster.cast_frame(camera);
    expect_nothing(*there, written(hits, camera, {}), camera, "exact");
    for (int stride = 2; stride <= 64; stride *= 2) {
      const HitImage coarse = decimated(there->field, stride)->truth.caster.cast_frame(camera);
      expect_nothing(*there, written(coarse, camera, {}), camera, fmt::format("stride {}", stride));
    }
  }
  if (!any) GTEST_SKIP() << "the real terrains of ../shared/data are not here";
}

}  // namespace
}  // namespace plumb::audit
