// The two casters share no code, so where they agree on random scenes both are right.
#include <gtest/gtest.h>

#include <cstdio>

#include "reference/embree_caster.h"
#include "reference/pyramid_caster.h"
#include "support/hit_image_difference.h"
#include "support/random_scene.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;
using test_support::HitImageDifference;
using test_support::Random;
using test_support::View;

constexpr Diagonal kDiagonals[] = {Diagonal::Alternating, Diagonal::Fixed, Diagonal::Blocks8};

std::string words(const HitImageDifference& d) {
  return fmt::format(
      "{} pixels, {} hits: {} hit or miss, {} elsewhere, {} other triangle, {:.3g} px", d.pixels,
      d.hits, d.hit_or_miss, d.elsewhere, d.primitive, d.largest_px);
}

HitImageDifference compare_views(int terrains, std::uint64_t seed) {
  Random random(seed);
  HitImageDifference total;
  for (int k = 0; k < terrains; ++k) {
    const Heightfield field = test_support::random_heightfield(random);
    for (const Diagonal diagonal : kDiagonals) {
      const PyramidCaster pyramid(field, diagonal);
      const EmbreeCaster embree(field, diagonal);
      for (int view = 0; view < static_cast<int>(View::Count); ++view) {
        const Camera camera =
            test_support::random_camera(random, field, static_cast<View>(view), 61, 47);
        const HitImageDifference d =
            test_support::difference(camera, pyramid.cast_frame(camera), embree.cast_frame(camera));
        total.add(d);
        if (d.hit_or_miss + d.elsewhere > 0) {
          std::printf("terrain %d %s view %d: %s\n", k, name_of(diagonal), view, words(d).c_str());
        }
      }
    }
  }
  return total;
}

TEST(CastersAgree, OnRandomTerrainsAndCameras) {
  const HitImageDifference d = compare_views(getenv("N") ? atoi(getenv("N")) : 60, 1);
  std::printf("%s\n", words(d).c_str());
  EXPECT_GT(d.hits, d.pixels / 8) << words(d);
  EXPECT_EQ(d.hit_or_miss, 0u) << words(d);
  EXPECT_EQ(d.elsewhere, 0u) << words(d);
}

}  // namespace
}  // namespace plumb::reference
