// Nodes of different levels side by side: every edge has its two faces, whatever the densities are.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "core/hash.h"
#include "mesh/stacks/joined_surface.h"
#include "mesh/stacks/node_mesh.h"
#include "mesh/stacks/octree.h"

namespace plumb::mesh::stacks {
namespace {

using dual_contouring::Lattice;
using dual_contouring::LatticeBox;

constexpr int kSide = 128;  // voxels

std::uint64_t hash_of(std::uint64_t seed, int level, const glm::ivec3& p) {
  return Checksum().add(seed).add(level).add(p.x).add(p.y).add(p.z).value();
}

// Samples of every level are inside or not by chance, none knowing of the others; air around them,
// so that the surface has no border.
DensitySource random_signs(std::uint64_t seed) {
  return [seed](int level, const LatticeBox& box) {
    Lattice<float> densities(box);
    const int side = kSide >> level;
    for (std::size_t k = 0; k < box.count(); ++k) {
      const glm::ivec3 p = box.at(k);
      const std::uint64_t bits = hash_of(seed, level, p);
      const bool is_within = std::min({p.x, p.y, p.z}) >= 2 && std::max({p.x, p.y, p.z}) < side - 2;
      densities.values()[k] = is_within ? static_cast<float>(bits >> 40) * 0x1p-24F : 0.25F;
    }
    return densities;
  };
}

Octree random_octree(std::uint64_t seed) {
  Octree octree{glm::ivec3(kSide)};
  octree.divide([&](const Node& node) {
    return node.level == octree.root_level() || hash_of(seed ^ 77U, node.level, node.at) % 3 == 0;
  });
  octree.balance();
  return octree;
}

JoinedSurface surface_of(const Octree& octree, const DensitySource& densities, Variant variant) {
  std::vector<NodeMesh> meshes;
  std::vector<const NodeMesh*> pointers;
  for (const Node& node : octree.drawn())
    meshes.push_back(node_mesh(node, octree.surroundings(node), densities, {variant}));
  for (const NodeMesh& mesh : meshes) pointers.push_back(&mesh);
  return joined(pointers);
}

std::size_t corners_of(const Face& face) { return face[3] == kNoCorner ? 3 : 4; }

// Of every pair of vertices: how many faces go one way, and how many the other.
struct Ways {
  int up = 0, down = 0;
};
std::map<std::pair<std::uint32_t, std::uint32_t>, Ways> edges_of(const JoinedSurface& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Ways> edges;
  for (const Face& face : surface.faces) {
    const std::size_t corners = corners_of(face);
    for (std::size_t k = 0; k < corners; ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % corners];
      Ways& ways = edges[std::minmax(a, b)];
      ++(a < b ? ways.up : ways.down);
    }
  }
  return edges;
}

struct Defects {
  int open = 0, non_manifold = 0, vertices = 0;
};

Defects defects_of(const JoinedSurface& surface) {
  Defects defects;
  for (const auto& [edge, ways] : edges_of(surface)) {
    defects.open += ways.up != ways.down ? 1 : 0;
    defects.non_manifold += ways.up > 1 || ways.down > 1 ? 1 : 0;
  }
  // A vertex whose faces are one fan: walking from face to face by shared edges meets all of them.
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> links(surface.names.size());
  for (const Face& face : surface.faces) {
    const std::size_t corners = corners_of(face);
    for (std::size_t k = 0; k < corners; ++k)
      links[face[k]].push_back({face[(k + 1) % corners], face[(k + corners - 1) % corners]});
  }
  for (const auto& link : links) {
    std::map<std::uint32_t, std::uint32_t> next(link.begin(), link.end());
    std::size_t steps = 0;
    if (!link.empty()) {
      std::uint32_t at = link.front().first;
      do {
        const auto found = next.find(at);
        if (found == next.end()) break;
        at = found->second;
        ++steps;
      } while (at != link.front().first && steps <= link.size());
    }
    defects.vertices += steps != link.size() ? 1 : 0;
  }
  return defects;
}

TEST(StackStitching, IsAManifoldWhateverTheSigns) {
  std::size_t faces = 0;
  int levels_side_by_side = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const Octree octree = random_octree(seed);
    ASSERT_TRUE(octree.is_balanced());
    const auto nodes = octree.drawn();
    levels_side_by_side += nodes.front().level != nodes.back().level ? 1 : 0;
    const JoinedSurface surface = surface_of(octree, random_signs(seed), Variant::Conservative);
    faces += surface.faces.size();
    const Defects defects = defects_of(surface);
    EXPECT_EQ(defects.open, 0);
    EXPECT_EQ(defects.non_manifold, 0);
    EXPECT_EQ(defects.vertices, 0);
  }
  EXPECT_GT(faces, 100000U);
  EXPECT_GT(levels_side_by_side, 8);
}

// One vertex a cell: closed all the same, but no manifold.
TEST(StackStitching, ClosesThePublishedMeshToo) {
  int non_manifold = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const JoinedSurface surface =
        surface_of(random_octree(seed), random_signs(seed), Variant::Published);
    const Defects defects = defects_of(surface);
    EXPECT_EQ(defects.open, 0);
    non_manifold += defects.non_manifold + defects.vertices;
  }
  EXPECT_GT(non_manifold, 0);
}

}  // namespace
}  // namespace plumb::mesh::stacks
