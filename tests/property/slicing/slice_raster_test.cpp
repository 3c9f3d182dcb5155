// The two renderers of slices beside each other.
#include "slicing/slice_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/random_slices.h"

namespace plumb::slicing {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;
using test_support::Random;

// Pixels from the segment between two points in view coordinates, cut at the near plane.
double pixels_from_segment(const Camera& camera, glm::dvec3 a, glm::dvec3 b,
                           const glm::dvec2& centre) {
  if (a.z < camera.near_m && b.z < camera.near_m) return INFINITY;
  if (a.z < b.z) std::swap(a, b);
  if (b.z < camera.near_m) b = a + (b - a) * ((a.z - camera.near_m) / (a.z - b.z));
  const glm::dvec2 p = view_to_pixel(camera, a), d = view_to_pixel(camera, b) - p;
  const double length_squared = glm::dot(d, d);
  const double share =
      length_squared > 0.0 ? std::clamp(glm::dot(centre - p, d) / length_squared, 0.0, 1.0) : 0.0;
  const glm::dvec2 off = p + share * d - centre;
  return std::sqrt(glm::dot(off, off));
}

bool is_near_an_edge(const SliceMesh& slices, const Camera& camera, int x, int y) {
  const glm::dvec2 centre(x + 0.5, y + 0.5);
  for (std::size_t first = 0; first < slices.mesh.vertices_m.size(); first += 4) {
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::dvec3 a = to_view(camera, slices.mesh.vertices_m[first + k]),
                       b = to_view(camera, slices.mesh.vertices_m[first + (k + 1) % 4]);
      if (pixels_from_segment(camera, a, b, centre) <= 1.0 / 128.0) return true;
    }
  }
  return false;
}

TEST(SliceRaster, SeesWhatRaysSeeAwayFromTheQuadsEdges) {
  Random random(51);
  std::int64_t hits = 0, ties = 0;
  for (std::uint32_t round = 0; round < 120; ++round) {
    const Heightfield field = test_support::random_ground(random, round);
    const SlicingTree tree(field, Diagonal::Alternating);
    const Camera camera =
        relative_to(test_support::random_view(random, field), field.world_origin_m());
    const SlicingCut cut = cut_tree(tree, camera, test_support::random_cut_options(random));
    const HeightLookup heights(field, Diagonal::Alternating);
    const HitImage rays = slice_rays(cut, camera, heights).image;
    const HitImage quads = rasterise_slices(cut, camera, heights).image;
    const SliceMesh slices = mesh_of_slices(cut);
    EXPECT_EQ(static_cast<std::int64_t>(slices.quads.size()), cut.slices);
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const std::size_t pixel = rays.index(x, y);
        hits += rays.hit(pixel) ? 1 : 0;
        if (rays.depth_m[pixel] == quads.depth_m[pixel] &&
            rays.from_eye_m[pixel] == quads.from_eye_m[pixel] &&
            rays.primitive[pixel] == quads.primitive[pixel]) {
          continue;
        }
        ++ties;
        ASSERT_TRUE(is_near_an_edge(slices, camera, x, y))
            << round << ": " << x << ", " << y << " " << rays.depth_m[pixel] << " "
            << quads.depth_m[pixel];
      }
    }
  }
  EXPECT_GT(hits, 20'000);
  EXPECT_LT(ties, hits / 200);
  RecordProperty("pixels on quads' edges", static_cast<int>(ties));
}

}  // namespace
}  // namespace plumb::slicing
