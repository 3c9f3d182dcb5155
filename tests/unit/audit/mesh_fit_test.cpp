// Meshes that lie elsewhere are named; meshes that are merely coarse are not.
#include "audit/mesh_fit.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "support/stranger_frames.h"

namespace plumb::audit {
namespace {

using test_support::Ground;
using test_support::ground;
using test_support::noise;

// Every `stride`-th sample, relative to the world's origin (as most files are).
TriangleMesh mesh_of(const terrain::Heightfield& field, int stride) {
  TriangleMesh mesh;
  const int columns = field.cell_columns() / stride + 1, rows = field.cell_rows() / stride + 1;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.vertices_m.push_back({field.origin_m.x + i * stride * field.dx_m,
                                 field.origin_m.y + j * stride * field.dy_m,
                                 field.heights_m(i * stride, j * stride)});
    }
  }
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * columns + i),
                 b = a + static_cast<std::uint32_t>(columns);
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  }
  return mesh;
}

const std::vector<std::string> kTerrains{"generate:alpine?size=129&seed=7&utm=1",
                                         "generate:canyon?size=129&seed=3",
                                         "generate:dunes?size=129&seed=5"};

void for_every_terrain(const std::function<void(const Ground&)>& look) {
  for (const std::string& terrain : kTerrains) {
    SCOPED_TRACE(terrain);
    look(*ground(terrain));
  }
}

using Move = std::function<glm::dvec3(const glm::dvec3&)>;

std::optional<Misfit> misfit(const Ground& there, const TriangleMesh& mesh,
                             const terrain::MeshReadOptions& options = {}) {
  return misfit_of_mesh(there.truth, mesh, options, there.camera("oblique", 160, 90), {});
}

TriangleMesh moved(TriangleMesh mesh, const Move& move) {
  for (glm::dvec3& v : mesh.vertices_m) v = move(v);
  return mesh;
}

// At each level of detail.
void expect_named(const Ground& there, const Move& move, const std::string& words,
                  const terrain::MeshReadOptions& options = {}) {
  for (const int stride : {1, 4, 16}) {
    const auto found = misfit(there, moved(mesh_of(there.field, stride), move), options);
    ASSERT_TRUE(found) << words << " " << stride;
    EXPECT_TRUE(found->refuses) << found->text;
    EXPECT_NE(found->text.find(words), std::string::npos) << found->text;
    EXPECT_EQ(found->text.find('\n'), std::string::npos);
  }
}

TEST(MeshFit, NamesTheUpwardAxis) {
  for_every_terrain([](const Ground& there) {
    // As exporters have it: up is y, north -z.
    expect_named(
        there, [](const glm::dvec3& v) { return glm::dvec3(v.x, v.z, -v.y); }, "--up y");
    // With --up y given for a mesh whose z is up.
    expect_named(there, [](const glm::dvec3& v) { return glm::dvec3(v.x, -v.z, v.y); }, "--up z",
                 {.origin_m = {}, .up_axis = terrain::UpAxis::Y});
    expect_named(
        there, [](const glm::dvec3& v) { return glm::dvec3(v.x, v.z, v.y); },
        "y is its upward axis and z points north");
  });
}

TEST(MeshFit, NamesTheUnit) {
  for_every_terrain([](const Ground& there) {
    for (const auto& [unit, words] : {std::pair{0.3048, "feet (--scale 0.3048)"},
                                      {0.01, "centimetres (--scale 0.01)"},
                                      {1000.0, "kilometres (--scale 1000)"}})
      expect_named(
          there, [u = unit](const glm::dvec3& v) { return v / u; }, words);
  });
}

TEST(MeshFit, NamesAMirroredMesh) {
  for_every_terrain([](const Ground& there) {
    const glm::dvec3 o = there.field.world_origin_m();
    const double width = there.field.cell_columns() * there.field.dx_m,
                 depth = there.field.cell_rows() * there.field.dy_m;
    expect_named(
        there, [&](const glm::dvec3& v) { return glm::dvec3(v.x, 2.0 * o.y + depth - v.y, v.z); },
        "north and south are exchanged");
    expect_named(
        there, [&](const glm::dvec3& v) { return glm::dvec3(2.0 * o.x + width - v.x, v.y, v.z); },
        "east and west are exchanged");
    expect_named(
        there, [](const glm::dvec3& v) { return glm::dvec3(v.x, -v.y, v.z); },
        "north and south are exchanged");
  });
}

