// What must hold for every mesh, tried on random ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <tuple>

#include "core/parallel.h"
#include "raster/rasteriser.h"
#include "unit/raster/window_mesh.h"

namespace plumb::raster {
namespace {

// The same numbers from the same seed on every machine; the library's distributions are not.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }

 private:
  std::mt19937 engine_;
};

TriangleMesh random_triangles(Random& random, int count, double reach_px) {
  TriangleMesh mesh;
  for (int k = 0; k < 3 * count; ++k) {
    mesh.vertices_m.push_back(test::world({random.between(-reach_px, 32 + reach_px),
                                           random.between(-reach_px, 32 + reach_px),
                                           std::pow(10.0, random.between(-0.5, 3))}));
  }
  for (std::uint32_t k = 0; k + 2 < mesh.vertices_m.size(); k += 3) {
    mesh.triangles.push_back({k, k + 1, k + 2});
  }
  return mesh;
}

// A grid in the window from -2 to 34 px whose inner vertices are moved by up to a quarter of a cell
// along each axis: no triangle turns over.
TriangleMesh jittered_grid(Random& random, int cells, double step_px) {
  TriangleMesh mesh;
  const double size_px = 36.0 / cells;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const bool border = i == 0 || j == 0 || i == cells || j == cells;
      double x = -2 + i * size_px, y = -2 + j * size_px;
      if (!border) {
        x += random.between(-0.25, 0.25) * size_px;
        y += random.between(-0.25, 0.25) * size_px;
      }
      x = std::round(x / step_px) * step_px;  // coarse steps put edges through pixel centres
      y = std::round(y / step_px) * step_px;
      mesh.vertices_m.push_back(test::world({x, y, random.between(1.0, 9.0)}));
    }
  }
  const auto vertex = [cells](int i, int j) {
    return static_cast<std::uint32_t>(j * (cells + 1) + i);
  };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                          d = vertex(i, j + 1);
      if (random.between(0, 1) < 0.5) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, d, c});  // the other way round on purpose
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  }
  return mesh;
}

TEST(RasteriserProperty, AWatertightGridCoversEveryPixelExactlyOnce) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const int cells = 1 + static_cast<int>(seed % 23);
    // Vertices at pixel centres and corners, at subpixels, and anywhere.
    const double step_px = seed % 3 == 0 ? 0.5 : seed % 3 == 1 ? 1.0 / 256 : 1e-6;
    if (step_px == 0.5 && cells > 9) continue;  // rounding to half pixels would fold small cells
    const TriangleMesh mesh = jittered_grid(random, cells, step_px);
    const RasterResult result = rasterise(mesh, test::window_camera(32, 32));
    for (std::size_t pixel = 0; pixel < result.image.size(); ++pixel) {
      ASSERT_EQ(result.image.overdraw[pixel], 1) << "seed " << seed << ", pixel " << pixel;
    }
    ASSERT_EQ(result.fragments, 32 * 32);
  }
}

// The fill rule said another way: a triangle covers a pixel if the pixel's centre, moved right by
// an infinitely small length and down by one infinitely smaller still, lies strictly inside.
bool covers(const std::array<ScreenVertex, 3>& corner, int x, int y) {
  int positive = 0, negative = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex &a = corner[i], &b = corner[(i + 1) % 3];
    const __int128 dx = b.x - a.x, dy = b.y - a.y;
    const __int128 side = dx * (256 * y + 128 - a.y) - dy * (256 * x + 128 - a.x);
    const auto value = std::make_tuple(side, -dy, dx);  // and its changes to the right and down
    const auto zero = std::make_tuple(__int128{0}, __int128{0}, __int128{0});
    positive += value > zero;
    negative += value < zero;
  }
  return positive == 3 || negative == 3;
}

