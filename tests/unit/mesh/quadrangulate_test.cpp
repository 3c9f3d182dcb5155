// The stages of dual contouring against the slow one, and meshes that can be drawn by hand.
#include "mesh/dual_contouring/quadrangulate.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "mesh/dual_contouring/attributes.h"
#include "mesh/dual_contouring/classification.h"
#include "mesh/dual_contouring/smoothing.h"
#include "support/quad_mesh_checks.h"
#include "support/slow_contour.h"
#include "support/test_lattices.h"

namespace plumb::mesh::dual_contouring {
namespace {

using testing::random_lattice;
using testing::sampled_lattice;

// Rows of less than a word, of whole words, and of one sample more or less.
const std::vector<LatticeBox>& boxes() {
  static const std::vector<LatticeBox> kBoxes{
      {{0, 0, 0}, {2, 2, 2}},     {{-3, 4, 5}, {7, 5, 6}}, {{0, 0, 0}, {63, 4, 3}},
      {{1, -2, 3}, {64, 4, 3}},   {{0, 0, 0}, {65, 3, 4}}, {{0, 0, 0}, {66, 3, 3}},
      {{-70, 0, 0}, {129, 3, 3}}, {{0, 0, 0}, {1, 9, 9}},  {{0, 0, 0}, {0, 0, 0}},
  };
  return kBoxes;
}

// One sample inside at the middle of 3^3.
Lattice<float> one_sample() {
  Lattice<float> density({{-1, -1, -1}, {3, 3, 3}});
  density({0, 0, 0}) = 1.0F;
  return density;
}

TEST(CellMasks, HoldOneBitForEachCorner) {
  Lattice<float> density({{}, {2, 2, 2}});
  density({1, 0, 0}) = 0.75F;
  density({0, 1, 1}) = 1.0F;
  EXPECT_EQ(cell_masks(density).values(), std::vector<CellMask>{1 << 1 | 1 << 6});
}

TEST(CellMasks, TakeAHalfForOutside) {
  EXPECT_EQ(cell_masks(Lattice<float>({{}, {2, 2, 2}}, 0.5F)).values(), std::vector<CellMask>{0});
}

TEST(InsideBits, SayWhatTheMasksSay) {
  for (const LatticeBox& box : boxes()) {
    const Lattice<float> density = random_lattice(box, 5);
    const Lattice<CellMask> masks = cell_masks(density);
    const InsideBits bits(density);
    ASSERT_EQ(bits.cells(), masks.box());
    for (std::size_t k = 0; k < masks.values().size(); ++k) {
      const glm::ivec3 cell = masks.box().at(k) - masks.box().low;
      const CellMask mask = masks.values()[k];
      EXPECT_EQ(bits.mask(cell), mask);
      const auto x = static_cast<std::size_t>(cell.x);
      EXPECT_EQ(bits.active(cell.y, cell.z, x / 64) >> x % 64 & 1,
                mask != 0 && mask != 255 ? 1u : 0u);
    }
  }
}

TEST(InsideBits, CallNoCellActiveBeyondTheRow) {
  const InsideBits bits(random_lattice({{}, {66, 2, 2}}, 9));
  EXPECT_EQ(bits.active(0, 0, 1) >> 1, 0u);
}

// Eight cells round one sample, a vertex and three crossing edges each; six faces.
TEST(Allocate, CountsTheCellsRoundOneSample) {
  for (const Variant variant : {Variant::Published, Variant::Conservative}) {
    const ActiveCells active = allocate(one_sample(), variant);
    EXPECT_EQ(active.vertices, 8u);
    EXPECT_EQ(active.first_cell, (std::vector<std::uint32_t>{0, 2, 4, 6, 8}));
    EXPECT_EQ(active.first_quad.back(), 6u);
    EXPECT_EQ(active.cells[3], (ActiveCell{1, 3, 1 << 4, 1, false}));
  }
}

// Two samples at the ends of a cell's diagonal: one cell with two loops.
TEST(Allocate, GivesACellOneVertexForEachLoop) {
  Lattice<float> density({{}, {4, 4, 4}});
  density({1, 1, 1}) = density({2, 2, 2}) = 1.0F;
  EXPECT_EQ(allocate(density, Variant::Published).vertices, 15u);
  EXPECT_EQ(allocate(density, Variant::Conservative).vertices, 16u);
}

// A cell of the 36 masks and its mirror image, back to back; then the image beside emptiness.
TEST(Allocate, SplitsTwoCellsThatShareTheirFace) {
  for (int m = 0; m < 256; ++m) {
    if (face_to_split(static_cast<CellMask>(m)) != 1) continue;  // the face x = 1
    Lattice<float> density({{}, {3, 2, 2}});
    for (int c = 0; c < 8; ++c) {
      const float value = (m >> c & 1) != 0 ? 1.0F : 0.0F;
      density({c & 1, c >> 1 & 1, c >> 2}) = value;
      density({2 - (c & 1), c >> 1 & 1, c >> 2}) = value;  // the mirror image
    }
    const ActiveCells both = allocate(density, Variant::Conservative);
    EXPECT_TRUE(both.cells[0].split && both.cells[1].split);
    EXPECT_EQ(both.vertices, 4u);
    for (int k = 0; k < 4; ++k) density({2, k & 1, k >> 1}) = 0.0F;
    EXPECT_FALSE(allocate(density, Variant::Conservative).cells[0].split);
  }
}

// Blocks that begin and end within words of 64 cells; random signs, so that many cells are split.
TEST(Allocate, SeesWhatLiesRoundABlock) {
  const Lattice<float> density = random_lattice({{-9, 0, 3}, {150, 8, 7}}, 6);
  const ActiveCells whole = allocate(density, Variant::Conservative);
  for (const LatticeBox& voxels : {LatticeBox{{-7, 2, 5}, {146, 4, 3}},
                                   {{56, 3, 5}, {1, 3, 3}},
                                   {{55, 2, 5}, {64, 4, 2}},
                                   {{61, 2, 6}, {6, 1, 1}}}) {
    const LatticeBox box{voxels.low - 1, voxels.size + 1};
    const ActiveCells part = allocate(density, Variant::Conservative, voxels);
    EXPECT_EQ(part.box, box);
    std::size_t k = 0;
    for (std::size_t row = 0; row < whole.rows(); ++row) {
      for (std::uint32_t c = whole.first_cell[row]; c < whole.first_cell[row + 1]; ++c) {
        const ActiveCell& cell = whole.cells[c];
        const glm::ivec3 place = whole.place(row, cell);
        if (!box.contains(place)) continue;
        ASSERT_LT(k, part.cells.size());
        EXPECT_EQ(part.cells[k].x, place.x - box.low.x);
        EXPECT_EQ(part.cells[k].mask, cell.mask);
        EXPECT_EQ(part.cells[k].split, cell.split);
        ++k;
      }
    }
    EXPECT_EQ(k, part.cells.size());
  }
}

TEST(Allocate, RefusesCellsBeyondTheLattice) {
  const Lattice<float> density({{}, {4, 4, 4}});
  EXPECT_NO_THROW(allocate(density, Variant::Published, {{1, 1, 1}, {2, 2, 2}}));
  EXPECT_THROW(allocate(density, Variant::Published, {{1, 1, 1}, {2, 2, 3}}),
               std::invalid_argument);
  EXPECT_THROW(allocate(density, Variant::Published, {{0, 1, 1}, {1, 1, 1}}),
               std::invalid_argument);
}

TEST(Quadrangulate, DrawsACubeRoundOneSample) {
  const QuadMesh mesh = quadrangulate(one_sample());
  const testing::QuadMeshCheck check = testing::check_quads(mesh);
  EXPECT_EQ(mesh.quads.size(), 6u);
  EXPECT_TRUE(check.is_manifold());
  EXPECT_EQ(check.euler, 2);
  // Crossings at half an edge: means at a sixth of the cell on all axes, a cube of side 1/3.
  EXPECT_NEAR(check.volume, 1.0 / 27, 1e-15);
  EXPECT_NEAR(mesh.position[0].x, -1.0 / 6, 1e-16);
  // The first face is the one below: p = (0, 0, -1), counter-clockwise seen from -z.
  EXPECT_EQ(mesh.quads[0], (Quad{0, 2, 3, 1}));
}

TEST(Quadrangulate, HasTheBitsOfTheSlowWay) {
  for (const LatticeBox& box : boxes()) {
    for (const std::uint64_t seed : {1, 2}) {
      const Lattice<float> density = random_lattice(box, seed);
      for (const Variant variant : {Variant::Published, Variant::Conservative}) {
        for (const Placement placement : {Placement::Mean, Placement::Qef, Placement::Particle}) {
          const Options options{variant, placement};
          const QuadMesh fast = quadrangulate(density, options);
          const testing::SlowContour slow(density, options);
          EXPECT_EQ(fast.position, slow.mesh().position);
          EXPECT_EQ(fast.quads, slow.mesh().quads);
        }
      }
    }
  }
}

TEST(Quadrangulate, HasTheSameBitsOnAnyNumberOfThreads) {
  const Lattice<float> density = random_lattice({{}, {40, 30, 20}}, 4);
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    return quadrangulate(density, {Variant::Conservative, Placement::Qef});
  };
  const QuadMesh one = with_threads(1), several = with_threads(4);
  EXPECT_EQ(one.position, several.position);
  EXPECT_EQ(one.quads, several.quads);
}

// A float density is off by 2^-25 at most, so a crossing by 2^-25 over the slope, 1/4.
TEST(Quadrangulate, DrawsALevelPlaneWhereverItLies) {
  for (const double height : {3.0, 3.125, 3.4, 3.5, 3.97}) {
    const Lattice<float> density = sampled_lattice({{}, {6, 5, 9}}, [&](const glm::dvec3& p) {
      return std::clamp(0.5 + (height - p.z) / 4, 0.0, 1.0);
    });
    for (const Placement placement : {Placement::Mean, Placement::Qef, Placement::Particle}) {
      const QuadMesh mesh = quadrangulate(density, {Variant::Conservative, placement});
      EXPECT_EQ(mesh.position.size(), 5u * 4);
      EXPECT_EQ(mesh.quads.size(), 4u * 3);
      for (const glm::dvec3& at : mesh.position) EXPECT_NEAR(at.z, height, 0x1p-23);
    }
  }
}

TEST(Quadrangulate, DrawsNothingWhereAllIsAlike) {
  for (const float value : {0.0F, 0.5F, 1.0F}) {
    const QuadMesh mesh = quadrangulate(Lattice<float>({{}, {70, 5, 5}}, value));
    EXPECT_TRUE(mesh.position.empty() && mesh.quads.empty());
  }
}

TEST(ToTriangles, CutsEachQuadFromItsFirstCornerToItsThird) {
  QuadMesh mesh;
  mesh.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 2}};
  mesh.quads = {{0, 1, 2, 3}};
  const TriangleMesh triangles = to_triangles(mesh, {100, 200, 300}, {10, 20, 5});
  EXPECT_EQ(triangles.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(triangles.vertices_m[3], glm::dvec3(0, 20, 10));
  EXPECT_EQ(triangles.origin_m, glm::dvec3(100, 200, 300));
}

}  // namespace
}  // namespace plumb::mesh::dual_contouring
