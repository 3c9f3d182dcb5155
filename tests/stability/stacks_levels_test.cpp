// Where levels of stacks meet: nodes two levels apart, three levels at one corner, a camera that
// jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <glm/geometric.hpp>

#include "core/camera.h"
#include "support/drawn_stacks.h"
#include "support/stack_surfaces.h"
#include "terrain/stacks/stack_source.h"

namespace plumb::mesh::stacks {
namespace {

using terrain::Layer;
using terrain::StackField;
using test_support::check_stack_mesh;
using test_support::filtered;
using test_support::StackMeshCheck;
using test_support::surface_of;

constexpr int kSide = 128;
constexpr Variant kBoth[] = {Variant::Published, Variant::Conservative};

// 8 m of rock, and above it layers that have nothing to do with their neighbours': no two levels
// have one topology.
const StackField& torn_ground() {
  static const StackField kField = [] {
    test_support::Draws draws(5);
    return test_support::stacks_where(kSide, kSide, kSide, [&](int, int) {
      std::vector<Layer> layers = test_support::drawn_layers(draws, kSide - 8, 2, 12);
      for (Layer& layer : layers) layer = {layer.start_m + 8, layer.end_m + 8, layer.material};
      layers.insert(layers.begin(), {0, 8, 1});
      return layers;
    });
  }();
  return kField;
}

StackMeshCheck check(const Octree& octree, Variant variant) {
  const Prepared prepared = prepare(torn_ground(), filtered(1, variant));
  return check_stack_mesh(surface_of(prepared, octree), torn_ground());
}

bool touch(const Node& a, const Node& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.at[axis] << a.level > (b.at[axis] + 1) << b.level ||
        b.at[axis] << b.level > (a.at[axis] + 1) << a.level)
      return false;
  }
  return true;
}

int largest_step(const Octree& octree) {
  int largest = 0;
  const std::vector<Node> nodes = octree.drawn();
  for (const Node& a : nodes) {
    for (const Node& b : nodes)
      if (touch(a, b)) largest = std::max(largest, std::abs(a.level - b.level));
  }
  return largest;
}

// Divided wherever the eye's surroundings reach: `reach` edges of a node far.
Octree seen_from(const glm::dvec3& eye, double reach) {
  Octree octree{glm::ivec3(kSide)};
  octree.divide([&](const Node& node) {
    const double edge = kNodeVoxels << node.level;
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = node.at[axis] * edge;
      const double away = std::max({low - eye[axis], eye[axis] - low - edge, 0.0});
      squared += away * away;
    }
    return squared < reach * reach * edge * edge;
  });
  return octree;
}

// eq. (1) divides what is nearer than gamma / tau edges of a node. Beside a divided node of edge s,
// sqrt(3) s across, one of edge 2 s stays whole only if it is 2 s gamma / tau away: never for gamma
// / tau >= sqrt(3). The paper's 10 px a cell are 160 px a node, and gamma is about 1000 px.
TEST(StackLevels, DifferByOneFromAStillCameraAtThePapersTolerance) {
  for (const double x : {-40.0, 3.0, 70.5, 128.0, 200.0}) {
    for (const double z : {-10.0, 50.0, 140.0})
      EXPECT_LE(largest_step(seen_from({x, 60.0, z}, 1.75)), 1);
  }
  EXPECT_GE(largest_step(seen_from({60.0, 60.0, 60.0}, 0.01)), 2);
}

// The paper divides some 40 nodes a frame and lets the others be: after a jump the eye's own chain
// of nodes stands among what was coarse.
TEST(StackLevels, DifferByTwoWhenTheCameraJumps) {
  Octree octree = seen_from({60.0, 60.0, 60.0}, 0.01);
  ASSERT_GE(largest_step(octree), 2);
  EXPECT_FALSE(octree.is_balanced());
  for (const Variant variant : kBoth) {
    const StackMeshCheck open = check(octree, variant);
    EXPECT_GT(open.open, 0);
    std::printf("two levels apart, %s: %d open edges, %d crowded, %d torn vertices\n",
                dual_contouring::name_of(variant), open.open, open.crowded, open.torn);
  }
  octree.balance();
  EXPECT_LE(largest_step(octree), 1);
  EXPECT_EQ(check(octree, Variant::Published).open, 0);
  EXPECT_TRUE(check(octree, Variant::Conservative).is_manifold());
}

