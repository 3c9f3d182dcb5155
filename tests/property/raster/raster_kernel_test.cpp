// The rasteriser's kernels for every instruction set: the bits of the plain functions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/instruction_set.h"
#include "raster/rasteriser.h"
#include "raster/triangle_filter.h"
#include "raster/vertex_stage.h"
#include "support/random_scene.h"

namespace plumb::raster {
namespace {

using test_support::Random;

bool operator==(const ScreenVertex& a, const ScreenVertex& b) {
  return a.x == b.x && a.y == b.y && a.inverse_depth == b.inverse_depth;
}

Camera random_view(Random& random) {
  LookAt look;
  look.eye_m = {random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0), random.uniform(0.0, 9.0)};
  look.target_m = {random.uniform(-9.0, 9.0), 30.0, random.uniform(-9.0, 9.0)};
  look.width_px = random.integer(1, 4000);
  look.height_px = random.integer(1, 4000);
  look.near_m = 0.5;
  return make_camera(look);
}

// Vertices in front of the eye, beside it, behind it, far outside the guard band; an odd number, so
// that the last ones do not fill a vector.
TEST(VertexKernel, HasTheBitsOfTheProjection) {
  Random random(31);
  for (int round = 0; round < 200; ++round) {
    const Projection projection = make_projection(random_view(random), {3.5, -2.25, 0.125});
    const double reach = std::pow(10.0, random.uniform(0.0, 6.0));
    std::vector<glm::dvec3> vertices(static_cast<std::size_t>(random.integer(1, 300)));
    for (glm::dvec3& v : vertices) {
      const double x = random.uniform(-reach, reach), y = random.uniform(-reach, reach);
      v = {x, y, random.uniform(-9.0, 9.0)};
    }
    for (const InstructionSet set : available_instruction_sets()) {
      const ForcedInstructionSet forced(set);
      const ScreenVertices window = transform(projection, vertices);
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        const glm::dvec3 view = projection.view(projection.from_eye(vertices[k]));
        const unsigned code = projection.outcode(view);
        const ScreenVertex expected =
            code == 0 ? projection.to_window(view)
                      : ScreenVertex{kClipped, static_cast<std::int32_t>(code), 0.0};
        ASSERT_TRUE(window[k] == expected) << name_of(set) << ", vertex " << k;
      }
    }
  }
}

TEST(VertexKernel, RefusesWhatIsNotFiniteInAnyLane) {
  const Projection projection = make_projection(Camera{}, {0, 0, 0});
  for (const InstructionSet set : available_instruction_sets()) {
    const ForcedInstructionSet forced(set);
    for (std::size_t at = 0; at < 11; ++at) {
      std::vector<glm::dvec3> vertices(11, glm::dvec3(1.0));
      vertices[at].y = std::numeric_limits<double>::quiet_NaN();
      EXPECT_THROW(transform(projection, vertices), std::invalid_argument) << name_of(set) << at;
      vertices[at].y = 1e31;
      EXPECT_THROW(transform(projection, vertices), std::invalid_argument) << name_of(set) << at;
    }
  }
}

ScreenVertex random_corner(Random& random, int around_x, int around_y) {
  if (random.chance(0.1)) return {kClipped, random.integer(1, 31), 0.0};
  const int reach = random.chance(0.2) ? 3000 : 130;  // subpixels
  const int x = around_x + random.integer(-reach, reach);
  return {x, around_y + random.integer(-reach, reach), 1.0};
}

// What the filter's header says, one triangle at a time.
bool should_keep(const TriangleFilter& filter, const ScreenVertex& a, const ScreenVertex& b,
                 const ScreenVertex& c) {
  const unsigned common = outcode_of(a) & outcode_of(b) & outcode_of(c);
  if (a.x == kClipped || b.x == kClipped || c.x == kClipped) return common == 0;
  const PixelBox window{0, 0, filter.last_column, filter.last_row};
  const PixelBox box = pixel_box(a, b, c);
  if (common_part(box, window).empty()) return false;
  if (!box.holds_one_pixel()) return true;
  const EdgeFunctions edges = edge_functions({a, b, c});
  const auto outside = [&](int i) { return edges.biased(i, box.x0, box.y0) + edges.bias[i] < 0; };
  return !(outside(0) || outside(1) || outside(2));
}