TEST(RasteriserProperty, CoversWhatTheFillRuleSays) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    Random random(1000 + seed);
    const double reach_px = seed % 4 == 0 ? 1e5 : seed % 4 == 1 ? 100 : 0;
    TriangleMesh mesh = random_triangles(random, 1, reach_px);
    if (seed % 2 == 0) {  // many centres exactly on edges
      for (glm::dvec3& v : mesh.vertices_m) {
        const double w = v.y;
        v = test::world({std::floor(v.x / w) + 0.5, std::floor(-v.z / w) + 0.5, 1.0});
      }
    }
    const Camera camera = test::window_camera(32, 32);
    const Geometry geometry = make_geometry(mesh, camera, {});
    const HitImage image = rasterise(mesh, camera, {.tile_px = 8}).image;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        ASSERT_EQ(image.hit(image.index(x, y)),
                  covers({geometry.vertices[0], geometry.vertices[1], geometry.vertices[2]}, x, y))
            << "seed " << seed << ", pixel " << x << ", " << y;
      }
    }
  }
}

// Property (2) of rasterise, on triangles that reach behind the eye and out of the guard band too.
TEST(RasteriserProperty, HitsLieOnTheirTriangleAndProjectIntoTheMiddleOfTheirPixel) {
  int hits = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    Random random(2000 + seed);
    TriangleMesh mesh;
    const double reach_m = std::pow(10.0, random.between(0.5, 5));
    mesh.origin_m = {random.between(-1e5, 1e5), random.between(-1e5, 1e5), 0};
    for (int k = 0; k < 30; ++k) {
      mesh.vertices_m.push_back({random.between(-reach_m, reach_m),
                                 random.between(-reach_m, reach_m), random.between(-10, 10)});
    }
    for (std::uint32_t k = 0; k < 30; k += 3) mesh.triangles.push_back({k, k + 1, k + 2});
    Camera camera = make_camera(
        {.eye_m = mesh.origin_m + glm::dvec3(0, 0, random.between(-9, 20)),
         .target_m = mesh.origin_m + glm::dvec3(random.between(-9, 9), 30, random.between(-9, 9)),
         .fov_y_deg = 70,
         .width_px = 40,
         .height_px = 30});
    camera.near_m = 0.5;
    const HitImage image = rasterise(mesh, camera).image;
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        const std::size_t pixel = image.index(x, y);
        if (!image.hit(pixel)) continue;
        ++hits;
        const glm::dvec3 p = image.from_eye_m[pixel];
        const glm::dvec3 view{glm::dot(p, camera.right), glm::dot(p, camera.up),
                              glm::dot(p, camera.forward)};
        const double depth_m = image.depth_m[pixel];
        // Roundings: corners of length up to 1.5e5 m enter a sum that may be as small as the near
        // depth; each weight is a few roundings off, 1e-15.
        const double rounding_m = 1e-15 * (1.5 * reach_m + 20) * 4;
        ASSERT_NEAR(view.z, depth_m, rounding_m + depth_m * 1e-15 * (1 + reach_m)) << seed;
        ASSERT_GE(depth_m, camera.near_m * (1 - 1e-12));
        // Snapping moves each corner by at most 1/512 px; the point is their convex combination.
        const double allowed_px = 1.0 / 512 + 2 * camera.gamma_h * rounding_m / view.z + 1e-9;
        const glm::dvec2 seen = view_to_pixel(camera, view);
        ASSERT_NEAR(seen.x, x + 0.5, allowed_px) << seed;
        ASSERT_NEAR(seen.y, y + 0.5, allowed_px) << seed;
        const Triangle& triangle = mesh.triangles[image.primitive[pixel]];
        const glm::dvec3 offset = mesh.origin_m - camera.eye_m;
        const glm::dvec3 a = mesh.vertices_m[triangle[0]] + offset,
                         b = mesh.vertices_m[triangle[1]] + offset,
                         c = mesh.vertices_m[triangle[2]] + offset;
        const glm::dvec3 normal = glm::normalize(area_normal(a, b, c));
        ASSERT_NEAR(glm::dot(p - a, normal), 0.0, rounding_m) << seed;
      }
    }
  }
  EXPECT_GT(hits, 30000);
}