// No two nodes that share a face differ by more than one, and three levels meet at (64, 64, 64).
TEST(StackLevels, ThreeAtOneCornerNeedBalanceAcrossCorners) {
  Octree octree{glm::ivec3(kSide)};
  octree.divide(octree.root());
  for (const glm::ivec3 at : {glm::ivec3(0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    octree.divide(Node{2, at});
  octree.divide(Node{1, glm::ivec3(1)});
  EXPECT_EQ(largest_step(octree), 2);
  const StackMeshCheck published = check(octree, Variant::Published);
  const StackMeshCheck conservative = check(octree, Variant::Conservative);
  EXPECT_GT(conservative.open + conservative.crowded + conservative.torn, 0);
  std::printf(
      "three levels at a corner: published %d open; conservative %d open, %d crowded, %d "
      "torn\n",
      published.open, conservative.open, conservative.crowded, conservative.torn);
  octree.balance();
  EXPECT_LE(largest_step(octree), 1);
  EXPECT_EQ(check(octree, Variant::Published).open, 0);
  EXPECT_TRUE(check(octree, Variant::Conservative).is_manifold());
}

// A frame is a function of its camera: what was drawn before leaves no trace.
TEST(StackLevels, AreTheSameAfterAJumpAsWithoutOne) {
  const auto look = [](const glm::dvec3& eye_m) {
    return make_camera({.eye_m = eye_m, .target_m = {64, 64, 60}, .width_px = 160});
  };
  const Tolerance tolerance{400.0, Unit::Pixel};
  const Prepared prepared = prepare(torn_ground());
  const std::size_t before = draw(prepared, look({10, 10, 130}), tolerance).mesh->triangles.size();
  const DrawnSurface jumped = draw(prepared, look({120, 125, 150}), tolerance);
  const DrawnSurface fresh = draw(prepare(torn_ground()), look({120, 125, 150}), tolerance);
  EXPECT_NE(before, fresh.mesh->triangles.size());
  EXPECT_EQ(jumped.mesh->vertices_m, fresh.mesh->vertices_m);
  EXPECT_EQ(jumped.mesh->triangles, fresh.mesh->triangles);
}

struct Turned {
  int triangles = 0, over = 0;        // facing away from their vertices' normals
  int between_levels = 0, sharp = 0;  // with corners of two levels, and 45 degrees off those
  int sharp_within = 0;               // the same of one level
};

Turned turned(const Prepared& prepared, const Octree& octree) {
  std::vector<const NodeMesh*> pointers;
  const auto meshes = prepared.cache->meshes(octree, octree.drawn());
  for (const auto& mesh : meshes) pointers.push_back(mesh.get());
  const JoinedSurface surface = joined(pointers);
  Turned turned;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    glm::dvec3 normal(0.0);
    for (const std::uint32_t v : {a, b, c}) normal += glm::normalize(surface.normal[v]);
    const glm::dvec3 area =
        area_normal(surface.position[a], surface.position[b], surface.position[c]);
    const double cosine = glm::dot(area, normal) / (glm::length(area) * glm::length(normal));
    const bool is_between = surface.names[a].level != surface.names[b].level ||
                            surface.names[b].level != surface.names[c].level;
    ++turned.triangles;
    turned.over += cosine < 0.0 ? 1 : 0;
    turned.between_levels += is_between ? 1 : 0;
    (is_between ? turned.sharp : turned.sharp_within) += cosine < std::sqrt(0.5) ? 1 : 0;
  };
  for (const Face& face : surface.faces) {
    add(face[0], face[1], face[2]);
    if (face[3] != kNoCorner) add(face[0], face[2], face[3]);
  }
  return turned;
}

// Both levels' surfaces are right, half a coarse voxel apart, and the triangles between them turn.
TEST(StackLevels, AreJoinedBySharpTurns) {
  const StackField field = terrain::generate_stacks("generate:caves?size=129");
  Octree octree{glm::ivec3(kSide + 1)};
  octree.divide([](const Node& node) { return node.level > (node.at.x % 2 == 0 ? 0 : 1); });
  octree.balance();
  const Turned caves = turned(prepare(field), octree);
  std::printf("between levels %d triangles, %d over 45 degrees off; within %d, %d\n",
              caves.between_levels, caves.sharp, caves.triangles - caves.between_levels,
              caves.sharp_within);
  EXPECT_GT(caves.sharp * 20, caves.between_levels);
  EXPECT_LT(caves.sharp_within * 100, caves.triangles);
}

TEST(StackLevels, TurnFewestTrianglesOverByMeans) {
  const StackField field = terrain::generate_stacks("generate:caves?size=129");
  for (const int radius : {0, 1}) {
    std::map<dual_contouring::Placement, int> over;
    for (const auto placement : {dual_contouring::Placement::Mean, dual_contouring::Placement::Qef,
                                 dual_contouring::Placement::Particle}) {
      Parameters parameters = filtered(radius);
      parameters.placement = placement;
      Octree octree{glm::ivec3(kSide + 1)};
      octree.divide([](const Node&) { return true; });
      const Turned caves = turned(prepare(field, parameters), octree);
      over[placement] = caves.over;
      std::printf("radius %d, %s: %d of %d turned over\n", radius,
                  dual_contouring::name_of(placement), caves.over, caves.triangles);
    }
    EXPECT_LT(over[dual_contouring::Placement::Mean], over[dual_contouring::Placement::Particle]);
    EXPECT_LT(over[dual_contouring::Placement::Particle], over[dual_contouring::Placement::Qef]);
  }
}

}  // namespace
}  // namespace plumb::mesh::stacks
