// A mesh that keeps its bound, on every elevation file: the audit must find no more than it claims.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>

#include "audit/audit.h"
#include "support/elevation_files.h"
#include "support/greedy_insertion.h"
#include "terrain/terrain_source.h"

namespace plumb {
namespace {

using test_support::ElevationFile;

Camera from_above(const terrain::Heightfield& field) {
  const Box box = bounds(field);
  LookAt look;
  look.target_m = field.world_origin_m() + glm::dvec3(box.high.x / 2, box.high.y / 2, box.low.z);
  look.eye_m = look.target_m + glm::dvec3(0.0, -0.2 * box.high.y, box.high.z + box.high.x);
  look.width_px = 64;
  look.height_px = 36;
  return make_camera(look);
}

// Claimed, and found by the audit, in metres. The insertion computes each distance with the same
// six roundings as the audit or other ones: 1e-9 m at heights up to 1e4 m is a thousand of them.
void expect_acquitted(const terrain::Heightfield& field, double bound_m, const char* name) {
  const DrawnSurface surface = test_support::GreedyInsertion(field).mesh(bound_m);
  const audit::HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  const audit::AuditResult result = audit::audit_surface(truth, surface, from_above(field));
  const audit::ClaimResult& claim = result.claims.front();
  ASSERT_EQ(claim.label, "sample-error");
  EXPECT_LE(claim.measured, bound_m + 1e-9) << name;
  EXPECT_TRUE(claim.holds) << name;
  EXPECT_EQ(result.samples.uncovered, 0) << name;
  EXPECT_EQ(result.topology.t_junctions, 0) << name;
  EXPECT_EQ(result.topology.folded_triangles, 0) << name;
  EXPECT_EQ(result.topology.degenerate_triangles, 0) << name;
  std::printf("%s: %zu triangles, claimed %g m, true / claimed %.6f\n", name,
              surface.mesh->triangles.size(), bound_m, claim.measured / bound_m);
}

// The part of a terrain around its highest sample.
terrain::Heightfield around_summit(const terrain::Heightfield& field, int columns, int rows) {
  terrain::HeightGrid heights = field.heights_m;
  const auto& values = heights.floats().values();
  const int at = static_cast<int>(std::max_element(values.begin(), values.end()) - values.begin());
  const int i0 = std::clamp(at % heights.columns() - columns / 2, 0, heights.columns() - columns);
  const int j0 = std::clamp(at / heights.columns() - rows / 2, 0, heights.rows() - rows);
  terrain::Heightfield part = field;
  part.heights_m = Grid<float>(columns, rows);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) part.heights_m.floats()(i, j) = heights(i0 + i, j0 + j);
  }
  return part;
}

class GreedyInsertionOfAFile : public testing::TestWithParam<ElevationFile> {};

TEST_P(GreedyInsertionOfAFile, KeepsItsBound) {
  const ElevationFile& file = GetParam();
  if (!std::filesystem::exists(path_of(file))) GTEST_SKIP() << path_of(file) << " is not there";
  terrain::ReadOptions options;
  options.decode = file.decode;
  options.spacing_x_m = file.spacing_m;
  options.no_data_policy = terrain::NoDataPolicy::Fill;
  options.window = file.window;
  const terrain::Heightfield field =
      around_summit(terrain::load_terrain(path_of(file), options), 129, 97);
  const Box box = bounds(field);
  const double relief = box.high.z - box.low.z;
  for (const double share : {0.01, 0.1})
    expect_acquitted(field, share * std::max(relief, 1.0), file.name);
}

INSTANTIATE_TEST_SUITE_P(OfEach, GreedyInsertionOfAFile,
                         testing::ValuesIn(test_support::kElevationFiles), [](const auto& of) {
                           std::string name = of.param.name;
                           for (char& c : name)
                             c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

TEST(GreedyInsertion, KeepsItsBoundOnAGeneratedTerrain) {
  const terrain::Heightfield field = terrain::load_terrain("generate:alpine?size=257");
  for (const double bound : {2.0, 20.0}) expect_acquitted(field, bound, "alpine 257");
}

}  // namespace
}  // namespace plumb
