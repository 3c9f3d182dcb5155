// A terrain of 16 bits and the same as floats: the same audit, and the same of all it is made from.
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "audit/audit_json.h"
#include "mesh/restricted_quadtree/restricted_quadtree.h"
#include "support/coded_terrain.h"
#include "terrain/statistics.h"
#include "terrain/void_fill.h"

namespace plumb::audit {
namespace {

using terrain::Diagonal;
using test_support::Random;
using test_support::Twins;
using test_support::View;

std::string json_of(const terrain::Heightfield& field, const DrawnSurface& surface,
                    const Camera& camera) {
  AuditResult result =
      audit_surface(HeightfieldTruth(field, Diagonal::Alternating), surface, camera, {});
  result.times = {};
  AuditSubject subject;
  subject.field = &field;
  subject.camera = camera;
  return audit_json(result, subject);
}

TEST(CodedHeights, GiveTheAuditOfFloats) {
  namespace quadtree = mesh::restricted_quadtree;
  Random random(41);
  int measured = 0;
  for (int k = 0; k < 40; ++k) {
    const Twins twins = test_support::coded_twins(random, test_support::random_heightfield(random));
    const auto view = static_cast<View>(k % static_cast<int>(View::Count));
    const Camera camera = test_support::random_camera(random, twins.floats, view, 61, 47);
    const Tolerance tolerance{random.uniform(0.5, 3.0), Unit::Pixel};
    const DrawnSurface coded = quadtree::draw(quadtree::prepare(twins.coded), camera, tolerance);
    const DrawnSurface floats = quadtree::draw(quadtree::prepare(twins.floats), camera, tolerance);
    ASSERT_TRUE(coded.mesh->vertices_m == floats.mesh->vertices_m);
    ASSERT_TRUE(coded.mesh->triangles == floats.mesh->triangles);
    const std::string json = json_of(twins.coded, coded, camera);
    EXPECT_EQ(json, json_of(twins.floats, floats, camera));
    measured += json.find("\"verdict\": \"none\"") == std::string::npos ? 1 : 0;
  }
  EXPECT_GT(measured, 10);
}

TEST(CodedHeights, HaveTheChecksumStatisticsAndBoundsOfFloats) {
  Random random(42);
  for (int k = 0; k < 100; ++k) {
    const Twins twins = test_support::coded_twins(random, test_support::random_heightfield(random));
    EXPECT_EQ(checksum(twins.coded), checksum(twins.floats));
    EXPECT_EQ(bounds(twins.coded).low, bounds(twins.floats).low);
    EXPECT_EQ(bounds(twins.coded).high, bounds(twins.floats).high);
    const auto a = statistics_of(twins.coded), b = statistics_of(twins.floats);
    EXPECT_EQ(a.voids, b.voids);
    EXPECT_EQ(a.mean_m, b.mean_m);
    EXPECT_EQ(a.lowest.height_m, b.lowest.height_m);
    EXPECT_EQ(a.highest.height_m, b.highest.height_m);
    EXPECT_EQ(a.slope_histogram, b.slope_histogram);
    EXPECT_EQ(a.rms_slope_deg, b.rms_slope_deg);
    EXPECT_EQ(a.steepest_step.slope_deg, b.steepest_step.slope_deg);
    Twins filled = twins;
    EXPECT_EQ(fill_voids(filled.coded), fill_voids(filled.floats));
    EXPECT_TRUE(filled.coded.heights_m.is_coded());
    EXPECT_EQ(checksum(filled.coded), checksum(filled.floats));
  }
}

}  // namespace
}  // namespace plumb::audit
