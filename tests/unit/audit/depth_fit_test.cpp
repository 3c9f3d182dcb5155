// Frames that fit nowhere are named.
#include "audit/depth_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "frame_views.h"

namespace plumb::audit {
namespace {

TEST(DepthFit, NamesEachConventionTakenForEachOther) {
  for_every_view([](const Ground& there, const Camera& camera) {
    for (const DepthConvention one : kConventions) {
      for (const DepthConvention other : kConventions) {
        if (one == other) continue;
        expect_named(there, camera, {camera, {one}},
                     std::string("--depth-convention ") + name_of(one), {other});
      }
    }
  });
}

TEST(DepthFit, NamesRowsAndColumnsTheOtherWayRound) {
  for_every_view([](const Ground& there, const Camera& camera) {
    expect_named(there, camera, {camera, {DepthConvention::Linear, true}}, "--depth-y up");
    expect_named(there, camera, {camera, {}}, "--depth-y down", {DepthConvention::Linear, true});
    expect_named(there, camera, {camera, {DepthConvention::Linear, false, true}},
                 "columns run from right to left");
    expect_named(there, camera, {camera, {DepthConvention::Linear, true, true}}, "half a turn");
  });
}

TEST(DepthFit, NamesTwoMistakesAtOnce) {
  for_every_view([](const Ground& there, const Camera& camera) {
    expect_named(there, camera, {camera, {DepthConvention::Window, true}},
                 "bottom up (--depth-y up), and its numbers are window depths");
  });
}

TEST(DepthFit, NamesTheUnit) {
  for_every_view([](const Ground& there, const Camera& camera) {
    for (const auto& [unit, words] : {std::pair{0.3048, "feet (--depth-scale 0.3048)"},
                                      {1000.0, "kilometres"},
                                      {0.01, "centimetres"},
                                      {5000.0, "5000 m"}})
      expect_named(there, camera, {camera, {DepthConvention::Linear, false, false, unit}}, words);
  });
}

TEST(DepthFit, NamesWhatStandsForSky) {
  const auto there = ground("generate:alpine?size=129&seed=7");
  const Camera camera = there->camera("oblique", 160, 90);
  const HitImage hits = there->truth.caster.cast_frame(camera);
  for (const float sky : {0.0f, -1.0f, 100000.0f, 65504.0f}) {
    image::DepthBuffer buffer = written(hits, camera, {});
    for (float& value : buffer.values) value = std::isinf(value) ? sky : value;
    const auto found = misfit(*there, buffer, {}, camera);
    ASSERT_TRUE(found) << sky;
    EXPECT_NE(found->text.find(fmt::format("(--depth-sky {:g})", sky)), std::string::npos)
        << found->text;
    DepthMeaning told;
    told.sky = sky;
    EXPECT_FALSE(misfit(*there, buffer, told, camera)) << sky;
  }
}

TEST(DepthFit, NamesDepthsThatAreNegative) {
  for_every_view([](const Ground& there, const Camera& camera) {
    DepthMeaning negative;
    negative.metres_per_unit = -1.0;
    expect_named(there, camera, {camera, negative}, "negative depths (--depth-convention linear");
    const image::DepthBuffer buffer =
        written(there.truth.caster.cast_frame(camera), camera, negative);
    EXPECT_FALSE(misfit(there, buffer, negative, camera));
  });
}

// A camera that is a little beside the stated one is found to the digits that floats leave.
TEST(DepthFit, FindsTheCameraThatAFrameWasSeenThrough) {
  const auto there = ground("generate:alpine?size=257&seed=7");
  const Camera camera = there->camera("oblique", 160, 90);
  Camera east = camera;
  east.eye_m += glm::dvec3(150.0, 0.0, -40.0);
  expect_named(*there, camera, {east, {}}, "its eye stands (150, 0, -40) m from the stated place");
  Camera wide = camera;
  wide.gamma_h *= 0.9;
  wide.gamma_v *= 0.9;
  expect_named(*there, camera, {wide, {}}, "angle of view is 1.111 times the stated one's");
  Camera rolled = camera;
  const double c = std::sqrt(0.99), s = 0.1;  // 5.74 degrees
  rolled.right = c * camera.right + s * camera.up;
  rolled.up = c * camera.up - s * camera.right;
  expect_named(*there, camera, {rolled, {}}, "it is turned by 5.7");
}

TEST(DepthFit, NamesTheOtherAxissFieldOfView) {
  for_every_view([](const Ground& there, const Camera& camera) {
    const double aspect = static_cast<double>(camera.width_px) / camera.height_px;
    Camera wide = camera, narrow = camera;
    wide.gamma_h *= 1.0 / aspect;
    wide.gamma_v *= 1.0 / aspect;
    narrow.gamma_h *= aspect;
    narrow.gamma_v *= aspect;
    expect_named(there, camera, {narrow, {}}, "was taken for the horizontal one");
    expect_named(there, camera, {wide, {}}, "of a horizontal one that was given");
  });
}

TEST(DepthFit, NamesShiftsOfHalfAndWholePixels) {
  for_every_view([](const Ground& there, const Camera& camera) {
    for (const glm::dvec2 by : {glm::dvec2(0.5, 0.5), {0.0, -0.5}, {1.0, 0.0}}) {
      Camera shifted = camera;
      shifted.centre_px += by;
      expect_named(there, camera, {shifted, {}},
                   fmt::format("shifted by ({:g}, {:g}) px", by.x, by.y), {}, {0.0, Unit::Pixel});
      // Within the tolerance it is worth a word, no more.
      const image::DepthBuffer buffer =
          written(there.truth.caster.cast_frame(shifted), shifted, {});
      const auto hint = misfit(there, buffer, {}, camera, {20.0, Unit::Pixel});
      ASSERT_TRUE(hint);
      EXPECT_FALSE(hint->refuses) << hint->text;
    }
  });
}

TEST(DepthFit, NamesATerrainThatIsTurned) {
  for_every_view([](const Ground& there, const Camera& camera) {
    if (camera.forward.z < -0.99) return;  // from above that is the picture turned
    if (camera.height_px == 121) return;   // in a valley the eye would be under the turned ground
    const terrain::Heightfield& field = there.field;
    const int last_i = field.columns() - 1, last_j = field.rows() - 1;
    const auto drawn = [&](const std::function<float(int, int)>& height) {
      terrain::Heightfield other = field;
      other.heights_m = Grid<float>(field.columns(), field.rows());
      for (int j = 0; j < field.rows(); ++j) {
        for (int i = 0; i < field.columns(); ++i) other.heights_m.floats()(i, j) = height(i, j);
      }
      const Ground turned(std::move(other));
      return written(turned.truth.caster.cast_frame(camera), camera, {});
    };
    const auto expect = [&](const std::function<float(int, int)>& height, const char* words) {
      const auto found = misfit(there, drawn(height), {}, camera);
      ASSERT_TRUE(found) << words;
      EXPECT_TRUE(found->refuses);
      EXPECT_NE(found->text.find(words), std::string::npos) << found->text;
    };
    expect([&](int i, int j) { return field.heights_m(i, last_j - j); },
           "north and south exchanged");
    expect([&](int i, int j) { return field.heights_m(last_i - i, j); }, "east and west exchanged");
    expect([&](int i, int j) { return field.heights_m(last_i - i, last_j - j); }, "half a turn");
    expect([&](int i, int j) { return field.heights_m(j, i); }, "rows and columns exchanged");
    // What stood in the north stands in the east.
    expect([&](int i, int j) { return field.heights_m(last_j - j, i); },
           "a quarter of a turn clockwise");
    expect([&](int i, int j) { return field.heights_m(j, last_i - i); },
           "a quarter of a turn counter-clockwise");
    expect([&](int i, int j) { return 0.8f * field.heights_m(i, j); }, "terrain's times 0.8");
  });
}

TEST(DepthFit, NamesAnEyeThatStandsElsewhere) {
  for_every_view([](const Ground& there, const Camera& camera) {
    Camera high = camera;
    high.eye_m.z += 5.0;
    expect_named(there, camera, {high, {}}, "5 m too small, or its camera's eye", {},
                 {0.0, Unit::Pixel});
    Camera half = camera;
    half.eye_m += glm::dvec3(0.5 * there.field.dx_m, 0.5 * there.field.dy_m, 0.0);
    expect_named(there, camera, {half, {}}, "half a sample off", {}, {0.0, Unit::Pixel});
  });
}

TEST(DepthFit, NamesOtherNearAndFarPlanes) {
  for_every_view([](const Ground& there, const Camera& camera) {
    Camera other = camera;
    other.near_m = 10.0;
    other.far_m = 50000.0;
    expect_named(there, camera, {other, {DepthConvention::Window}}, "near plane lies at 10 m",
                 {DepthConvention::Window});
    expect_named(there, camera, {other, {DepthConvention::ReverseZ}}, "near plane lies at 10 m",
                 {DepthConvention::ReverseZ});
  });
}

TEST(DepthFit, RefusesAnotherTerrain) {
  int refused = 0, all = 0;
  std::string passed;
  for_every_view(
      [&](const Ground& there, const Camera& camera) {
        for (const char* other :
             {"generate:alpine?size=257&seed=21", "generate:canyon?size=257&seed=22",
              "generate:dunes?size=257&seed=23"}) {
          const auto stranger = ground(other);
          const HitImage hits = stranger->truth.caster.cast_frame(camera);
          const auto found = misfit(there, written(hits, camera, {}), {}, camera);
          ++all;
          if (!found || !found->refuses) {
            passed += fmt::format("{} seen through {} x {} pixels; ", other, camera.width_px,
                                  camera.height_px);
            continue;
          }
          ++refused;
          EXPECT_NE(found->text.find("another camera or another terrain"), std::string::npos)
              << found->text;
        }
      },
      257);
  // What passes are dunes of a few metres in place of others, and mountains seen straight from
  // above, whose heights move nothing on the screen.
  EXPECT_GE(refused, all - 3) << passed;
}

TEST(DepthFit, RefusesAnotherCamera) {
  int refused = 0, all = 0;
  for_every_view([&](const Ground& there, const Camera& camera) {
    for (const View& view : kViews) {
      const Camera other = there.camera(view.preset, camera.width_px, camera.height_px);
      if (other == camera) continue;
      const auto found =
          misfit(there, written(there.truth.caster.cast_frame(other), other, {}), {}, camera);
      ++all;
      refused += found && found->refuses;
    }
  });
  // Nothing but sky is right where there is much of it: an oblique view in a valley's place.
  EXPECT_GE(refused, all - 2) << all;
}

}  // namespace
}  // namespace plumb::audit
