// The kernels for every instruction set, and the careful walk of one ray at a time: the same bits.
#include <gtest/gtest.h>

#include "core/instruction_set.h"
#include "reference/pyramid_caster.h"
#include "support/random_scene.h"
#include "support/whole_number_scene.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;
using test_support::Random;
using test_support::View;

constexpr Diagonal kDiagonals[] = {Diagonal::Alternating, Diagonal::Fixed, Diagonal::Blocks8};

// Pixels in which a frame, cast with kernels, has other bits than its rays, cast alone.
std::size_t differing_pixels(const PyramidCaster& caster, const Camera& camera) {
  const HitImage image = caster.cast_frame(camera);
  std::size_t differing = 0;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const Ray ray = caster.camera_ray(camera, x + 0.5, y + 0.5);
      const RayHit hit = caster.cast(ray);
      const std::size_t pixel = image.index(x, y);
      const glm::dvec3 from_eye = hit ? hit.t * ray.direction : glm::dvec3(0.0);
      if (image.depth_m[pixel] != hit.t || image.primitive[pixel] != hit.triangle ||
          image.from_eye_m[pixel] != from_eye)
        ++differing;
    }
  }
  return differing;
}

void expect_no_difference(const Heightfield& field, const Camera& camera,
                          const std::string& scene) {
  for (const Diagonal diagonal : kDiagonals) {
    const PyramidCaster caster(field, diagonal);
    for (const InstructionSet set : available_instruction_sets()) {
      const ForcedInstructionSet forced(set);
      EXPECT_EQ(differing_pixels(caster, camera), 0u)
          << scene << ", " << name_of(diagonal) << ", " << name_of(set);
    }
  }
}

void compare_random_scenes(int terrains, std::uint64_t seed) {
  Random random(seed);
  for (int k = 0; k < terrains; ++k) {
    const Heightfield field = test_support::random_heightfield(random);
    for (int view = 0; view < static_cast<int>(View::Count); ++view) {
      const Camera camera =
          test_support::random_camera(random, field, static_cast<View>(view), 61, 47);
      expect_no_difference(field, camera, fmt::format("terrain {} of seed {}", k, seed));
    }
  }
}

TEST(LaneWalk, HasTheBitsOfTheCarefulWalkOnRandomScenes) { compare_random_scenes(60, 21); }

TEST(LongLaneWalk, HasTheBitsOfTheCarefulWalkOnRandomScenes) { compare_random_scenes(3000, 22); }

TEST(LaneWalk, HasTheBitsOfTheCarefulWalkWhereRoundingCouldDecide) {
  Random random(23);
  for (int k = 0; k < 40; ++k) {
    const Heightfield field = test_support::whole_number_field(random);
    const Camera camera = test_support::whole_number_camera(random, field, k % 2 == 0);
    expect_no_difference(field, camera, fmt::format("whole-number scene {}", k));
  }
}

// Eight levels and odd sizes: nodes that stick out of the terrain, and rays that climb and descend.
TEST(LaneWalk, HasTheBitsOfTheCarefulWalkOnALargerTerrain) {
  Random random(24);
  Heightfield field;
  field.heights_m = Grid<float>(391, 262);
  field.dx_m = 7.0;
  field.dy_m = 11.0;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      const double hill = 300.0 * std::sin(i * 0.03) * std::cos(j * 0.045);
      field.heights_m.floats()(i, j) = static_cast<float>(hill + random.uniform(0.0, 4.0));
    }
  }
  for (int k = 0; k < 10; ++k) {
    const Camera camera = test_support::random_camera(
        random, field, static_cast<View>(k % static_cast<int>(View::Count)), 150, 97);
    expect_no_difference(field, camera, fmt::format("view {}", k));
  }
}

}  // namespace
}  // namespace plumb::reference
