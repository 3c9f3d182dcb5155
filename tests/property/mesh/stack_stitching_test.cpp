// Nodes of different levels side by side: every edge has its two faces, whatever the densities are.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/face_checks.h"
#include "support/octree_surfaces.h"

namespace plumb::mesh::stacks {
namespace {

using dual_contouring::Lattice;
using dual_contouring::LatticeBox;

constexpr int kSide = 128;  // voxels

// Densities of every level by chance, none knowing of the others; air around them, so that the
// surface has no border. `density_at(level, p, bits)`, bits being random.
template <class DensityAt>
DensitySource air_around(std::uint64_t seed, const DensityAt& density_at) {
  return [=](int level, const LatticeBox& box) {
    Lattice<float> densities(box);
    const int side = kSide >> level;
    for (std::size_t k = 0; k < box.count(); ++k) {
      const glm::ivec3 p = box.at(k);
      const std::uint64_t bits = testing::hash_of(seed, level, p);
      const bool is_within = std::min({p.x, p.y, p.z}) >= 2 && std::max({p.x, p.y, p.z}) < side - 2;
      densities.values()[k] = is_within ? density_at(level, p, bits) : 0.25F;
    }
    return densities;
  };
}

float any_density(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24F; }

DensitySource random_signs(std::uint64_t seed) {
  return air_around(seed,
                    [](int, const glm::ivec3&, std::uint64_t bits) { return any_density(bits); });
}

// Of the blocks of 64 voxels (of the finest level) a third is air, a third ground, on each level
// others: nodes without a surface stand beside coarser ones that have one there.
DensitySource random_blocks(std::uint64_t seed) {
  return air_around(seed, [seed](int level, const glm::ivec3& p, std::uint64_t bits) {
    const int shift = 6 - level;
    const glm::ivec3 block(p.x >> shift, p.y >> shift, p.z >> shift);
    const std::uint64_t kind = testing::hash_of(seed ^ 5U, level, block) % 3;
    return kind == 0 ? 0.0F : kind == 1 ? 1.0F : any_density(bits);
  });
}

TEST(StackStitching, IsAManifoldWhateverTheSigns) {
  std::size_t faces = 0;
  int levels_side_by_side = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const Octree octree = testing::random_octree(glm::ivec3(kSide), seed, 3);
    ASSERT_TRUE(octree.is_balanced());
    const auto nodes = octree.drawn();
    levels_side_by_side += nodes.front().level != nodes.back().level ? 1 : 0;
    const JoinedSurface surface =
        testing::surface_of(octree, random_signs(seed), {Variant::Conservative});
    faces += surface.faces.size();
    const testing::FaceCheck check = testing::check_faces(surface.faces);
    EXPECT_EQ(check.odd_edges, 0);
    EXPECT_EQ(check.crowded_edges, 0);
    EXPECT_EQ(check.torn_vertices, 0);
  }
  EXPECT_GT(faces, 100000U);
  EXPECT_GT(levels_side_by_side, 8);
}

TEST(StackStitching, IsAManifoldWhereNodesHaveNoSurfaceOfTheirOwn) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const Octree octree = testing::random_octree(glm::ivec3(kSide), seed, 3);
    const JoinedSurface surface =
        testing::surface_of(octree, random_blocks(seed), {Variant::Conservative});
    EXPECT_TRUE(testing::check_faces(surface.faces).is_manifold());
    EXPECT_GT(surface.faces.size(), 1000U);
  }
}

// One vertex a cell: closed all the same, but no manifold.
TEST(StackStitching, ClosesThePublishedMeshToo) {
  int non_manifold = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const JoinedSurface surface =
        testing::surface_of(testing::random_octree(glm::ivec3(kSide), seed, 3), random_signs(seed),
                            {Variant::Published});
    const testing::FaceCheck check = testing::check_faces(surface.faces);
    EXPECT_TRUE(check.is_closed());
    non_manifold += check.crowded_edges + check.torn_vertices;
  }
  EXPECT_GT(non_manifold, 0);
}

}  // namespace
}  // namespace plumb::mesh::stacks
