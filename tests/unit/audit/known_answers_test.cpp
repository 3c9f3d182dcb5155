// Meshes whose true error others have measured: the audit must find the same figures.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "audit/audit.h"
#include "support/approximate_rtin.h"
#include "support/test_terrain.h"
#include "terrain/terrain_source.h"

namespace plumb {
namespace {

const std::string kData = PLUMB_SOURCE_DIR "/../shared/data/";

Camera from_above(const terrain::Heightfield& field, int width, int height) {
  const Box box = bounds(field);
  LookAt look;
  look.target_m = field.world_origin_m() + glm::dvec3(box.high.x / 2, box.high.y / 2, box.low.z);
  look.eye_m = look.target_m + glm::dvec3(0.0, -0.2 * box.high.y, box.high.z + box.high.x);
  look.width_px = width;
  look.height_px = height;
  return make_camera(look);
}

// The tile with its last row and column repeated: 513 x 513.
terrain::Heightfield fuji() {
  terrain::ReadOptions options;
  options.decode = terrain::Decode::TerrainRgb;
  options.spacing_x_m = options.spacing_y_m = 30.0;
  const terrain::Heightfield tile =
      terrain::load_terrain(kData + "martini_fuji_terrainrgb.png", options);
  terrain::Heightfield field = tile;
  field.heights_m = Grid<float>(513, 513);
  for (int j = 0; j < 513; ++j) {
    // Rows run from the south here; the repeated one is the last of the file, which is the
    // southernmost.
    for (int i = 0; i < 513; ++i)
      field.heights_m.floats()(i, j) = tile.heights_m(std::min(i, 511), std::max(j - 1, 0));
  }
  return field;
}

struct Known {
  double claimed_m, true_m;
  std::size_t triangles;
  std::int64_t over;
  double rounding_m;  // half a unit of the last digit given
};

class FujiKnownAnswer : public testing::TestWithParam<Known> {};

TEST_P(FujiKnownAnswer, IsFoundToTheDigit) {
  if (!std::filesystem::exists(kData + "martini_fuji_terrainrgb.png"))
    GTEST_SKIP() << "needs martini_fuji_terrainrgb.png";
  const Known known = GetParam();
  const terrain::Heightfield field = fuji();
  const DrawnSurface surface = test_support::ApproximateRtin(field).mesh(known.claimed_m);
  ASSERT_EQ(surface.mesh->triangles.size(), known.triangles);
  const audit::HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  const audit::AuditResult result =
      audit::audit_surface(truth, surface, from_above(field, 160, 90));
  const audit::ClaimResult& claim = result.claims.front();
  EXPECT_EQ(claim.label, "sample-error");
  EXPECT_NEAR(claim.measured, known.true_m, known.rounding_m);
  EXPECT_EQ(claim.triangles_over, known.over);
  EXPECT_FALSE(claim.holds);
  EXPECT_FALSE(result.holds());
  EXPECT_EQ(result.topology.t_junctions,
            0);  // this scheme draws no crack; what it breaks is its error
}

INSTANTIATE_TEST_SUITE_P(AtFourErrors, FujiKnownAnswer,
                         testing::Values(Known{5, 8.775, 187985, 1427, 0.0005},
                                         Known{20, 35.69, 35109, 973, 0.005},
                                         Known{50, 80.55, 8257, 474, 0.005},
                                         Known{100, 199.47, 2373, 214, 0.005}));

TEST(FujiMesh, At500MetresIsTheOneThatItsLibraryExpects) {
  std::ifstream file(kData + "formats/martini_fuji_error500_mesh.json");
  if (!file || !std::filesystem::exists(kData + "martini_fuji_terrainrgb.png"))
    GTEST_SKIP() << "needs the Fuji files";
  const nlohmann::json expected = nlohmann::json::parse(file);
  const auto& vertices = expected.at("vertices_xy");
  const auto& triangles = expected.at("triangles");
  using Corner = std::array<int, 2>;
  std::set<std::set<Corner>> theirs, ours;
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    std::set<Corner> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = triangles[t + k];
      corners.insert({vertices[2 * v].get<int>(), vertices[2 * v + 1].get<int>()});
    }
    theirs.insert(corners);
  }
  const terrain::Heightfield field = fuji();
  const DrawnSurface surface = test_support::ApproximateRtin(field).mesh(500.0);
  for (const Triangle& t : surface.mesh->triangles) {
    std::set<Corner> corners;
    for (const std::uint32_t v : t) {
      const glm::dvec3& p = surface.mesh->vertices_m[v];
      corners.insert({static_cast<int>(std::lround(p.x / field.dx_m)),
                      512 - static_cast<int>(std::lround(p.y / field.dy_m))});
    }
    ours.insert(corners);
  }
  EXPECT_EQ(surface.mesh->vertices_m.size(), 46u);
  EXPECT_EQ(ours.size(), 75u);
  EXPECT_EQ(ours, theirs);
}

// Needs no file: the largest deviation of each triangle by trying every sample against every
// triangle.
TEST(GeneratedKnownAnswer, IsThatOfASlowDirectComputation) {
  const terrain::Heightfield field = test_support::rough_terrain(65, 65, 7);
  const DrawnSurface surface = test_support::ApproximateRtin(field).mesh(4.0);
  const auto& mesh = *surface.mesh;
  double largest = 0.0;
  std::int64_t over = 0;
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a = mesh.vertices_m[t[0]], b = mesh.vertices_m[t[1]],
                     c = mesh.vertices_m[t[2]];
    const glm::dvec3 normal = area_normal(a, b, c);
    double of_triangle = 0.0;
    for (int j = 0; j < field.rows(); ++j) {
      for (int i = 0; i < field.columns(); ++i) {
        const double x = i * field.dx_m, y = j * field.dy_m;
        const auto left_of = [&](const glm::dvec3& p, const glm::dvec3& q) {
          return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x) >= 0.0;
        };
        if (!left_of(a, b) || !left_of(b, c) || !left_of(c, a)) continue;  // multiples of 10: exact
        const double z = a.z - (normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z;
        of_triangle =
            std::max(of_triangle, std::abs(z - static_cast<double>(field.heights_m(i, j))));
      }
    }
    largest = std::max(largest, of_triangle);
    over += of_triangle > 4.0;
  }
  ASSERT_GT(over, 0);  // the scheme must be caught here, or this terrain proves nothing
  const audit::HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  const audit::AuditResult result = audit::audit_surface(truth, surface, from_above(field, 96, 54));
  EXPECT_NEAR(result.claims.front().measured, largest,
              1e-11);  // a dozen roundings at heights below 128
  EXPECT_EQ(result.claims.front().triangles_over, over);
  EXPECT_FALSE(result.holds());
}

}  // namespace
}  // namespace plumb
