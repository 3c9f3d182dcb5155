#include "reference/embree_caster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "support/brute_force_caster.h"
#include "support/hit_image_difference.h"
#include "support/random_scene.h"
#include "support/test_meshes.h"

namespace plumb::reference {
namespace {

using terrain::Diagonal;
using terrain::Heightfield;
using test_support::Random;

bool same(const HitImage& a, const HitImage& b) {
  return a.depth_m == b.depth_m && a.from_eye_m == b.from_eye_m && a.primitive == b.primitive;
}

// Two cells of 10 m, level at 5 m; the third column's cell lies beyond a void.
Heightfield level_cells() {
  Heightfield field;
  field.heights_m = Grid<float>(3, 2, 5.0f);
  field.dx_m = field.dy_m = 10.0;
  return field;
}

Ray down_at(double x, double y) { return {{x, y, 105.0}, {0.0, 0.0, -1.0}}; }

// Cell 0 rises north-east, cell 1 does not.
TEST(EmbreeCaster, NumbersTrianglesAsTheHeightfieldDoes) {
  const Heightfield field = level_cells();
  const EmbreeCaster caster(field, Diagonal::Alternating);
  EXPECT_EQ(caster.cast(down_at(7.0, 2.0)), (RayHit{100.0, 0}));
  EXPECT_EQ(caster.cast(down_at(2.0, 7.0)), (RayHit{100.0, 1}));
  EXPECT_EQ(caster.cast(down_at(12.0, 2.0)), (RayHit{100.0, 2}));
  EXPECT_EQ(caster.cast(down_at(18.0, 7.0)), (RayHit{100.0, 3}));
}

TEST(EmbreeCaster, NamesTheLowestTriangleOfAnEdgeOrCorner) {
  const Heightfield field = level_cells();
  const EmbreeCaster caster(field, Diagonal::Alternating);
  EXPECT_EQ(caster.cast(down_at(5.0, 5.0)).triangle, 0u);    // cell 0's diagonal
  EXPECT_EQ(caster.cast(down_at(10.0, 4.0)).triangle, 0u);   // between the cells
  EXPECT_EQ(caster.cast(down_at(10.0, 10.0)).triangle, 0u);  // the corner of four triangles
  EXPECT_EQ(caster.cast(down_at(20.0, 4.0)).triangle, 3u);   // the eastern border
  EXPECT_FALSE(caster.cast(down_at(20.001, 4.0)));
}

TEST(EmbreeCaster, SeesNothingWhereASampleIsVoid) {
  Heightfield field = level_cells();
  field.heights_m.floats()(2, 0) = std::nanf("");  // takes both triangles (SE, ...) of cell 1
  const EmbreeCaster caster(field, Diagonal::Alternating);
  EXPECT_FALSE(caster.cast(down_at(12.0, 2.0)));
  EXPECT_FALSE(caster.cast(down_at(18.0, 8.0)));
  EXPECT_TRUE(caster.cast(down_at(9.0, 2.0)));
  field.heights_m.floats()(2, 0) = 5.0f;
  field.heights_m.floats()(1, 0) =
      std::nanf("");  // leaves (SE, NE, NW) of cell 1 and (SW, NE, NW) of 0
  const EmbreeCaster other(field, Diagonal::Alternating);
  EXPECT_EQ(other.cast(down_at(18.0, 8.0)).triangle, 3u);
  EXPECT_FALSE(other.cast(down_at(12.0, 2.0)));
  EXPECT_EQ(other.cast(down_at(2.0, 7.0)).triangle, 1u);
  EXPECT_FALSE(other.cast(down_at(7.0, 2.0)));
}

TEST(EmbreeCaster, LooksThroughWhatLiesBeforeTheNearPlane) {
  const Heightfield field = level_cells();
  const EmbreeCaster caster(field, Diagonal::Fixed);
  Ray ray = down_at(3.0, 3.0);
  ray.t_min = 100.5;
  EXPECT_FALSE(caster.cast(ray));
  ray.t_min = 0.0;
  ray.t_max = 99.5;
  EXPECT_FALSE(caster.cast(ray));
  EXPECT_TRUE(caster.cast({{3.0, 3.0, -20.0}, {0.0, 0.0, 5.0}}));  // from below
}

TEST(EmbreeCaster, OfNothingSeesNothing) {
  Heightfield all_void = level_cells();
  for (float& height : all_void.heights_m.floats().values()) height = std::nanf("");
  Heightfield one_row;
  one_row.heights_m = Grid<float>(9, 1, 0.0f);
  const TriangleMesh no_mesh;
  EXPECT_FALSE(EmbreeCaster(all_void, Diagonal::Fixed).cast(down_at(3.0, 3.0)));
  EXPECT_FALSE(EmbreeCaster(one_row, Diagonal::Fixed).cast(down_at(3.0, 0.0)));
  EXPECT_FALSE(EmbreeCaster(no_mesh).cast(down_at(3.0, 3.0)));
}

TEST(EmbreeCaster, RefusesWhatIsNoRay) {
  const Heightfield field = level_cells();
  const EmbreeCaster caster(field, Diagonal::Fixed);
  EXPECT_THROW(caster.cast({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}), std::invalid_argument);
  EXPECT_THROW(caster.cast({{std::nan(""), 0.0, 0.0}, {0.0, 0.0, 1.0}}), std::invalid_argument);
  EXPECT_THROW(caster.cast({{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, -1.0}), std::invalid_argument);
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {std::nan(""), 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_THROW(EmbreeCaster{mesh}, std::invalid_argument);
}

struct Scene {
  Heightfield field;
  Camera camera;
};

Scene rough_scene() {
  Random random(11);
  Scene scene;
  scene.field.heights_m = Grid<float>(97, 83);
  scene.field.dx_m = 12.5;
  scene.field.dy_m = 9.0;
  scene.field.origin_m = {512345.678, 4498765.432};
  for (float& height : scene.field.heights_m.floats().values()) {
    height = random.chance(0.03) ? std::nanf("") : static_cast<float>(random.uniform(0.0, 40.0));
  }
  scene.camera =
      test_support::random_camera(random, scene.field, test_support::View::Oblique, 160, 120);
  return scene;
}

TEST(EmbreeCaster, GivesTheSameBitsOnEveryInstructionSetAndNumberOfThreads) {
  const Scene scene = rough_scene();
  const HitImage expected = EmbreeCaster(scene.field, Diagonal::Blocks8).cast_frame(scene.camera);
  for (const char* instructions : {"sse2", "sse4.2", "avx", "avx2", "avx512"}) {
    const EmbreeCaster caster(scene.field, Diagonal::Blocks8, {.instruction_set = instructions});
    EXPECT_TRUE(same(caster.cast_frame(scene.camera), expected)) << instructions;
  }
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    const EmbreeCaster caster(scene.field, Diagonal::Blocks8);
    EXPECT_TRUE(same(caster.cast_frame(scene.camera), expected)) << threads;
  }
}

TEST(EmbreeCaster, CountsItsProposals) {
  const Scene scene = rough_scene();
  const EmbreeCaster caster(scene.field, Diagonal::Fixed);
  CastStatistics statistics;
  const HitImage image = caster.cast_frame(scene.camera, &statistics);
  std::int64_t hits = 0;
  for (std::size_t k = 0; k < image.size(); ++k) hits += image.hit(k);
  EXPECT_EQ(statistics.rays, 160 * 120);
  EXPECT_EQ(statistics.hits, hits);
  EXPECT_GE(statistics.proposals - statistics.refused, hits);
}

TEST(EmbreeCaster, CastsManyRaysAsItCastsOne) {
  const Scene scene = rough_scene();
  const EmbreeCaster caster(scene.field, Diagonal::Fixed);
  const HitImage image = caster.cast_frame(scene.camera);
  std::vector<Ray> rays;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      rays.push_back(caster.camera_ray(scene.camera, x + 0.5, y + 0.5));
    }
  }
  const std::vector<RayHit> hits = caster.cast(rays);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    ASSERT_EQ(hits[k].t, image.depth_m[k]);
    ASSERT_EQ(hits[k].triangle, image.primitive[k]);
    ASSERT_EQ(static_cast<bool>(hits[k]), image.hit(k));
  }
}

