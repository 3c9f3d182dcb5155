// Polygons cut into triangles, vertices at one place joined.
#include "terrain/polygon_soup.h"

#include <cmath>
#include <numeric>

#include "core/check.h"
#include "written_files.h"

namespace plumb::terrain {
namespace {

using Points = std::vector<glm::dvec3>;

std::vector<Triangle> cut(const Points& points) {
  std::vector<std::uint32_t> corners(points.size());
  std::iota(corners.begin(), corners.end(), 0u);
  std::vector<Triangle> triangles;
  triangulate(corners, points, triangles);
  return triangles;
}

double area_m2(const Points& points, const Triangle& t) {
  return 0.5 * area_normal(points[t[0]], points[t[1]], points[t[2]]).z;
}

// Every triangle turns as the polygon does, and together they have its area: nothing overlaps.
void expect_tiles(const Points& points, double area) {
  const std::vector<Triangle> triangles = cut(points);
  EXPECT_EQ(triangles.size(), points.size() - 2);
  double sum = 0.0;
  for (const Triangle& t : triangles) {
    EXPECT_GT(area_m2(points, t), 0.0);
    sum += area_m2(points, t);
  }
  EXPECT_EQ(sum, area);  // halves of whole numbers
}

TEST(Polygon, OfOneTurnBecomesAFanAroundItsFirstCorner) {
  EXPECT_EQ(cut({{0, 0, 0}, {2, 0, 0}, {3, 1, 5}, {2, 2, 0}, {0, 2, 0}}),
            (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

// An arrowhead whose notch is each of its corners in turn.
TEST(Polygon, IsCutAtItsNotch) {
  Points arrow{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
  for (int k = 0; k < 4; ++k) {
    expect_tiles(arrow, 4.0);
    std::rotate(arrow.begin(), arrow.begin() + 1, arrow.end());
  }
}

TEST(Polygon, LosesEarsThatHoldNoOtherCorner) {
  expect_tiles(
      {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {4, 6, 0}, {4, 2, 0}, {2, 2, 0}, {2, 6, 0}, {0, 6, 0}},
      28.0);
}

// Corner 1 lies on the side from 0 to 2: a fan around 0 would begin with no area.
TEST(Polygon, WithACornerOnASideHasNoTriangleWithoutArea) {
  expect_tiles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 4.0);
}

TEST(Polygon, OnAWallIsSeenFromItsOwnSide) {
  const Points wall{{0, 0, 0}, {0, 4, 0}, {0, 1, 1}, {0, 0, 4}};  // an arrowhead, upright
  for (const Triangle& t : cut(wall))
    EXPECT_GT(area_normal(wall[t[0]], wall[t[1]], wall[t[2]]).x, 0.0);
}

TEST(Polygon, WithoutAnEarIsAFanAllTheSame) {
  EXPECT_EQ(cut({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).size(), 2u);
  EXPECT_EQ(cut({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}).size(), 2u);
}

// A zigzag of 1001 corners and more is refused, a circle is not.
TEST(Polygon, MayHaveManyCornersIfItIsConvex) {
  Points comb{{0, -1, 0}};
  for (int k = 0; k < 1001; ++k) comb.emplace_back(1001 - k, k % 2, 0);
  EXPECT_THROW(cut(comb), std::invalid_argument);
  PolygonSoup soup{comb, {0, 1, 2}, {3}};
  for (std::uint32_t k = 0; k < comb.size(); ++k) soup.corners.push_back(k);
  soup.sizes.push_back(static_cast<std::uint32_t>(comb.size()));
  EXPECT_NE(input_error_of([&] {
              joined_mesh(soup, "mesh 'a'");
            }).find("mesh 'a': face 2, counted from 1: a polygon that is not convex"),
            std::string::npos);
  Points circle;
  for (int k = 0; k < 2000; ++k) circle.emplace_back(std::cos(k * 3e-3), std::sin(k * 3e-3), 0);
  EXPECT_EQ(cut(circle).size(), 1998u);
}

TEST(Polygon, HasThreeCornersAtLeast) {
  EXPECT_THROW(cut({{0, 0, 0}, {1, 0, 0}}), std::invalid_argument);
}

TEST(PolygonSoup, BecomesAMeshThatSharesItsVertices) {
  const TriangleMesh mesh = joined_mesh(
      {{{5, 5, 5}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0, 0, -0.0}, {1, 1, 0}, {0, 1, 0}},
       {1, 2, 3, 0, 4, 5, 6},
       {3, 1, 3}},
      "mesh");
  EXPECT_EQ(mesh.vertices_m, (Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

// A grid of 300 x 300 places, each named by up to four quads of their own.
TEST(PolygonSoup, JoinsManyPlaces) {
  PolygonSoup soup;
  for (int j = 0; j < 299; ++j) {
    for (int i = 0; i < 299; ++i) {
      for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        soup.corners.push_back(static_cast<std::uint32_t>(soup.vertices_m.size()));
        soup.vertices_m.emplace_back(5e5 + 0.1 * (i + di), 4.5e6 + 0.1 * (j + dj), i + di);
      }
      soup.sizes.push_back(4);
    }
  }
  const TriangleMesh mesh = joined_mesh(soup, "mesh");
  EXPECT_EQ(mesh.vertices_m.size(), 300u * 300u);
  EXPECT_EQ(mesh.triangles.size(), 2u * 299u * 299u);
}

}  // namespace
}  // namespace plumb::terrain
