// The numbered properties of clip_triangle, on random pairs of triangles that share an edge.
#include "raster/clip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <tuple>

#include "unit/raster/window_mesh.h"

namespace plumb::raster {
namespace {

struct Pair {
  Projection projection;
  glm::dvec3 a, b, left, right;  // relative to the eye; the triangles (a, b, left), (b, a, right)
};

Pair random_pair(unsigned seed) {
  std::mt19937 engine(seed);
  const auto between = [&engine](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine()) / 4294967296.0);
  };
  Camera camera = test::window_camera(100, 100);
  camera.centre_px = {50, 50};
  camera.gamma_h = between(50, 1e5);
  camera.gamma_v = between(50, 1e5);
  camera.near_m = 0.1;
  const double reach_m = std::pow(10.0, between(0, 5));
  const auto point = [&] {
    return glm::dvec3(between(-reach_m, reach_m), between(-reach_m, reach_m),
                      between(-reach_m, reach_m));
  };
  return {make_projection(camera, glm::dvec3(0.0)), point(), point(), point(), point()};
}

using Corner = std::tuple<std::int32_t, std::int32_t, double>;

Corner corner_of(const ScreenVertex& v) { return {v.x, v.y, v.inverse_depth}; }

// Corners of the pieces whose weight of one corner of the whole triangle is zero: on that edge.
std::set<Corner> corners_on_edge(const std::array<ClippedPiece, kMostPieces>& pieces, int count,
                                 int opposite) {
  std::set<Corner> corners;
  for (int p = 0; p < count; ++p) {
    for (std::size_t k = 0; k < 3; ++k) {
      const ClippedPiece& piece = pieces[static_cast<std::size_t>(p)];
      if (piece.weights[k][opposite] == 0.0) corners.insert(corner_of(piece.corners[k]));
    }
  }
  return corners;
}

TEST(ClipProperty, CutsASharedEdgeAtTheSamePlacesForBothTriangles) {
  int cut_edges = 0;
  for (unsigned seed = 0; seed < 20000; ++seed) {
    const Pair pair = random_pair(seed);
    std::array<ClippedPiece, kMostPieces> one, other;
    const int one_count = clip_triangle(pair.projection, {pair.a, pair.b, pair.left}, one);
    const int other_count = clip_triangle(pair.projection, {pair.right, pair.b, pair.a}, other);
    const std::set<Corner> along_one = corners_on_edge(one, one_count, 2);
    const std::set<Corner> along_other = corners_on_edge(other, other_count, 0);
    // Where a triangle keeps a corner of the edge only, its neighbour may drop a piece of no area.
    if (along_one.size() < 2 || along_other.size() < 2) continue;
    ASSERT_EQ(along_one, along_other) << seed;
    ++cut_edges;
  }
  EXPECT_GT(cut_edges, 5000);
}

TEST(ClipProperty, KeepsWhatNoPlaneCutsOffAndStaysBeyondTheNearPlane) {
  int kept = 0, on_near = 0;
  for (unsigned seed = 0; seed < 20000; ++seed) {
    const Pair pair = random_pair(seed);
    const std::vector<glm::dvec3> vertices{pair.a, pair.b, pair.left};
    const ScreenVertices window = transform(pair.projection, vertices);
    std::array<ClippedPiece, kMostPieces> pieces;
    const int count = clip_triangle(pair.projection, {pair.a, pair.b, pair.left}, pieces);
    ASSERT_LE(count, kMostPieces);
    std::set<Corner> corners;
    for (int p = 0; p < count; ++p) {
      for (std::size_t k = 0; k < 3; ++k) {
        const ClippedPiece& piece = pieces[static_cast<std::size_t>(p)];
        corners.insert(corner_of(piece.corners[k]));
        const glm::dvec3& w = piece.weights[k];
        ASSERT_LE(piece.corners[k].inverse_depth, 1.0 / pair.projection.camera.near_m) << seed;
        on_near += piece.corners[k].inverse_depth == 1.0 / pair.projection.camera.near_m;
        // Eight interpolations of numbers up to one, two roundings each.
        ASSERT_NEAR(w.x + w.y + w.z, 1.0, 16 * 3 * 1.2e-16);
        ASSERT_GE(std::min({w.x, w.y, w.z}), 0.0);
      }
    }
    for (const ScreenVertex& vertex : window) {
      if (vertex.x == kClipped || count == 0) continue;
      ++kept;
      ASSERT_EQ(corners.count(corner_of(vertex)), 1u) << seed;
    }
  }
  EXPECT_GT(kept, 5000);
  EXPECT_GT(on_near, 5000);
}

// Pieces of a fan that run the same way do not overlap; thin triangles, once cut and snapped, are
// where they may not.
TEST(ClipProperty, PiecesOfATriangleAllRunTheSameWay) {
  int several = 0;
  for (unsigned seed = 0; seed < 40000; ++seed) {
    Pair pair = random_pair(seed);
    pair.left = pair.a + pair.left * std::pow(10.0, -static_cast<double>(seed % 12));
    std::array<ClippedPiece, kMostPieces> pieces;
    const int count = clip_triangle(pair.projection, {pair.a, pair.b, pair.left}, pieces);
    int clockwise = 0;
    for (int p = 0; p < count; ++p) {
      const std::array<ScreenVertex, 3>& corner = pieces[static_cast<std::size_t>(p)].corners;
      const std::int64_t area = doubled_area(corner[0], corner[1], corner[2]);
      ASSERT_NE(area, 0);
      clockwise += area > 0;
    }
    ASSERT_TRUE(clockwise == 0 || clockwise == count) << seed;
    several += count > 1;
  }
  EXPECT_GT(several, 5000);
}

}  // namespace
}  // namespace plumb::raster
