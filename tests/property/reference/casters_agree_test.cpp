// The two casters share no code, so where they agree on random scenes both are right.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "reference/embree_caster.h"
#include "reference/pyramid_caster.h"
#include "support/brute_force_caster.h"
#include "support/hit_image_difference.h"
#include "support/random_scene.h"
#include "support/whole_number_scene.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;
using test_support::HitImageDifference;
using test_support::Random;
using test_support::View;

constexpr Diagonal kDiagonals[] = {Diagonal::Alternating, Diagonal::Fixed, Diagonal::Blocks8};

HitImageDifference compare(const Heightfield& field, Diagonal diagonal, const Camera& camera) {
  return test_support::difference(camera, PyramidCaster(field, diagonal).cast_frame(camera),
                                  EmbreeCaster(field, diagonal).cast_frame(camera));
}

HitImageDifference compare_random_scenes(int terrains, std::uint64_t seed) {
  Random random(seed);
  HitImageDifference total;
  for (int k = 0; k < terrains; ++k) {
    const Heightfield field = test_support::random_heightfield(random);
    for (const Diagonal diagonal : kDiagonals) {
      for (int view = 0; view < static_cast<int>(View::Count); ++view) {
        const Camera camera =
            test_support::random_camera(random, field, static_cast<View>(view), 61, 47);
        const HitImageDifference d = compare(field, diagonal, camera);
        total.add(d);
        EXPECT_EQ(d.hit_or_miss + d.elsewhere, 0u)
            << "terrain " << k << " of seed " << seed << ", " << name_of(diagonal) << ", view "
            << view << ": " << to_text(d);
      }
    }
  }
  return total;
}

// Every pixel of every scene, those where the eye lies in the plane of a terrain included.
TEST(CastersAgree, OnRandomTerrainsAndCameras) {
  const HitImageDifference d = compare_random_scenes(150, 1);
  EXPECT_GT(d.hits, d.pixels / 8) << to_text(d);
}

TEST(LongCastersAgree, OnRandomTerrainsAndCameras) {
  const HitImageDifference d = compare_random_scenes(6000, 2);
  EXPECT_GT(d.hits, d.pixels / 8) << to_text(d);
}

// The field with triangle `index` as the only one of its cell.
Heightfield alone_in_its_cell(Heightfield field, Diagonal diagonal, std::uint32_t index) {
  const int cell = static_cast<int>(index / 2), half = static_cast<int>(index % 2);
  const int i = cell % field.cell_columns(), j = cell / field.cell_columns();
  const bool rising = rises_north_east(diagonal, i, j);
  // Corners that the triangle lacks: north-west or south-east of a rising cell, else NE or SW.
  const int a = rising ? half : 1 - half, b = rising ? 1 - half : 1 - half;
  field.heights_m.floats()(i + a, j + b) = std::numeric_limits<float>::quiet_NaN();
  return field;
}

// Pixels whose triangle is not the truth's and does not share the place that is met with it: t
// within four roundings of the exact one's.
std::size_t wrong_triangles(const Heightfield& field, Diagonal diagonal, const Camera& camera,
                            const HitImage& truth, const HitImage& image) {
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < image.size(); ++k) {
    if (!image.hit(k) || image.primitive[k] == truth.primitive[k]) continue;
    const int x = static_cast<int>(k % camera.width_px), y = static_cast<int>(k / camera.width_px);
    const auto ray = test_support::wide_ray<long double>(camera.eye_m, field.world_origin_m(),
                                                         ray_direction(camera, x + 0.5, y + 0.5),
                                                         camera.near_m, camera.far_m);
    const std::uint32_t index = image.primitive[k];
    const int cell = static_cast<int>(index / 2);
    test_support::WideHit<long double> hit;
    test_support::meet_wide_cell(ray, alone_in_its_cell(field, diagonal, index), diagonal,
                                 cell % field.cell_columns(), cell / field.cell_columns(), hit);
    const bool shares = hit.hit && hit.triangle == index &&
                        std::abs(static_cast<double>(hit.t) - truth.depth_m[k]) <=
                            4.0 * std::numeric_limits<double>::epsilon() * truth.depth_m[k];
    wrong += shares ? 0 : 1;
  }
  return wrong;
}

struct AgainstTruth {
  HitImageDifference of_embree, of_pyramid;
  std::size_t wrong_triangles = 0;  // of the pyramid
};

AgainstTruth compare_whole_number_scenes(int scenes, std::uint64_t seed) {
  Random random(seed);
  AgainstTruth total;
  for (int k = 0; k < scenes; ++k) {
    const Heightfield field = test_support::whole_number_field(random);
    const Diagonal diagonal = kDiagonals[k % 3];
    const Camera camera = test_support::whole_number_camera(random, field, k % 2 == 0);
    // Exact but for the last division: all products of these numbers fit into 64 bits.
    const HitImage truth = test_support::brute_force_frame<long double>(
        camera, field.world_origin_m(),
        [&](const auto& ray) { return test_support::brute_force(field, diagonal, ray); });
    const auto against_truth = [&](const HitImage& image) {
      return test_support::difference(camera, truth, image);
    };
    total.of_embree.add(against_truth(EmbreeCaster(field, diagonal).cast_frame(camera)));
    const HitImage pyramid = PyramidCaster(field, diagonal).cast_frame(camera);
    total.of_pyramid.add(against_truth(pyramid));
    total.wrong_triangles += wrong_triangles(field, diagonal, camera, truth, pyramid);
  }
  return total;
}

// Both find what is exactly so. Where two triangles share the place that is met, the pyramid may
// name the other one: its t is a quotient and rounds.
void expect_exact(const AgainstTruth& found) {
  for (const HitImageDifference& d : {found.of_embree, found.of_pyramid}) {
    EXPECT_EQ(d.hit_or_miss, 0u) << to_text(d);
    EXPECT_EQ(d.elsewhere, 0u) << to_text(d);
  }
  EXPECT_EQ(found.of_embree.primitive, 0u) << to_text(found.of_embree);
  EXPECT_EQ(found.wrong_triangles, 0u) << to_text(found.of_pyramid);
  std::printf("whole-number rays: Embree %s\n", to_text(found.of_embree).c_str());
  std::printf("whole-number rays: pyramid %s\n", to_text(found.of_pyramid).c_str());
}

TEST(CastersAgree, OnRaysExactlyThroughSamplesAndAlongEdges) {
  expect_exact(compare_whole_number_scenes(30, 3));
}

TEST(LongCastersAgree, OnRaysExactlyThroughSamplesAndAlongEdges) {
  expect_exact(compare_whole_number_scenes(1000, 4));
}

}  // namespace
}  // namespace plumb::reference
