// Defects put in by hand: each must be found, named, and found where it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "audit/audit.h"
#include "mesh/full/full_detail.h"
#include "raster/rasteriser.h"
#include "support/test_terrain.h"

namespace plumb::audit {
namespace {

constexpr int kWidth = 320, kHeight = 180;

// A terrain in UTM coordinates, drawn in full detail: nothing is wrong with it.
class PlantedDefect : public testing::Test {
 protected:
  PlantedDefect() {
    field_ = test_support::rough_terrain(129, 129, 3, 60.0);
    field_.origin_m = {512345.0, 4512345.0};
    surface_ = mesh::full::draw(mesh::full::prepare(field_), Camera{}, {});
    LookAt look;
    look.eye_m = field_.world_origin_m() + glm::dvec3(640, -200, 260);
    look.target_m = field_.world_origin_m() + glm::dvec3(640, 700, 20);
    look.width_px = kWidth;
    look.height_px = kHeight;
    camera_ = make_camera(look);
  }

  // The pixel of a sample, which the tests choose in view.
  glm::dvec2 pixel_of_sample(int i, int j) const {
    const glm::dvec3 world =
        field_.world_origin_m() + glm::dvec3(i * 10.0, j * 10.0, field_.heights_m(i, j));
    return view_to_pixel(camera_, to_view(camera_, world));
  }
  // A changed copy of the mesh.
  std::shared_ptr<TriangleMesh> copy() const {
    return std::make_shared<TriangleMesh>(*surface_.mesh);
  }
  AuditResult audit() const {
    return audit_surface(HeightfieldTruth(field_, terrain::Diagonal::Alternating), surface_,
                         camera_);
  }

  terrain::Heightfield field_;
  DrawnSurface surface_;
  Camera camera_;
};

const ClaimResult& claim(const AuditResult& result, const std::string& label) {
  return *std::find_if(result.claims.begin(), result.claims.end(),
                       [&](const ClaimResult& c) { return c.label == label; });
}

TEST_F(PlantedDefect, NoneIsFoundWhereNoneIs) {
  const AuditResult result = audit();
  EXPECT_TRUE(result.holds());
  EXPECT_EQ(result.coverage.defect_count(), 0);
  EXPECT_TRUE(result.topology.is_sound());
  EXPECT_TRUE(result.registration.agrees);
}

TEST_F(PlantedDefect, AMovedVertexIsNamedWithItsSampleAndPatch) {
  const int i = 64, j = 40;
  auto mesh = copy();
  const glm::dvec3 place{i * 10.0, j * 10.0, field_.heights_m(i, j)};
  const auto vertex = std::find(mesh->vertices_m.begin(), mesh->vertices_m.end(), place);
  ASSERT_NE(vertex, mesh->vertices_m.end());
  vertex->z += 7.5;
  surface_.mesh = mesh;
  const AuditResult result = audit();
  EXPECT_FALSE(result.holds());
  const ClaimResult& broken = claim(result, "sample-error");
  EXPECT_FALSE(broken.holds);
  EXPECT_NEAR(broken.measured, 7.5, 1e-9);
  EXPECT_EQ(broken.violations, 1);
  ASSERT_TRUE(broken.worst.has_value());
  EXPECT_EQ(broken.worst->sample_i, i);
  EXPECT_EQ(broken.worst->sample_j, j);
  // Cells 63 and 64 belong to patches 0 and 1 of the bottom row.
  EXPECT_TRUE(broken.worst->patch == 0 || broken.worst->patch == 1) << broken.worst->patch;
  const glm::dvec2 pixel = pixel_of_sample(i, j);
  EXPECT_EQ(broken.worst->x, static_cast<int>(pixel.x));
  EXPECT_EQ(broken.worst->y, static_cast<int>(pixel.y));
  EXPECT_FALSE(claim(result, "pixel-error").holds);
}

// Every triangle right of a line of samples moves aside by as much as a pixel spans there.
TEST_F(PlantedDefect, ACrackOfOnePixelIsSeenAndPlaced) {
  const int column = 64;  // the border between patches 0 and 1
  auto mesh = copy();
  const double depth = to_view(camera_, field_.world_origin_m() + glm::dvec3(640, 300, 20)).z;
  const double pixel_m = depth / camera_.gamma_h;
  const std::size_t shared = mesh->vertices_m.size();
  std::vector<std::uint32_t> twin(shared, kNoPrimitive);
  for (Triangle& t : mesh->triangles) {
    const double middle =
        (mesh->vertices_m[t[0]].x + mesh->vertices_m[t[1]].x + mesh->vertices_m[t[2]].x) / 3.0;
    if (middle < column * 10.0) continue;
    for (std::uint32_t& v : t) {
      if (v >= shared || mesh->vertices_m[v].x != column * 10.0) continue;
      if (twin[v] == kNoPrimitive) {
        twin[v] = static_cast<std::uint32_t>(mesh->vertices_m.size());
        mesh->vertices_m.push_back(mesh->vertices_m[v] + glm::dvec3(pixel_m, 0.0, 0.0));
      }
      v = twin[v];
    }
  }
  surface_.mesh = mesh;
  const AuditResult result = audit();
  EXPECT_FALSE(result.holds());
  EXPECT_FALSE(claim(result, "coverage").holds);
  EXPECT_GT(result.coverage.holes + result.coverage.see_through, 20);
  EXPECT_EQ(result.coverage.overshoots, 0);
  EXPECT_GE(result.topology.open_edges, 2 * 128);  // both rims of the crack
  for (const CoverageDefect& defect : result.coverage.listed) {
    // The crack is the picture's vertical middle line, at most three pixels to its right at the
    // near end.
    EXPECT_NEAR(defect.x, kWidth / 2, 4) << defect.y;
    EXPECT_NE(defect.patch_a, -1);
    EXPECT_NE(defect.patch_b, -1);
    EXPECT_NE(defect.patch_a, defect.patch_b);
  }
  EXPECT_EQ(result.offenders.front().what, name_of(result.coverage.listed.front().kind));
}

TEST_F(PlantedDefect, AMissingTriangleIsAHoleWithThreeOpenEdges) {
  const glm::dvec2 pixel = pixel_of_sample(64, 20);
  auto mesh = copy();
  // The triangle nearest to the middle of cell (64, 20), which is some pixels wide.
  const auto found =
      std::find_if(mesh->triangles.begin(), mesh->triangles.end(), [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
          const glm::dvec3& p = mesh->vertices_m[v];
          return p.x >= 640.0 && p.x <= 650.0 && p.y >= 200.0 && p.y <= 210.0;
        });
      });
  ASSERT_NE(found, mesh->triangles.end());
  // Keeps the numbers of the others: a triangle of no size at its first corner.
  *found = {(*found)[0], (*found)[0], (*found)[0]};
  surface_.mesh = mesh;
  const AuditResult result = audit();
  EXPECT_FALSE(result.holds());
  EXPECT_GE(result.coverage.holes + result.coverage.see_through, 1);
  EXPECT_EQ(result.topology.open_edges, 3);
  EXPECT_EQ(result.topology.degenerate_triangles, 1);
  ASSERT_FALSE(result.coverage.listed.empty());
  EXPECT_NEAR(result.coverage.listed.front().x, pixel.x, 8);
  EXPECT_NEAR(result.coverage.listed.front().y, pixel.y, 8);
  EXPECT_EQ(result.coverage.listed.front().patch_a, 1);
}

