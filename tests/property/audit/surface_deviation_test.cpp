// Deviations found by rows, bands, buckets and lanes are those of asking every triangle.
#include "audit/surface_deviation.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "core/instruction_set.h"
#include "support/random_scene.h"

namespace plumb::audit {
namespace {

using test_support::Random;

// Triangles of every size over and around the terrain, some with corners on samples, some needles.
TriangleMesh random_triangles(Random& random, const terrain::Heightfield& field) {
  TriangleMesh mesh;
  mesh.origin_m = field.world_origin_m();
  const auto corner = [&](double i, double j, double reach) {
    double x = i + random.uniform(-reach, reach), y = j + random.uniform(-reach, reach);
    if (random.chance(0.5)) x = std::round(x);
    if (random.chance(0.5)) y = std::round(y);
    mesh.vertices_m.emplace_back(x * field.dx_m, y * field.dy_m, random.uniform(-50.0, 50.0));
  };
  const int count = random.integer(1, 60);
  for (int t = 0; t < count; ++t) {
    const double i = random.uniform(-2.0, field.columns() + 1.0),
                 j = random.uniform(-2.0, field.rows() + 1.0),
                 reach = std::pow(10.0, random.uniform(-1.0, 1.8));
    for (int k = 0; k < 3; ++k) corner(i, j, reach);
    const auto first = static_cast<std::uint32_t>(3 * t);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Deviation by_asking_all(const TriangleMesh& mesh, const glm::dvec3& shift,
                        const glm::dvec3& place) {
  Deviation found;
  for (std::uint32_t index = 0; index < mesh.triangles.size(); ++index) {
    const FlatTriangle t = flat_triangle(mesh, index, shift);
    double z = 0.0;
    if (!t.is_flat()) continue;
    const Cover cover = t.cover(place.x, place.y, z);
    if (cover != Cover::Outside) found.add(z - place.z, index, cover);
  }
  return found;
}

void expect_same(const Deviation& found, const Deviation& expected) {
  EXPECT_EQ(found.triangle, expected.triangle);
  EXPECT_EQ(found.sheets, expected.sheets);
  if (std::isnan(expected.delta_m)) {
    EXPECT_TRUE(std::isnan(found.delta_m));
  } else {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(found.delta_m),
              std::bit_cast<std::uint64_t>(expected.delta_m));
  }
}

TEST(SurfaceDeviation, AtSamplesIsThatOfAskingEveryTriangleOnEveryInstructionSet) {
  Random random(71);
  for (int round = 0; round < 60; ++round) {
    const terrain::Heightfield field = test_support::random_heightfield(random);
    const TriangleMesh mesh = random_triangles(random, field);
    const glm::dvec3 shift = mesh.origin_m - field.world_origin_m();
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(name_of(set));
      const ForcedInstructionSet forced(set);
      std::vector<float> most;
      for_each_sample_row(field, mesh, &most, [&](int j, const DeviationRow& row) {
        for (int i = 0; i < field.columns(); ++i) {
          const glm::dvec3 sample{i * field.dx_m, j * field.dy_m, field.heights_m(i, j)};
          expect_same(row[i], by_asking_all(mesh, shift, sample));
        }
      });
      for (std::uint32_t index = 0; index < mesh.triangles.size(); ++index) {
        const FlatTriangle t = flat_triangle(mesh, index, shift);
        double largest = 0.0;
        for (int j = 0; t.is_flat() && j < field.rows(); ++j) {
          for (int i = 0; i < field.columns(); ++i) {
            double z = 0.0;
            if (t.cover(i * field.dx_m, j * field.dy_m, z) == Cover::Outside) continue;
            const double distance = std::abs(z - field.heights_m(i, j));
            largest = distance > largest ? distance : largest;
          }
        }
        EXPECT_EQ(most[index], static_cast<float>(largest)) << index;
      }
    }
    if (HasFailure()) return;
  }
}

TEST(SurfaceDeviation, AtPlacesIsThatOfAskingEveryTriangle) {
  Random random(72);
  for (int round = 0; round < 60; ++round) {
    const terrain::Heightfield field = test_support::random_heightfield(random);
    const TriangleMesh mesh = random_triangles(random, field);
    std::vector<glm::dvec3> places(static_cast<std::size_t>(random.integer(0, 300)));
    for (glm::dvec3& place : places) {
      place = {random.uniform(0.0, field.cell_columns()) * field.dx_m,
               random.uniform(0.0, field.cell_rows()) * field.dy_m, random.uniform(-50.0, 50.0)};
      if (random.chance(0.3)) place.x = std::round(place.x / field.dx_m) * field.dx_m;
      if (random.chance(0.3)) place.y = std::round(place.y / field.dy_m) * field.dy_m;
    }
    const std::vector<Deviation> found = deviation_at(field, mesh, places);
    ASSERT_EQ(found.size(), places.size());
    const glm::dvec3 shift = mesh.origin_m - field.world_origin_m();
    for (std::size_t k = 0; k < places.size(); ++k)
      expect_same(found[k], by_asking_all(mesh, shift, places[k]));
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace plumb::audit