// A terrain without voids has the same triangles, in the same order, as its mesh.
TEST(EmbreeCaster, SeesAMeshAsItSeesTheSameHeightfield) {
  Scene scene = rough_scene();
  for (float& height : scene.field.heights_m.floats().values())
    height = std::isnan(height) ? 7.0f : height;
  const TriangleMesh mesh = test_support::mesh_of(scene.field, Diagonal::Alternating);
  EXPECT_TRUE(same(EmbreeCaster(mesh).cast_frame(scene.camera),
                   EmbreeCaster(scene.field, Diagonal::Alternating).cast_frame(scene.camera)));
}

// Rays at the sphere's middle from all sides: between the radius and the sagitta below it.
TEST(EmbreeCaster, SeesASphereWhereItIs) {
  constexpr double kRadius = 100.0;
  TriangleMesh mesh = test_support::sphere_mesh(kRadius, 5);
  mesh.origin_m = {4.5e5, 5.1e6, 300.0};
  const double sagitta = test_support::sagitta_m(mesh, kRadius);
  const EmbreeCaster caster(mesh);
  Random random(12);
  for (int k = 0; k < 5000; ++k) {
    glm::dvec3 eye{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    eye *= random.uniform(150.0, 1e5) / glm::length(eye);
    const RayHit hit = caster.cast({eye, -eye});
    ASSERT_TRUE(hit);
    const double from_middle = glm::length(eye + hit.t * -eye);
    // The eye's digits, 2^-53 of 1e5 m, and a few roundings.
    ASSERT_LE(from_middle, kRadius + 1e-10);
    ASSERT_GE(from_middle, kRadius - sagitta - 1e-10);
  }
}

// A picture of the sphere has the disc of its outline: at an eye distance d the tangent cone's
// slope is r / sqrt(d^2 - r^2), and the mesh lies between the spheres of radius r and r - sagitta.
TEST(EmbreeCaster, SeesTheOutlineOfASphere) {
  constexpr double kRadius = 100.0, kDistance = 500.0;
  const TriangleMesh mesh = test_support::sphere_mesh(kRadius, 5);
  const double inner = kRadius - test_support::sagitta_m(mesh, kRadius);
  LookAt look;
  look.eye_m = {0.0, -kDistance, 0.0};
  look.target_m = {0.0, 0.0, 0.0};
  look.width_px = look.height_px = 200;
  const Camera camera = make_camera(look);
  const HitImage image = EmbreeCaster(mesh).cast_frame(camera);
  const auto slope = [&](double r) { return r / std::sqrt(kDistance * kDistance - r * r); };
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double off = std::hypot(x + 0.5 - 100.0, y + 0.5 - 100.0) / camera.gamma_h;
      const bool hit = image.hit(image.index(x, y));
      EXPECT_TRUE(hit || off >= slope(inner) * (1.0 - 1e-9)) << x << ", " << y;
      EXPECT_TRUE(!hit || off <= slope(kRadius) * (1.0 + 1e-9)) << x << ", " << y;
    }
  }
}

