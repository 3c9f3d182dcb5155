// Popping and flicker of frames whose changes are known in closed form.
#include "audit/temporal/frame_change.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "audit/surface_picture.h"
#include "audit/temporal/path_json.h"
#include "audit/temporal/path_watch.h"
#include "audit/temporal/popping_limit.h"
#include "core/check.h"
#include "core/parallel.h"
#include "mesh/full/full_detail.h"
#include "support/test_terrain.h"

namespace plumb::audit::temporal {
namespace {

// 80 m of level ground at height zero, samples 10 m apart.
terrain::Heightfield flat_ground() {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(9, 9, 0.0f);
  field.dx_m = field.dy_m = 10.0;
  field.origin_m = {400000.0, 5000000.0};
  return field;
}

// 100 x 100 pixels straight down from 100 m over (x, y): 50 pixels a unit at depth one, so that
// the ground has two metres a pixel. From over its middle it covers 40 x 40 pixels, 30..69.
Camera from_above(double x_m = 40.0, double height_m = 100.0, double y_m = 40.0) {
  LookAt look;
  look.eye_m = flat_ground().world_origin_m() + glm::dvec3(x_m, y_m, height_m);
  look.target_m = look.eye_m - glm::dvec3(0.0, 0.0, height_m);
  look.width_px = look.height_px = 100;
  look.fov_y_deg = 90.0;
  return make_camera(look);
}

class FrameChanges : public testing::Test {
 protected:
  FrameChanges() : field_(flat_ground()), truth_(field_, terrain::Diagonal::Alternating) {}

  DrawnSurface drawn(double up_m, int level_of_west = 0) const {
    DrawnSurface surface = mesh::full::draw(mesh::full::prepare(field_), Camera{}, {});
    TriangleMesh mesh = *surface.mesh;
    for (glm::dvec3& vertex : mesh.vertices_m) vertex.z += up_m;
    // West and east halves as patches of their own.
    std::stable_partition(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
      return mesh.vertices_m[t[0]].x + mesh.vertices_m[t[1]].x + mesh.vertices_m[t[2]].x < 120.0;
    });
    surface.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    surface.runs = nullptr;
    surface.patches = {{0, 64, level_of_west, "west"}, {64, 64, 0, "east"}};
    surface.triangle_lod.assign(128, 0);
    std::fill_n(surface.triangle_lod.begin(), 64, static_cast<std::uint8_t>(level_of_west));
    return surface;
  }
  AuditResult audited(const DrawnSurface& surface, const Camera& camera) const {
    return audit_surface(truth_, surface, camera);
  }
  FrameChange between(const Frame& before, const Frame& now) const {
    return change_between(truth_, audited(now.surface(), now.camera()), now, &before, nullptr);
  }

