// How many triangles a bound that holds costs, beside a popular scheme whose bound does not.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "mesh/restricted_quadtree/restricted_quadtree.h"
#include "support/approximate_rtin.h"
#include "terrain/terrain_source.h"

namespace plumb::mesh::restricted_quadtree {
namespace {

// The largest ratio of triangle counts at 1, 2, 5, 10 and 20 m.
double largest_ratio(const terrain::Heightfield& field, const char* name) {
  const test_support::ApproximateRtin approximate(field);
  const Prepared prepared = prepare(field);
  double largest = 0.0;
  for (const double bound_m : {1.0, 2.0, 5.0, 10.0, 20.0}) {
    const auto theirs = static_cast<double>(approximate.mesh(bound_m).mesh->triangles.size());
    const DrawnSurface surface = draw(prepared, Camera{}, {bound_m, Unit::Metre});
    const double ratio = static_cast<double>(surface.mesh->triangles.size()) / theirs;
    std::printf("%s, %g m: %zu triangles, %.3f of the approximate scheme's\n", name, bound_m,
                surface.mesh->triangles.size(), ratio);
    largest = std::max(largest, ratio);
  }
  return largest;
}

TEST(TriangleCount, IsNearTheApproximateSchemesOnFractionalHeights) {
  EXPECT_LE(largest_ratio(terrain::load_terrain("generate:alpine?size=513"), "alpine"), 1.15);
}

TEST(TriangleCount, IsNearTheApproximateSchemesOnWholeMetres) {
  const std::string path = PLUMB_SOURCE_DIR "/../shared/data/taiwan_central_8193.tif";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  terrain::ReadOptions options;
  options.window = terrain::Window{4000, 3000, 1025, 1025};
  EXPECT_LE(largest_ratio(terrain::load_terrain(path, options), "taiwan"), 1.3);
}

}  // namespace
}  // namespace plumb::mesh::restricted_quadtree
