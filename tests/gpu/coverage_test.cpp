// Which pixels a triangle covers: our rasteriser and Mesa's, given the same window coordinates.
#include <gtest/gtest.h>

#include <cstdio>

#include "raster/rasteriser.h"
#include "raster/vertex_stage.h"
#include "support/random_scene.h"
#include "support/software_gl.h"
#include "terrain/camera_presets.h"
#include "terrain/terrain_source.h"

namespace plumb::raster {
namespace {

using test_support::Random;
using test_support::SoftwareGl;
using test_support::WindowCorner;

constexpr int kSize = 1024;  // a power of two: pixels to clip space and back is exact in float

// A triangle in subpixels, which float and double hold exactly.
struct SnappedTriangle {
  std::array<std::int32_t, 3> x, y;
};

// A camera for which (x, y) px at depth w is the point (x * w, w, -y * w).
Camera window_camera() {
  Camera camera;
  camera.width_px = camera.height_px = kSize;
  camera.gamma_h = camera.gamma_v = 1.0;
  camera.centre_px = {0.0, 0.0};
  camera.near_m = 0.125;
  return camera;
}

// Each triangle a little nearer than the one before: the last one wins, as without a depth test.
std::vector<std::uint32_t> drawn_by_us(const std::vector<SnappedTriangle>& triangles) {
  TriangleMesh mesh;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const double depth = 2.0 - static_cast<double>(k) / static_cast<double>(triangles.size());
    for (std::size_t c = 0; c < 3; ++c) {
      mesh.vertices_m.emplace_back(triangles[k].x[c] / 256.0 * depth, depth,
                                   -triangles[k].y[c] / 256.0 * depth);
    }
    const auto first = static_cast<std::uint32_t>(3 * k);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const HitImage image = rasterise(mesh, window_camera()).image;
  std::vector<std::uint32_t> ids;
  for (const std::uint32_t primitive : image.primitive) ids.push_back(primitive + 1);  // none: 0
  return ids;
}

std::vector<std::uint32_t> drawn_by_mesa(SoftwareGl& gl,
                                         const std::vector<SnappedTriangle>& triangles) {
  std::vector<WindowCorner> corners;
  std::vector<std::uint32_t> indices;
  for (const SnappedTriangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      indices.push_back(static_cast<std::uint32_t>(corners.size()));
      corners.push_back(
          {static_cast<float>(t.x[c]) / 256.0f, static_cast<float>(t.y[c]) / 256.0f, 0.5f});
    }
  }
  gl.load(corners, indices);
  return gl.draw(kSize, kSize, false);
}

std::size_t differing(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) count += a[k] != b[k] ? 1 : 0;
  return count;
}

class CoverageBesideMesa : public testing::Test {
 protected:
  void SetUp() override {
    std::string why_not;
    gl_ = SoftwareGl::create(why_not);
    if (!gl_) GTEST_SKIP() << why_not;
  }
  void expect_equal(const std::vector<SnappedTriangle>& triangles, const char* what) {
    const std::vector<std::uint32_t> ours = drawn_by_us(triangles);
    const std::vector<std::uint32_t> theirs = drawn_by_mesa(*gl_, triangles);
    std::size_t covered = 0;
    for (const std::uint32_t id : ours) covered += id != 0 ? 1 : 0;
    EXPECT_GT(covered, 1000u) << what;
    EXPECT_EQ(differing(ours, theirs), 0u) << what << ", " << gl_->renderer();
    std::printf("%s: %zu triangles, %zu pixels covered, %zu differ\n", what, triangles.size(),
                covered, differing(ours, theirs));
  }
  std::unique_ptr<SoftwareGl> gl_;
};

// Corners on the subpixel grid, some exactly on pixel centres and on whole pixels.
std::vector<SnappedTriangle> random_triangles(std::uint64_t seed, int count, int size) {
  Random random(seed);
  std::vector<SnappedTriangle> triangles;
  for (int k = 0; k < count; ++k) {
    const int grid = random.chance(0.3) ? 128 : random.chance(0.2) ? 256 : 1;
    const int x = random.integer(0, kSize * 256), y = random.integer(0, kSize * 256);
    SnappedTriangle t{};
    for (std::size_t c = 0; c < 3; ++c) {
      t.x[c] = (x + random.integer(-size, size)) / grid * grid;
      t.y[c] = (y + random.integer(-size, size)) / grid * grid;
      // Within the window: what is cut off is a question of its own.
      t.x[c] = std::clamp(t.x[c], 0, kSize * 256);
      t.y[c] = std::clamp(t.y[c], 0, kSize * 256);
    }
    triangles.push_back(t);
  }
  return triangles;
}

TEST_F(CoverageBesideMesa, IsEqualOnLargeTriangles) {
  expect_equal(random_triangles(1, 3000, 40000), "large");
}
TEST_F(CoverageBesideMesa, IsEqualOnSmallTriangles) {
  expect_equal(random_triangles(2, 300000, 500), "three pixels");
}
TEST_F(CoverageBesideMesa, IsEqualOnTinyTriangles) {
  expect_equal(random_triangles(3, 400000, 150), "less than a pixel");
}

// A terrain as a preset sees it: every triangle within the window, from far to near.
TEST_F(CoverageBesideMesa, IsEqualOnTerrain) {
  for (const char* preset : {"oblique", "valley", "top"}) {
    const terrain::Heightfield field = terrain::load_terrain("generate:alpine?size=513");
    const Camera camera = make_camera(terrain::preset_camera(field, preset, kSize, kSize, 50.0));
    const Projection projection = make_projection(camera, field.world_origin_m());
    std::vector<std::pair<double, SnappedTriangle>> by_depth;
    const auto add = [&](std::array<std::array<int, 2>, 3> samples) {
      SnappedTriangle t{};
      double depth = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto [i, j] = samples[c];
        const glm::dvec3 point{i * field.dx_m, j * field.dy_m, field.heights_m(i, j)};
        const glm::dvec3 view = projection.view(projection.from_eye(point));
        if (projection.outcode(view) != 0) return;
        const ScreenVertex vertex = projection.to_window(view);
        if (vertex.x < 0 || vertex.y < 0 || vertex.x > kSize * 256 || vertex.y > kSize * 256)
          return;
        t.x[c] = vertex.x;
        t.y[c] = vertex.y;
        depth += view.z;
      }
      by_depth.emplace_back(depth, t);
    };
    for (int j = 0; j + 1 < field.rows(); ++j) {
      for (int i = 0; i + 1 < field.columns(); ++i) {
        add({{{i, j}, {i + 1, j}, {i, j + 1}}});
        add({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
      }
    }
    std::stable_sort(by_depth.begin(), by_depth.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<SnappedTriangle> triangles;
    for (const auto& [depth, triangle] : by_depth) triangles.push_back(triangle);
    expect_equal(triangles, preset);
  }
}

}  // namespace
}  // namespace plumb::raster