TEST(TriangleFilter, KeepsExactlyWhatMayCoverAPixel) {
  Random random(32);
  for (int round = 0; round < 200; ++round) {
    const int count = random.integer(1, 70);
    std::vector<ScreenVertex> vertices;
    std::vector<std::uint32_t> corners;
    for (int k = 0; k < count; ++k) {
      const int x = random.integer(-2000, 20000), y = random.integer(-2000, 20000);
      for (int corner = 0; corner < 3; ++corner) {
        corners.push_back(static_cast<std::uint32_t>(vertices.size()));
        vertices.push_back(random_corner(random, x, y));
      }
      if (random.chance(0.1)) vertices.back() = vertices[vertices.size() - 3];  // no area
    }
    const TriangleFilter filter{vertices.data(), vertices.size(), kClipped, random.integer(0, 70),
                                random.integer(0, 70)};
    std::vector<std::uint32_t> expected;
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(count); ++k) {
      if (should_keep(filter, vertices[3 * k], vertices[3 * k + 1], vertices[3 * k + 2]))
        expected.push_back(k);
    }
    for (const InstructionSet set : available_instruction_sets()) {
      std::vector<std::uint32_t> kept(static_cast<std::size_t>(count) + 8);
      kept.resize(filter_triangles(set)(filter, corners.data(), static_cast<std::uint32_t>(count),
                                        kept.data()));
      EXPECT_EQ(kept, expected) << name_of(set) << ", round " << round;
    }
  }
}

TEST(TriangleFilter, RefusesAnIndexOutOfRangeWhereverItStands) {
  const std::vector<ScreenVertex> vertices(5, ScreenVertex{0, 0, 1.0});
  const TriangleFilter filter{vertices.data(), vertices.size(), kClipped, 9, 9};
  for (const InstructionSet set : available_instruction_sets()) {
    std::vector<std::uint32_t> kept(11 + 8);
    for (std::size_t at = 0; at < 33; ++at) {
      std::vector<std::uint32_t> corners(33, 4);
      EXPECT_EQ(filter_triangles(set)(filter, corners.data(), 11, kept.data()), 0u);
      for (const std::uint32_t bad : {5u, 0x80000000u, 0xffffffffu}) {
        corners[at] = bad;
        EXPECT_EQ(filter_triangles(set)(filter, corners.data(), 11, kept.data()), kBadIndex)
            << name_of(set) << ", index " << at;
      }
    }
  }
}

TEST(Rasteriser, GivesTheSameBitsWithEveryInstructionSet) {
  Random random(33);
  TriangleMesh mesh;
  for (int k = 0; k < 3000; ++k) {
    const glm::dvec3 at{random.uniform(-60.0, 60.0), random.uniform(-20.0, 90.0),
                        random.uniform(-9.0, 9.0)};
    for (int corner = 0; corner < 3; ++corner) {
      const double x = random.uniform(-2.0, 2.0), y = random.uniform(-2.0, 2.0);
      mesh.vertices_m.push_back(at + glm::dvec3(x, y, random.uniform(-2.0, 2.0)));
    }
    const auto first = static_cast<std::uint32_t>(3 * k);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  LookAt look;
  look.eye_m = {0.0, -5.0, 3.0};
  look.target_m = {0.0, 30.0, 0.0};
  look.width_px = 301;
  look.height_px = 200;
  const Camera camera = make_camera(look);
  HitImage first;
  for (const InstructionSet set : available_instruction_sets()) {
    const ForcedInstructionSet forced(set);
    const HitImage image = rasterise(mesh, camera).image;
    if (first.size() == 0) first = image;
    EXPECT_EQ(image.depth_m, first.depth_m) << name_of(set);
    EXPECT_EQ(image.from_eye_m, first.from_eye_m) << name_of(set);
    EXPECT_EQ(image.primitive, first.primitive) << name_of(set);
    EXPECT_EQ(image.overdraw, first.overdraw) << name_of(set);
  }
}

}  // namespace
}  // namespace plumb::raster
