// Properties of the restricted quadtree, each against something slow that shares nothing with it.
#include "mesh/restricted_quadtree/restricted_quadtree.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/screen_error.h"
#include "support/slow_refinement.h"
#include "support/test_terrain.h"

namespace plumb::mesh::restricted_quadtree {
namespace {

using test_support::rough_terrain;
using test_support::SlowRefinement;
using Point = SlowRefinement::Point;

struct Scene {
  int columns, rows;
  double void_share;
  double tolerance_m;
};

const std::array<Scene, 9> kScenes{{{33, 33, 0.0, 1.0},
                                    {33, 33, 0.0, 8.0},
                                    {33, 33, 0.1, 5.0},
                                    {30, 33, 0.0, 5.0},
                                    {21, 40, 0.05, 2.0},
                                    {65, 17, 0.0, 0.5},
                                    {2, 2, 0.0, 1.0},
                                    {3, 2, 0.0, 1.0},
                                    {24, 23, 0.5, 20.0}}};

std::set<std::set<Point>> triangles_of(const DrawnSurface& surface,
                                       const terrain::Heightfield& field) {
  std::set<std::set<Point>> result;
  for (const Triangle& t : surface.mesh->triangles) {
    std::set<Point> corners;
    for (const std::uint32_t v : t) {
      const glm::dvec3& p = surface.mesh->vertices_m[v];
      corners.insert({static_cast<int>(std::lround(p.x / field.dx_m)),
                      static_cast<int>(std::lround(p.y / field.dy_m))});
    }
    result.insert(corners);
  }
  return result;
}

// Not within five per cent: equal, triangle by triangle, since the smallest set is unique.
TEST(RestrictedQuadtree, IsTheSmallestConformingMeshForATolerancesInMetres) {
  for (const Scene& scene : kScenes) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      const terrain::Heightfield field =
          rough_terrain(scene.columns, scene.rows, seed, 100.0, scene.void_share);
      const DrawnSurface surface = draw(prepare(field), Camera{}, {scene.tolerance_m, Unit::Metre});
      const SlowRefinement slow(field, [&](const SlowRefinement::Corners&, double error) {
        return error > scene.tolerance_m;
      });
      EXPECT_EQ(triangles_of(surface, field), slow.drawn())
          << scene.columns << " x " << scene.rows << " seed " << seed;
    }
  }
}

// Every place of the full-detail surface is covered once: areas add up and no edge has a vertex in
// its middle.
TEST(RestrictedQuadtree, HasNoTJunctionAndTheOutlineOfTheTruth) {
  for (const Scene& scene : kScenes) {
    const terrain::Heightfield field =
        rough_terrain(scene.columns, scene.rows, 11, 100.0, scene.void_share);
    const DrawnSurface surface = draw(prepare(field), Camera{}, {scene.tolerance_m, Unit::Metre});
    double drawn_area = 0.0, true_area = 0.0;
    std::map<std::set<Point>, int> edges;
    for (const std::set<Point>& corners : triangles_of(surface, field)) {
      const std::vector<Point> p(corners.begin(), corners.end());
      drawn_area += std::abs((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
                             (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])) /
                    2.0;
      for (std::size_t k = 0; k < 3; ++k) ++edges[{p[k], p[(k + 1) % 3]}];
    }
    const auto exists = [&](int i, int j) {
      return field.heights_m.contains(i, j) && !field.is_void(i, j);
    };
    const auto half_exists = [&](Point a, Point b, Point c) {
      return exists(a[0], a[1]) && exists(b[0], b[1]) && exists(c[0], c[1]);
    };
    std::set<std::set<Point>> rim;  // unit edges of the truth that belong to a single half cell
    std::map<std::set<Point>, int> unit_edges;
    for (int j = 0; j + 1 < field.rows(); ++j) {
      for (int i = 0; i + 1 < field.columns(); ++i) {
        const Point sw{i, j}, se{i + 1, j}, nw{i, j + 1}, ne{i + 1, j + 1};
        const bool rises = (i + j) % 2 == 0;
        const std::array<std::array<Point, 3>, 2> halves =
            rises ? std::array<std::array<Point, 3>, 2>{{{sw, se, ne}, {sw, ne, nw}}}
                  : std::array<std::array<Point, 3>, 2>{{{sw, se, nw}, {se, ne, nw}}};
        for (const auto& h : halves) {
          if (!half_exists(h[0], h[1], h[2])) continue;
          true_area += 0.5;
          for (std::size_t k = 0; k < 3; ++k) ++unit_edges[{h[k], h[(k + 1) % 3]}];
        }
      }
    }
    for (const auto& [edge, count] : unit_edges) {
      if (count == 1) rim.insert(edge);
    }
    EXPECT_EQ(drawn_area, true_area);
    for (const auto& [edge, count] : edges) {
      EXPECT_LE(count, 2);
      if (count == 2) continue;
      // An edge of one triangle consists of unit edges of the rim; a T-junction would lie inside
      // the surface.
      const Point a = *edge.begin(), b = *edge.rbegin();
      const int steps = std::max(std::abs(b[0] - a[0]), std::abs(b[1] - a[1]));
      for (int s = 0; s < steps; ++s) {
        const Point from{a[0] + (b[0] - a[0]) / steps * s, a[1] + (b[1] - a[1]) / steps * s};
        const Point to{from[0] + (b[0] - a[0]) / steps, from[1] + (b[1] - a[1]) / steps};
        EXPECT_EQ(rim.count({from, to}), 1u) << scene.columns << " x " << scene.rows;
      }
    }
  }
}

