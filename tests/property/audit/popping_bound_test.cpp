// Popping against a slow direct computation, and the bound that follows from a method's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "audit/apart_on_screen.h"
#include "audit/method.h"
#include "audit/solid_audit.h"
#include "audit/solid_nearest.h"
#include "audit/temporal/path_watch.h"
#include "support/test_terrain.h"
#include "terrain/terrain_source.h"

namespace plumb::audit::temporal {
namespace {

using test_support::rough_terrain;

// The drawn height over a place that is farthest from `height_m`, by barycentric coordinates of
// every triangle; nothing where none covers it.
std::optional<double> drawn_height(const TriangleMesh& mesh, const glm::dvec3& place_m,
                                   double height_m) {
  std::optional<double> farthest;
  for (const Triangle& corners : mesh.triangles) {
    const glm::dvec3 a = mesh.origin_m + mesh.vertices_m[corners[0]] - place_m,
                     b = mesh.origin_m + mesh.vertices_m[corners[1]] - place_m,
                     c = mesh.origin_m + mesh.vertices_m[corners[2]] - place_m;
    const double u = b.x * c.y - b.y * c.x, v = c.x * a.y - c.y * a.x, w = a.x * b.y - a.y * b.x;
    const double area = u + v + w;
    if (!(std::abs(area) > 1e-6) || u / area < 0.0 || v / area < 0.0 || w / area < 0.0) continue;
    const double height = place_m.z + (u * a.z + v * b.z + w * c.z) / area;
    if (!farthest || std::abs(height - height_m) > std::abs(*farthest - height_m))
      farthest = height;
  }
  return farthest;
}

struct Subject {
  const char *method, *variant;
  double tolerance_px;
  std::map<std::string, std::string> parameters = {};
};

class PoppingBound : public testing::TestWithParam<Subject> {
 protected:
  // Past the terrain, sideways, down and turning, some metres a frame.
  static Camera camera_of(std::uint32_t seed, int frame) {
    const auto random = [&](int k) { return test_support::noise(seed, 7, k); };
    LookAt look;
    look.eye_m = {200.0 + 600.0 * random(0) + frame * 25.0 * (random(1) - 0.5),
                  -100.0 + frame * 15.0, 220.0 + 80.0 * random(2) - 4.0 * frame};
    look.target_m = {300.0 + 600.0 * random(3) + frame * 10.0, 700.0, 30.0};
    look.width_px = 120;
    look.height_px = 80;
    return make_camera(look);
  }
};

struct Tried {
  int compared = 0, popped = 0;
  double largest_of_bound = 0.0;
};

// A pixel's popping is the distance on the screen between the two drawn points over its true one,
// and at most e_now + e_before, the errors there by the later camera. The earlier frame kept the
// tolerance for its own camera: what it drew a metres off spans r = (pixels by the later camera) /
// (pixels by the earlier) times as much now. So it pops by at most tolerance * (1 + r).
// Rounding: heights of 100 m seen at 10 pixels a metre, and a map in float32.
void expect_bound(const Subject& subject, const AuditResult& audited, const Popping& popping,
                  const DrawnSurface& now, const Camera& camera, const DrawnSurface& before,
                  const Camera& camera_before, Tried& tried) {
  for (std::size_t pixel = 3; pixel < popping.px.size(); pixel += 61) {
    if (std::isnan(popping.px[pixel])) continue;
    const glm::dvec3 point = camera.eye_m + audited.true_hits.from_eye_m[pixel];
    const auto height_now = drawn_height(*now.mesh, point, point.z),
               height_before = drawn_height(*before.mesh, point, point.z);
    if (!height_now || !height_before) continue;  // between two triangles, by rounding
    const glm::dvec3 a(point.x, point.y, *height_before), b(point.x, point.y, *height_now);
    ++tried.compared;
    ASSERT_NEAR(popping.px[pixel], apart_on_screen(camera, a, b), 1e-6) << pixel;
    const double by_later = apart_on_screen(camera, point, a),
                 by_earlier = apart_on_screen(camera_before, point, a);
    EXPECT_LE(popping.px[pixel], apart_on_screen(camera, point, b) + by_later + 1e-6);
    if (std::string(subject.variant) != "conservative") continue;
    const double ratio = by_earlier > 0.0 ? by_later / by_earlier : 1.0;
    const double bound = subject.tolerance_px * (1.0 + ratio);
    EXPECT_LE(popping.px[pixel], bound + 1e-6);
    tried.popped += popping.px[pixel] > 0.01f;
    tried.largest_of_bound = std::max(tried.largest_of_bound, popping.px[pixel] / bound);
  }
}

TEST_P(PoppingBound, IsTwiceTheToleranceUpToTheCamerasOwnMotion) {
  const Subject subject = GetParam();
  Tried tried;
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const terrain::Heightfield field = rough_terrain(97, 81, seed, 100.0);
    const Method& method = find_method(built_in_methods(), subject.method);
    const HeightfieldTruth truth(field, method.truth);
    const Tolerance tolerance{subject.tolerance_px, Unit::Pixel};
    const auto prepared =
        prepare_method(method, field, {subject.variant, subject.parameters}, tolerance);
    PathWatch watch{TruthTerms(truth)};
    std::optional<Frame> before;
    for (int frame = 0; frame < 5; ++frame) {
      const Camera camera = camera_of(seed, frame);
      const DrawnSurface surface = prepared->draw(camera, tolerance);
      const AuditResult audited = audit_surface(truth, surface, camera);
      const FrameChange change = watch.next(surface, camera, audited);
      if (before)
        expect_bound(subject, audited, *change.popping, surface, camera, before->surface(),
                     before->camera(), tried);
      before.emplace(surface, camera);
    }
  }
  EXPECT_GT(tried.compared, 500);
  if (std::string(subject.variant) != "conservative") return;
  EXPECT_GT(tried.popped, 10);
  EXPECT_GT(tried.largest_of_bound, 0.05);  // the bound is no idle one
}

// Of stacks too, between nearest points, whose errors the audit's own map of the other frame gives:
// rounding as above.
TEST(PoppingOfStacks, IsAtMostTheErrorsOfBothFrames) {
  const terrain::Heightfield field = terrain::load_terrain("generate:caves?size=65&spacing=4");
  const MethodTable& table = built_in_methods();
  const Method& method = find_method(table, "stacks");
  const MeshTruth truth(field, full_detail_of_stacks(table, field));
  const Tolerance tolerance{16.0, Unit::Pixel};
  const auto prepared = prepare_method(method, field, {"published", {}}, tolerance);
  PathWatch watch{TruthTerms(truth)};
  std::optional<Frame> before;
  int popped = 0;
  for (int frame = 0; frame < 6; ++frame) {
    LookAt look;
    look.eye_m = {128.0, -60.0, 100.0 + 9000.0 / (1 << frame)};
    look.target_m = {128.0, 128.0, 60.0};
    look.width_px = 120;
    look.height_px = 68;
    const Camera camera = make_camera(look);
    const DrawnSurface surface = prepared->draw(camera, tolerance);
    const AuditResult audited = audit_surface(truth, surface, camera);
    const FrameChange change = watch.next(surface, camera, audited);
    if (before) {
      const TriangleMesh& mesh = *before->surface().mesh;
      const std::optional<reference::MeshNearest> nearest(mesh);
      const NearestMaps was =
          nearest_maps(audited.true_hits, camera, {mesh, nearest, truth.slack_m()},
                       std::vector<std::uint32_t>(audited.true_hits.size(), kNoPrimitive));
      for (std::size_t pixel = 0; pixel < was.px.size(); ++pixel) {
        if (std::isnan(change.popping->px[pixel])) continue;
        popped += change.popping->px[pixel] > 0.01f;
        EXPECT_LE(change.popping->px[pixel],
                  was.px[pixel] + audited.nearest.reverse_px[pixel] + 1e-5)
            << frame << " " << pixel;
      }
    }
    before.emplace(surface, camera);
  }
  EXPECT_GT(popped, 100);
}

INSTANTIATE_TEST_SUITE_P(
    Methods, PoppingBound,
    testing::Values(Subject{"restricted-quadtree", "conservative", 1.0},
                    Subject{"restricted-quadtree", "conservative", 4.0},
                    Subject{"tessellation", "conservative", 2.0},
                    Subject{"tessellation", "published", 2.0},
                    Subject{"chunked", "conservative", 6.0, {{"patch_cells", "16"}}}),
    [](const testing::TestParamInfo<Subject>& chosen) {
      std::string name = std::string(chosen.param.method) + "_" + chosen.param.variant + "_" +
                         std::to_string(static_cast<int>(chosen.param.tolerance_px));
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace plumb::audit::temporal