TEST_F(PlantedDefect, AMovedEyeIsMeasured) {
  Camera other = camera_;
  other.eye_m += glm::dvec3(1.5, -0.5, 0.75);
  const HeightfieldTruth truth(field_, terrain::Diagonal::Alternating);
  const AuditResult result = audit_picture(truth, truth.caster.cast_frame(camera_), surface_,
                                           raster::rasterise(*surface_.mesh, other).image, camera_);
  EXPECT_FALSE(result.holds());
  EXPECT_FALSE(result.registration.agrees);
  // Least squares over triangles that face all ways; what is missing is how far the snapped rays
  // are off, 1e-3 m.
  EXPECT_NEAR(result.registration.eye_offset_m.x, 1.5, 1e-2);
  EXPECT_NEAR(result.registration.eye_offset_m.y, -0.5, 1e-2);
  EXPECT_NEAR(result.registration.eye_offset_m.z, 0.75, 1e-2);
}

TEST_F(PlantedDefect, APictureMovedByHalfAPixelIsMeasured) {
  Camera other = camera_;
  other.centre_px += glm::dvec2(0.5, 0.0);
  const HeightfieldTruth truth(field_, terrain::Diagonal::Alternating);
  const AuditResult result = audit_picture(truth, truth.caster.cast_frame(camera_), surface_,
                                           raster::rasterise(*surface_.mesh, other).image, camera_);
  EXPECT_FALSE(result.holds());
  EXPECT_FALSE(result.registration.agrees);
  // Points are seen half a pixel left of where the picture has them; each is off by at most 1/512
  // px, their mean by less.
  EXPECT_NEAR(result.registration.mean_shift_px.x, -0.5, 1.0 / 512);
  EXPECT_NEAR(result.registration.mean_shift_px.y, 0.0, 1.0 / 512);
}

TEST_F(PlantedDefect, GroundDrawnOverAVoidIsCounted) {
  for (int j = 30; j < 40; ++j) {
    for (int i = 60; i < 70; ++i)
      field_.heights_m.floats()(i, j) = std::numeric_limits<float>::quiet_NaN();
  }
  const AuditResult result = audit();  // the mesh still stands there
  EXPECT_FALSE(result.holds());
  EXPECT_EQ(result.samples.over_void, 100);
  EXPECT_FALSE(claim(result, "pixel-error").holds);
  EXPECT_GT(result.vertical.infinite, 0);
}

TEST_F(PlantedDefect, AFoldedTriangleIsCounted) {
  auto mesh = copy();
  std::swap(mesh->triangles[100][0], mesh->triangles[100][1]);
  surface_.mesh = mesh;
  EXPECT_EQ(audit().topology.folded_triangles, 1);
}

}  // namespace
}  // namespace plumb::audit