TEST(MeshFit, NamesAnOffset) {
  const auto there = ground(kTerrains[0]);
  const glm::dvec3 o = there->field.world_origin_m();
  expect_named(
      *there, [&](const glm::dvec3& v) { return v - o; }, "(--offset 500000,4500000,0)");
  expect_named(
      *there, [&](const glm::dvec3& v) { return v - o - glm::dvec3(960.0, 960.0, 0.0); },
      "its (0, 0, 0) lies at");
  for_every_terrain([](const Ground& ground) {
    expect_named(
        ground, [](const glm::dvec3& v) { return v + glm::dvec3(0.0, 0.0, 1e4); },
        "lowered by 10000 m");
    expect_named(
        ground, [](const glm::dvec3& v) { return glm::dvec3(v.x, v.y, v.z / 0.3048); },
        "taken for the terrain's times 3.28084");
  });
}

TEST(MeshFit, NamesTwoMistakes) {
  for_every_terrain([](const Ground& there) {
    expect_named(
        there, [](const glm::dvec3& v) { return glm::dvec3(v.x, v.z, -v.y) / 0.01; },
        "--up y), and its unit is centimetres");
  });
}

TEST(MeshFit, RefusesAnotherTerrain) {
  const auto there = ground(kTerrains[0]);
  for (int seed = 21; seed < 31; ++seed) {
    const auto other = ground(fmt::format("generate:alpine?size=129&utm=1&seed={}", seed));
    const auto found = misfit(*there, mesh_of(other->field, 1));
    ASSERT_TRUE(found) << seed;
    EXPECT_TRUE(found->refuses);
    EXPECT_NE(found->text.find("another terrain or place"), std::string::npos) << found->text;
  }
}

TEST(MeshFit, NamesNothingInALevelOfDetail) {
  for_every_terrain([](const Ground& there) {
    for (int stride = 1; stride <= 128; stride *= 2) {
      const auto found = misfit(there, mesh_of(there.field, stride));
      EXPECT_FALSE(found) << stride << " " << found->text;
    }
  });
}

TEST(MeshFit, NamesNothingInNoiseNorInAPartNorInMoreThanTheTerrain) {
  for_every_terrain([](const Ground& there) {
    int k = 0;
    const double relief = bounds(there.field).high.z - bounds(there.field).low.z;
    const auto rough = moved(mesh_of(there.field, 2), [&](const glm::dvec3& v) {
      return v + glm::dvec3(0.0, 0.0, 0.2 * relief * (noise(3, ++k, 0) - 0.5));
    });
    auto found = misfit(there, rough);
    EXPECT_FALSE(found) << found->text;
    TriangleMesh part = mesh_of(there.field, 1);
    part.vertices_m.resize(part.vertices_m.size() / 8);
    part.triangles.resize(8);
    found = misfit(there, part);
    EXPECT_FALSE(found) << found->text;
  });
  // A terrain of which the truth is a small window.
  const auto whole = ground("generate:alpine?size=257&seed=7");
  terrain::Heightfield window;
  window.heights_m = Grid<float>(65, 65);
  window.dx_m = whole->field.dx_m;
  window.dy_m = whole->field.dy_m;
  window.origin_m = {64 * window.dx_m, 96 * window.dy_m};
  for (int j = 0; j < 65; ++j) {
    for (int i = 0; i < 65; ++i)
      window.heights_m.floats()(i, j) = whole->field.heights_m(64 + i, 96 + j);
  }
  const Ground there(std::move(window));
  EXPECT_FALSE(misfit(there, mesh_of(whole->field, 1)));
}

}  // namespace
}  // namespace plumb::audit