// Triangles around a point of a plane that reach up to 1e7 m in every direction, below, behind and
// before the eye: cut at the near plane and the guard band, still each pixel has one owner.
TEST(RasteriserProperty, AClippedFanCoversThePlaneExactlyOnce) {
  int below = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    Random random(3000 + seed);
    const Camera camera =
        make_camera({.eye_m = {0, 0, std::pow(10.0, random.between(-0.9, 2))},
                     .target_m = {random.between(-1, 1), 3, random.between(-5, 2)},
                     .fov_y_deg = random.between(20, 120),
                     .width_px = 48,
                     .height_px = 36});
    TriangleMesh mesh;
    const int spokes = 4 + static_cast<int>(seed % 6);
    mesh.vertices_m.push_back({random.between(-2, 2), random.between(-2, 6), 0});
    for (int k = 0; k < spokes; ++k) {  // directions by a square's outline: no trigonometry
      const double along = (k + random.between(0.1, 0.9)) / spokes * 8.0 - 4.0;
      const glm::dvec2 way = along < -2  ? glm::dvec2(-1, -3 - along)
                             : along < 0 ? glm::dvec2(along + 1, -1)
                             : along < 2 ? glm::dvec2(1, along - 1)
                                         : glm::dvec2(3 - along, 1);
      mesh.vertices_m.push_back(glm::dvec3(way * 1e7, 0) + mesh.vertices_m[0]);
      const auto next = static_cast<std::uint32_t>((k + 1) % spokes + 1);
      mesh.triangles.push_back({0, static_cast<std::uint32_t>(k + 1), next});
    }
    const RasterResult result = rasterise(mesh, camera, {.tile_px = 16});
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const glm::dvec3 ray = ray_direction(camera, x + 0.5, y + 0.5);
        const int overdraw = result.image.overdraw[result.image.index(x, y)];
        const double to_ground = -camera.eye_m.z / ray.z;  // view depth, negative above the horizon
        if (std::abs(to_ground) > 1e6) continue;           // the fan's rim lies at the horizon
        const bool sees_ground = to_ground > 0;
        if (sees_ground && std::abs(to_ground / camera.near_m - 1) < 0.05) continue;
        below += sees_ground;
        ASSERT_EQ(overdraw, sees_ground && to_ground > camera.near_m ? 1 : 0)
            << "seed " << seed << ", pixel " << x << ", " << y;
      }
    }
  }
  EXPECT_GT(below, 100000);
}

// Cut thin triangles leave polygons whose corners, once snapped, lie almost on one line.
TEST(RasteriserProperty, NoTwoPiecesOfATriangleCoverTheSamePixel) {
  std::int64_t fragments = 0;
  for (unsigned seed = 0; seed < 20000; ++seed) {
    Random random(4000 + seed);
    const double reach_m = std::pow(10.0, random.between(0, 8));
    const double thickness_m = std::pow(10.0, random.between(-6, 2));
    TriangleMesh mesh;
    const auto point = [&](double reach) {
      return glm::dvec3(random.between(-reach, reach), random.between(-reach, reach),
                        random.between(-reach, reach));
    };
    mesh.vertices_m = {point(reach_m), point(reach_m), {}};
    mesh.vertices_m[2] = mesh.vertices_m[seed % 2] + point(thickness_m);
    mesh.triangles = {{0, 1, 2}};
    Camera camera = test::window_camera(24, 24);
    camera.centre_px = {12, 12};
    camera.gamma_h = camera.gamma_v = seed % 3 == 0 ? 12 : 1e5;
    const RasterResult result = rasterise(mesh, camera, {.tile_px = 24});
    for (const std::uint16_t overdraw : result.image.overdraw) ASSERT_LE(overdraw, 1) << seed;
    fragments += result.fragments;
  }
  EXPECT_GT(fragments, 10000);
}

