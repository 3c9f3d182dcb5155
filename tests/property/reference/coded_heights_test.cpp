// Heights of 16 bits and the same heights as floats: not a bit of what is found differs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/instruction_set.h"
#include "reference/heightfield_nearest.h"
#include "reference/pyramid_caster.h"
#include "reference/surface_height.h"
#include "support/coded_terrain.h"
#include "support/whole_number_scene.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using test_support::Random;
using test_support::Twins;
using test_support::View;

constexpr Diagonal kDiagonals[] = {Diagonal::Alternating, Diagonal::Fixed, Diagonal::Blocks8};

void expect_same_pyramid(const HeightPyramid& coded, const HeightPyramid& floats) {
  for (int level = 1; level <= floats.top_level(); ++level) {
    for (int j = 0; j < floats.rows(level); ++j) {
      for (int i = 0; i < floats.columns(level); ++i) {
        const HeightRange a = coded.node(level, i, j), b = floats.node(level, i, j);
        ASSERT_EQ(a.low, b.low) << level << " " << i << " " << j;
        ASSERT_EQ(a.high, b.high) << level << " " << i << " " << j;
      }
    }
  }
  EXPECT_EQ(2 * coded.bytes(), floats.bytes());
}

// Frames with every kernel, and the rays of one alone.
void expect_same_hits(const Twins& twins, const Camera& camera, const std::string& scene) {
  for (const Diagonal diagonal : kDiagonals) {
    const PyramidCaster coded(twins.coded, diagonal), floats(twins.floats, diagonal);
    for (const InstructionSet set : available_instruction_sets()) {
      const ForcedInstructionSet forced(set);
      const HitImage a = coded.cast_frame(camera), b = floats.cast_frame(camera);
      const auto where = fmt::format("{}, {}, {}", scene, name_of(diagonal), name_of(set));
      EXPECT_TRUE(a.depth_m == b.depth_m) << where;
      EXPECT_TRUE(a.from_eye_m == b.from_eye_m) << where;
      EXPECT_TRUE(a.primitive == b.primitive) << where;
    }
    for (int y = 0; y < camera.height_px; y += 5) {
      for (int x = 0; x < camera.width_px; x += 3) {
        const Ray ray = floats.camera_ray(camera, x + 0.5, y + 0.5);
        EXPECT_EQ(coded.cast(ray), floats.cast(ray)) << scene;
      }
    }
  }
}

TEST(CodedHeights, AreHitAsFloatsAreOnRandomScenes) {
  Random random(31);
  int with_voids = 0;
  for (int k = 0; k < 60; ++k) {
    const Twins twins = test_support::coded_twins(random, test_support::random_heightfield(random));
    ASSERT_TRUE(twins.coded.heights_m.is_coded());
    with_voids += twins.coded.heights_m.coding().void_code <= 65535 ? 1 : 0;
    expect_same_pyramid(HeightPyramid(twins.coded), HeightPyramid(twins.floats));
    for (int view = 0; view < static_cast<int>(View::Count); ++view) {
      const Camera camera =
          test_support::random_camera(random, twins.floats, static_cast<View>(view), 61, 47);
      expect_same_hits(twins, camera, fmt::format("terrain {}", k));
    }
  }
  EXPECT_GT(with_voids, 15);
}

TEST(CodedHeights, AreHitAsFloatsAreWhereRoundingCouldDecide) {
  Random random(32);
  for (int k = 0; k < 40; ++k) {
    const Twins twins = test_support::coded_twins(random, test_support::whole_number_field(random));
    const Camera camera = test_support::whole_number_camera(random, twins.floats, k % 2 == 0);
    expect_same_hits(twins, camera, fmt::format("whole-number scene {}", k));
  }
}

TEST(CodedHeights, HaveTheNearestPointsOfFloats) {
  Random random(33);
  for (int k = 0; k < 200; ++k) {
    const Twins twins = test_support::coded_twins(random, test_support::random_heightfield(random));
    const HeightPyramid coded(twins.coded), floats(twins.floats);
    const Box box = bounds(twins.floats);
    if (box.empty()) continue;
    const glm::dvec3 size = box.high - box.low + 1.0;
    for (int point = 0; point < 20; ++point) {
      const glm::dvec3 at =
          box.low + size * glm::dvec3(random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.2),
                                      random.uniform(-0.5, 1.5));
      const double reach_m = random.chance(0.5) ? 1e9 : random.uniform(0.0, size.x);
      const Diagonal diagonal = kDiagonals[random.integer(0, 2)];
      const NearestPoint a = nearest_on_heightfield(twins.coded, diagonal, coded, at, reach_m);
      const NearestPoint b = nearest_on_heightfield(twins.floats, diagonal, floats, at, reach_m);
      ASSERT_EQ(a.triangle, b.triangle);
      if (!b) continue;
      ASSERT_EQ(a.point_m, b.point_m);
      ASSERT_EQ(a.distance_m, b.distance_m);
    }
    EXPECT_EQ(evaluation_slack_m(twins.coded), evaluation_slack_m(twins.floats));
  }
}

}  // namespace
}  // namespace plumb::reference