  terrain::Heightfield field_;
  HeightfieldTruth truth_;
};

// What is seen o pixels off the middle from 100 m above is seen 100 / 80 of that off it when it
// rises by 20 m: it pops by o / 4. The farthest pixel of the ground is 19.5 * sqrt(2) off. Heights
// and eye have few digits; pixels come from quotients, rounded some ten times at 100.
TEST_F(FrameChanges, PopByWhatARiseSpansOnTheScreen) {
  const FrameChange change = between({drawn(0.0), from_above()}, {drawn(20.0), from_above()});
  ASSERT_TRUE(change.popping.has_value());
  const Popping& popping = *change.popping;
  constexpr double kRounding = 10 * 100.0 * 2.3e-16;
  EXPECT_NEAR(popping.max_px, 19.5 * std::sqrt(2.0) / 4.0, 10 * kRounding);
  EXPECT_EQ(popping.pixels.count, 1600);
  for (int x = 30; x < 70; ++x) {
    const double off = std::abs(x + 0.5 - 50.0);
    EXPECT_NEAR(popping.px[static_cast<std::size_t>(5000 + x)], std::hypot(off, 0.5) / 4.0, 1e-6)
        << x;
  }
  ASSERT_TRUE(popping.worst.has_value());
  EXPECT_EQ(popping.worst->m, 20.0);
  EXPECT_EQ(std::abs(popping.worst->x + 0.5 - 50.0), 19.5);
  EXPECT_EQ(std::abs(popping.worst->y + 0.5 - 50.0), 19.5);
}

// All of the ground is in view of both: its corner is 20 * sqrt(2) pixels off the middle.
TEST_F(FrameChanges, PopAtTheVerticesToo) {
  const FrameChange change = between({drawn(0.0), from_above()}, {drawn(20.0), from_above()});
  ASSERT_TRUE(change.popping->vertices.has_value());
  EXPECT_EQ(change.popping->vertices->count, 2 * 81);
  EXPECT_EQ(change.popping->vertices->max_m, 20.0);
  EXPECT_NEAR(change.popping->vertices->max_px, 20.0 * std::sqrt(2.0) / 4.0, 1e-12);
}

TEST_F(FrameChanges, AreNoneWhereOnlyTheCameraMoves) {
  const DrawnSurface surface = drawn(3.0);
  const FrameChange shared =
      between({surface, from_above(30.0)}, {surface, from_above(50.0, 90.0)});
  EXPECT_EQ(shared.popping->pixels.max, 0.0);
  EXPECT_GT(shared.popping->pixels.count, 1000);
  EXPECT_FALSE(shared.popping->worst.has_value());
  // A mesh made anew is the same surface.
  const FrameChange again =
      between({drawn(3.0), from_above(30.0)}, {drawn(3.0), from_above(50.0, 90.0)});
  EXPECT_EQ(again.popping->pixels.max, 0.0);
  EXPECT_EQ(again.popping->vertices->max_px, 0.0);
}

// Rough ground, the mesh's triangles turned and in another order, its origin elsewhere: heights
// come out some 1e-13 m apart, and that is no motion.
TEST(FrameChange, IsNoneBetweenTwoWaysToWriteAMesh) {
  const terrain::Heightfield field = test_support::rough_terrain(65, 65, 7, 80.0);
  const HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  const DrawnSurface one = mesh::full::draw(mesh::full::prepare(field), Camera{}, {});
  TriangleMesh mesh = *one.mesh;
  const glm::dvec3 shift(123.456, -77.7, 0.3);
  mesh.origin_m -= shift;
  for (glm::dvec3& vertex : mesh.vertices_m) vertex += shift;
  std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  for (Triangle& triangle : mesh.triangles) triangle = {triangle[1], triangle[2], triangle[0]};
  DrawnSurface other = one;
  other.mesh = std::make_shared<const TriangleMesh>(mesh);
  other.runs = nullptr;
  LookAt look;
  look.eye_m = {320.0, -200.0, 300.0};
  look.target_m = {320.0, 320.0, 0.0};
  look.width_px = 160;
  look.height_px = 90;
  const Camera camera = make_camera(look);
  const Frame before(one, camera), now(other, camera);
  const FrameChange change =
      change_between(truth, audit_surface(truth, other, camera), now, &before, nullptr);
  EXPECT_GT(change.popping->pixels.count, 1000);
  EXPECT_EQ(change.popping->pixels.max, 0.0);
}

// From over x = -60 the ground up to x = 40 is in view, its western half: 20 x 40 pixels. So it is
// with the other halves from the other sides.
TEST_F(FrameChanges, AreNotMeasuredWhereTheFrameBeforeDidNotLook) {
  for (const Camera& aside : {from_above(-60.0), from_above(140.0), from_above(40.0, 100.0, -60.0),
                              from_above(40.0, 100.0, 140.0)}) {
    const FrameChange change = between({drawn(0.0), aside}, {drawn(20.0), from_above()});
    EXPECT_EQ(change.popping->pixels.count, 800) << aside.eye_m.x << " " << aside.eye_m.y;
  }
  Camera short_sighted = from_above();
  short_sighted.far_m = 99.0;
  const FrameChange change = between({drawn(0.0), short_sighted}, {drawn(20.0), from_above()});
  EXPECT_EQ(change.popping->pixels.count, 0);
}

// One triangle of 10 m by 10 m / 2 covers some of 5 x 5 pixels' centres.
TEST_F(FrameChanges, AreNotMeasuredWhereAFrameDrawsNothing) {
  DrawnSurface holed = drawn(0.0);
  TriangleMesh mesh = *holed.mesh;
  mesh.triangles.erase(mesh.triangles.begin());
  holed.mesh = std::make_shared<const TriangleMesh>(mesh);
  holed.patches.clear();
  holed.triangle_lod.clear();
  const FrameChange change = between({drawn(0.0), from_above()}, {holed, from_above()});
  EXPECT_LT(change.popping->pixels.count, 1600);
  EXPECT_GE(change.popping->pixels.count, 1600 - 25);
}

// The western half goes from level 0 to 2 and back: 20 x 40 pixels of one patch.
TEST_F(FrameChanges, CountLevelsThatToggle) {
  PathWatch watch{TruthTerms(truth_)};
  std::vector<FrameChange> changes;
  for (const int level : {0, 2, 0, 0, 1, 2}) {
    const DrawnSurface surface = drawn(0.0, level);
    changes.push_back(watch.next(surface, from_above(), audited(surface, from_above())));
  }
  EXPECT_FALSE(changes[0].popping.has_value());
  EXPECT_TRUE(changes[1].popping.has_value());
  EXPECT_FALSE(changes[1].flicker.has_value());
  ASSERT_TRUE(changes[2].flicker.has_value());
  EXPECT_EQ(changes[2].flicker->compared, 1600);
  EXPECT_EQ(changes[2].flicker->pixels, 800);
  EXPECT_EQ(changes[2].flicker->patches, 1);
  EXPECT_EQ(changes[2].flicker->worst.patch_name, "west");
  EXPECT_EQ(changes[2].flicker->worst_pixels, 800);
  for (const std::size_t steady : {3, 4, 5})
    EXPECT_EQ(changes[steady].flicker->pixels, 0) << steady;
  for (const std::size_t k : {1, 2, 3, 4, 5}) EXPECT_EQ(changes[k].popping->max_px, 0.0) << k;
}

TEST_F(FrameChanges, TellTheLevelsWhereItPopped) {
  const FrameChange change =
      between({drawn(0.0, 3), from_above(30.0)}, {drawn(20.0, 1), from_above(30.0)});
  const PoppedPlace& worst = *change.popping->worst;
  EXPECT_GT(worst.x, 50);  // the eastern border is farther from the middle
  EXPECT_EQ(worst.after.patch_name, "east");
  const FrameChange west =
      between({drawn(0.0, 3), from_above(50.0)}, {drawn(20.0, 1), from_above(50.0)});
  EXPECT_EQ(west.popping->worst->after.patch_name, "west");
  EXPECT_EQ(west.popping->worst->before.level, 3);
  EXPECT_EQ(west.popping->worst->after.level, 1);
}

DrawnSurface painted(const DrawnSurface& mesh) {
  DrawnSurface surface;
  surface.is_solid = false;
  surface.patches = {{0, 1, 0, "all"}};
  surface.painter = [mesh](const Camera& camera) {
    SurfacePicture picture = picture_of(mesh, camera);
    for (std::uint32_t& primitive : picture.image.primitive)
      primitive = primitive == kNoPrimitive ? primitive : 0;
    return picture;
  };
  return surface;
}

// A pixel o off the middle shows ground o * 100 / 50 m off before, and o * 80 / 50 m off what is
// raised by 20 m: on the true ground 0.8 of the pixels that it was. It pops by o / 5, less the
// snapping of vertices to 1/256 px, which moves what a pixel shows by no more than that.
TEST_F(FrameChanges, OfAPictureAreThoseOfTheGroundThatAPixelShows) {
  const FrameChange change =
      between({painted(drawn(0.0)), from_above()}, {painted(drawn(20.0)), from_above()});
  EXPECT_NEAR(change.popping->max_px, 19.5 * std::sqrt(2.0) / 5.0, 2.0 / 256.0);
  EXPECT_FALSE(change.popping->vertices.has_value());
  const DrawnSurface same = painted(drawn(20.0));
  EXPECT_EQ(between({same, from_above(35.0)}, {same, from_above()}).popping->pixels.max, 0.0);
}

TEST_F(FrameChanges, AreRefusedBetweenSurfacesOfTwoKinds) {
  EXPECT_THROW(between({drawn(0.0), from_above()}, {painted(drawn(0.0)), from_above()}),
               std::invalid_argument);
}

TEST_F(FrameChanges, AreTheSameOnAnyNumberOfThreads) {
  const auto all = [&] {
    return between({drawn(0.0), from_above(37.0)}, {drawn(7.3), from_above(41.0, 93.0)});
  };
  const FrameChange many = all();
  const ThreadLimit one(1);
  const FrameChange alone = all();
  EXPECT_EQ(many.popping->max_px, alone.popping->max_px);
  EXPECT_EQ(popping_summary_json(many), popping_summary_json(alone));
}

// 6.89 px, as above.
TEST_F(FrameChanges, AreJudgedByALimit) {
  const Frame before(drawn(0.0), from_above()), now(drawn(20.0), from_above());
  const FrameChange change = between(before, now);
  for (const auto& [limit, holds] : {std::pair("popping=6.8px", false), {"popping=6.9px", true}}) {
    AuditResult result = audited(now.surface(), now.camera());
    add_popping_limit(result, parse_limit(limit), change, truth_, now.camera());
    const auto claim = std::find_if(result.claims.begin(), result.claims.end(),
                                    [](const ClaimResult& c) { return c.label == "popping"; });
    ASSERT_NE(claim, result.claims.end());
    EXPECT_EQ(claim->holds, holds);
    EXPECT_EQ(claim->violations, holds ? 0 : 4);  // the four corners
    EXPECT_LT(claim->slack, 1e-6);
  }
  AuditResult first = audited(now.surface(), now.camera());
  add_popping_limit(first, parse_limit("popping=0px"), {}, truth_, now.camera());
  EXPECT_EQ(first.claims.back().verdict(), Verdict::None);
}

TEST_F(FrameChanges, AreRefusedAsALimitOfOneFrame) {
  AuditOptions options;
  options.limits = {parse_limit("popping=1px")};
  EXPECT_THROW(audit_surface(truth_, drawn(0.0), from_above(), options), InputError);
  EXPECT_THROW(parse_limit("popping=1m"), InputError);
}

TEST_F(FrameChanges, AreWrittenAsJson) {
  EXPECT_EQ(popping_summary_json({}), "null");
  const Frame before(drawn(0.0), from_above()), now(drawn(20.0, 1), from_above());
  const FrameChange change = between(before, now);
  const auto summary = nlohmann::json::parse(popping_summary_json(change));
  EXPECT_EQ(summary.at("max_px"), change.popping->max_px);
  // o / 4 > 1 but for the pixels that are at most 4 off the middle.
  EXPECT_EQ(summary.at("pixels_over_1px"), change.popping->over_1px);
  EXPECT_TRUE(summary.at("flicker_pixels").is_null());
  AuditSubject subject;
  subject.field = &field_;
  subject.camera = now.camera();
  const auto frame =
      nlohmann::json::parse(frame_json(audited(now.surface(), now.camera()), subject, change));
  EXPECT_EQ(frame.at("schema"), "plumb.audit/1");
  EXPECT_EQ(frame.at("popping").at("worst").at("m"), 20.0);
  EXPECT_EQ(frame.at("popping").at("vertices").at("count"), 162);
  EXPECT_TRUE(frame.at("flicker").is_null());
}

// Pixels whose centre is more than 4 off the middle, counted by head's rule.
TEST_F(FrameChanges, CountPixelsThatPopByMoreThanOne) {
  const FrameChange change = between({drawn(0.0), from_above()}, {drawn(20.0), from_above()});
  int more = 0;
  for (int y = 30; y < 70; ++y) {
    for (int x = 30; x < 70; ++x) {
      const double u = x - 49.5, v = y - 49.5;
      more += u * u + v * v > 16.0;
    }
  }
  EXPECT_EQ(change.popping->over_1px, more);
}

}  // namespace
}  // namespace plumb::audit::temporal