// A bumpy ground with slivers, cuts and overdraw.
TriangleMesh rough_ground(int cells) {
  Random random(7);
  TriangleMesh mesh;
  mesh.origin_m = {4.5e5, 5.1e6, 300};
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      mesh.vertices_m.push_back({i * 2.0 - cells, j * 2.0 - cells, random.between(-3, 3)});
    }
  }
  const auto row = static_cast<std::uint32_t>(cells + 1);
  for (std::uint32_t j = 0; j + 1 < row; ++j) {
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = j * row + i;
      mesh.triangles.push_back({a, a + 1, a + row});
      mesh.triangles.push_back({a + 1, a + row + 1, a + row});
    }
  }
  return mesh;
}

TEST(RasteriserProperty, GivesTheSameBitsOnAnyNumberOfThreadsAndForAnyTilesAndChunks) {
  const TriangleMesh mesh = rough_ground(150);
  const Camera camera = make_camera({.eye_m = mesh.origin_m + glm::dvec3(3, -140, 4),
                                     .target_m = mesh.origin_m,
                                     .width_px = 333,
                                     .height_px = 177});
  const RasterResult first = rasterise(mesh, camera);
  EXPECT_GT(first.fragments, 333 * 177 / 2);
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    for (const RasterOptions& options :
         {RasterOptions{}, RasterOptions{.tile_px = 13}, RasterOptions{.tile_px = 4096},
          RasterOptions{.tile_px = 32, .chunk_triangles = 997}}) {
      const RasterResult again = rasterise(mesh, camera, options);
      EXPECT_EQ(test::checksum(again.image), test::checksum(first.image));
      EXPECT_EQ(again.fragments, first.fragments);
    }
  }
}

// Cameras in the ground, above and beside it, looking anywhere; a camera that sees nothing too.
TEST(RasteriserProperty, GivesTheSameBitsWithRunsOutOfViewLeftOut) {
  const auto shared = std::make_shared<const TriangleMesh>(rough_ground(200));
  const TriangleMesh& mesh = *shared;
  const MeshRuns runs(shared);
  ASSERT_EQ(runs.count(), 157u);  // 80,000 / 512, and the rest
  Random random(23);
  std::size_t left_out = 0;
  for (int round = 0; round < 200; ++round) {
    const auto place = [&](double reach, double up) {
      return mesh.origin_m + glm::dvec3(random.between(-reach, reach),
                                        random.between(-reach, reach), random.between(-up, up));
    };
    const Camera camera = make_camera({.eye_m = place(250, 20),
                                       .target_m = place(250, 40),
                                       .fov_y_deg = random.between(2, 120),
                                       .width_px = 97,
                                       .height_px = 61,
                                       .near_m = random.between(0.01, 30)});
    const std::vector<std::uint8_t> in_view = runs.in_view(camera);
    left_out += static_cast<std::size_t>(std::count(in_view.begin(), in_view.end(), 0));
    const RasterResult all = rasterise(mesh, camera);
    for (const int chunk : {0, 700}) {
      const RasterResult some = rasterise(mesh, camera, {.chunk_triangles = chunk, .runs = &runs});
      ASSERT_EQ(test::checksum(some.image), test::checksum(all.image)) << round;
      ASSERT_EQ(some.fragments, all.fragments);
    }
  }
  EXPECT_GT(left_out, 200 * runs.count() / 4);
}

TEST(RasteriserProperty, RefusesRunsOfAnotherMesh) {
  const TriangleMesh mesh = rough_ground(20);
  const MeshRuns runs(std::make_shared<const TriangleMesh>(mesh));  // equal, and yet another
  const Camera camera = make_camera({.eye_m = mesh.origin_m + glm::dvec3(0, 0, 50),
                                     .target_m = mesh.origin_m,
                                     .width_px = 8,
                                     .height_px = 8});
  EXPECT_THROW(rasterise(mesh, camera, {.runs = &runs}), std::invalid_argument);
  auto broken = std::make_shared<TriangleMesh>(mesh);
  broken->triangles.back()[1] = 1000;
  EXPECT_THROW(MeshRuns{broken}, std::invalid_argument);
  broken = std::make_shared<TriangleMesh>(mesh);
  broken->vertices_m[7].z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MeshRuns{broken}, std::invalid_argument);
}

}  // namespace
}  // namespace plumb::raster