TEST(RestrictedQuadtree, KeepsEverySampleInViewWithinTheTolerancesInPixels) {
  const terrain::Heightfield field = rough_terrain(65, 65, 5, 200.0, 0.02);
  const Prepared prepared = prepare(field);
  for (const double pixels : {0.25, 1.0, 4.0}) {
    for (const glm::dvec3& eye :
         {glm::dvec3(320, -50, 250), glm::dvec3(100, 100, 130), glm::dvec3(320, 320, 900)}) {
      LookAt look;
      look.eye_m = eye;
      look.target_m = {330, 350, 50};
      look.width_px = 640;
      look.height_px = 360;
      const Camera camera = make_camera(look);
      const DrawnSurface surface = draw(prepared, camera, {pixels, Unit::Pixel});
      double largest = 0.0;
      for (const Triangle& t : surface.mesh->triangles) {
        const glm::dvec3 a = surface.mesh->vertices_m[t[0]], b = surface.mesh->vertices_m[t[1]],
                         c = surface.mesh->vertices_m[t[2]];
        const glm::dvec3 normal = area_normal(a, b, c);
        const auto [x0, x1] = std::minmax({a.x, b.x, c.x});
        const auto [y0, y1] = std::minmax({a.y, b.y, c.y});
        for (double y = y0; y <= y1; y += 10.0) {
          for (double x = x0; x <= x1; x += 10.0) {
            const auto left_of = [&](const glm::dvec3& p, const glm::dvec3& q) {
              return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x) >= 0.0;
            };
            if (!left_of(a, b) || !left_of(b, c) || !left_of(c, a)) continue;
            const glm::dvec3 sample{
                x, y, field.heights_m(static_cast<int>(x / 10), static_cast<int>(y / 10))};
            const glm::dvec3 view = to_view(camera, sample);
            if (view.z < camera.near_m) continue;
            const glm::dvec2 at = view_to_pixel(camera, view);
            if (at.x < 0 || at.x > 640 || at.y < 0 || at.y > 360) continue;
            const double z = a.z - (normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z;
            const glm::dvec3 moved = to_view(camera, {x, y, z});
            const glm::dvec2 apart = view_to_pixel(camera, moved) - at;
            largest = std::max(largest, moved.z > 0 ? std::sqrt(glm::dot(apart, apart)) : 1e9);
          }
        }
      }
      EXPECT_LE(largest, pixels * (1 + 1e-12));
      EXPECT_GT(largest, 0.2 * pixels) << "so careful that the tolerance buys nothing";
    }
  }
}

TEST(RestrictedQuadtree, OfAPlaneIsTwoTrianglesEvenAtToleranceZero) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(129, 129);
  for (int j = 0; j < 129; ++j) {
    for (int i = 0; i < 129; ++i)
      field.heights_m.floats()(i, j) = static_cast<float>(0.5 * i - 0.25 * j);
  }
  EXPECT_EQ(draw(prepare(field), Camera{}, {0.0, Unit::Metre}).mesh->triangles.size(), 2u);
}

// A spike at a finest odd vertex: its own cells, and the cascade that conformity asks for.
TEST(RestrictedQuadtree, OfASpikeCascades) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(129, 129);
  field.heights_m.floats()(65, 65) = 50.0f;
  const DrawnSurface surface = draw(prepare(field), Camera{}, {1.0, Unit::Metre});
  // From two roots to a centre at the finest level: the count by the slow reference.
  const SlowRefinement slow(
      field, [](const SlowRefinement::Corners&, double error) { return error > 1.0; });
  EXPECT_EQ(surface.mesh->triangles.size(), slow.drawn().size());
  EXPECT_LT(surface.mesh->triangles.size(), 200u);
}

TEST(RestrictedQuadtree, OfACheckerboardDropsNothing) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(33, 33);
  for (int j = 0; j < 33; ++j) {
    for (int i = 0; i < 33; ++i) field.heights_m.floats()(i, j) = (i + j) % 2 == 0 ? 10.0f : 0.0f;
  }
  EXPECT_EQ(draw(prepare(field), Camera{}, {4.0, Unit::Metre}).mesh->triangles.size(),
            2u * 32 * 32);
}

TEST(RestrictedQuadtree, RefusesPatchesThatAreNoPowerOfTwo) {
  const terrain::Heightfield field = rough_terrain(5, 5, 1);
  EXPECT_THROW(prepare(field, {.patch_cells = 3}), std::invalid_argument);
}

TEST(RestrictedQuadtree, OfTerrainsWithoutACellIsEmpty) {
  for (const auto& [columns, rows] : {std::pair(1, 1), std::pair(1, 9), std::pair(9, 1)}) {
    const terrain::Heightfield field = rough_terrain(columns, rows, 1);
    EXPECT_TRUE(draw(prepare(field), Camera{}, {1.0, Unit::Metre}).mesh->triangles.empty());
  }
}

}  // namespace
}  // namespace plumb::mesh::restricted_quadtree