// Triangles without area and doubled ones do no harm.
TEST(EmbreeCaster, TakesMeshesWithDegenerateTriangles) {
  TriangleMesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 2, 0}};
  mesh.triangles = {{0, 0, 0}, {0, 1, 1}, {1, 3, 2}, {0, 1, 2}, {0, 1, 2}};
  const EmbreeCaster caster(mesh);
  EXPECT_EQ(caster.cast({{1.0, 1.0, 5.0}, {0.0, 0.0, -1.0}}), (RayHit{5.0, 3}));
  EXPECT_FALSE(caster.cast({{3.0, 3.0, 5.0}, {0.0, 0.0, -1.0}}));
}

// Random meshes of needles, far apart in size, against all triangles in long double.
TEST(EmbreeCaster, AgreesWithBruteForceOnRandomTriangles) {
  Random random(13);
  int hits = 0;
  for (int scene = 0; scene < 30; ++scene) {
    TriangleMesh mesh;
    for (std::uint32_t k = 0; k < 200; ++k) {
      const double size = std::ldexp(1.0, random.integer(-10, 5));
      const glm::dvec3 at{random.uniform(-40.0, 40.0), random.uniform(-40.0, 40.0),
                          random.uniform(-40.0, 40.0)};
      for (int corner = 0; corner < 3; ++corner) {
        mesh.vertices_m.push_back(at + size * glm::dvec3{random.uniform(-1.0, 1.0),
                                                         random.uniform(-1.0, 1.0),
                                                         random.uniform(-1.0, 1.0)});
      }
      mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    LookAt look;
    look.eye_m = {3.0, -90.0, 20.0};
    look.target_m = {0.0, 0.0, 0.0};
    look.width_px = 60;
    look.height_px = 40;
    const Camera camera = make_camera(look);
    const HitImage truth = test_support::brute_force_frame<long double>(
        camera, mesh.origin_m,
        [&](const auto& ray) { return test_support::brute_force(mesh, ray); });
    const auto d = test_support::difference(camera, truth, EmbreeCaster(mesh).cast_frame(camera));
    EXPECT_EQ(d.hit_or_miss + d.elsewhere + d.primitive, 0u) << to_text(d);
    hits += static_cast<int>(d.hits);
  }
  EXPECT_GT(hits, 10000);
}

// What the camera cannot show is not held, and nothing of its picture is missing.
TEST(EmbreeCaster, OfWhatACameraSeesCastsThatCamerasFrames) {
  test_support::Random random(77);
  for (int k = 0; k < 40; ++k) {
    const terrain::Heightfield field = test_support::random_heightfield(random);
    const auto view =
        static_cast<test_support::View>(k % static_cast<int>(test_support::View::Count));
    const Camera camera = test_support::random_camera(random, field, view, 40, 30);
    const EmbreeCaster whole(field, terrain::Diagonal::Fixed);
    const EmbreeCaster seen(field, terrain::Diagonal::Fixed, {.seen_by = camera});
    const HitImage a = whole.cast_frame(camera), b = seen.cast_frame(camera);
    EXPECT_EQ(a.depth_m, b.depth_m) << "scene " << k;
    EXPECT_EQ(a.primitive, b.primitive) << "scene " << k;
    Camera other = camera;
    other.eye_m.z += 1.0;
    EXPECT_THROW(seen.cast_frame(other), std::invalid_argument);
    EXPECT_THROW(seen.cast(Ray{}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace plumb::reference
