// The surface within one node, fitted to what lies beside it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "mesh/dual_contouring/lattice.h"
#include "mesh/dual_contouring/vertex_place.h"
#include "mesh/stacks/level_cells.h"
#include "mesh/stacks/octree.h"

namespace plumb::mesh::stacks {

/// Smoothed densities of a level in a box of its samples: what a node's surface is made of. A
/// sample's value depends on nothing but the level and its place.
using DensitySource =
    std::function<dual_contouring::Lattice<float>(int level, const dual_contouring::LatticeBox&)>;

/// A vertex by what it is: nodes that share it name it alike.
struct VertexName {
  int level = 0;
  glm::ivec3 cell{0};
  int loop = 0;

  friend bool operator==(const VertexName&, const VertexName&) = default;
};

/// Corners of a face as indices of vertices, counter-clockwise from outside; cut into triangles
/// from the first to the third. A triangle's fourth is kNoCorner.
using Face = std::array<std::uint32_t, 4>;
constexpr std::uint32_t kNoCorner = std::numeric_limits<std::uint32_t>::max();

struct NodeMesh {
  std::vector<VertexName> names;     // sorted: the node's level first, then z, y, x and loop
  std::vector<glm::dvec3> position;  // in steps of the finest lattice: sample v at v + 1/2
  std::vector<glm::dvec3> normal;    // minus the gradient, per voxel of the vertex's level, no unit
  std::vector<glm::vec3> colour;    // linear, of materials (node_colours.h); empty where not wanted
  std::vector<Face> faces;          // by the lower end of their edge, then its axis
  std::int64_t faces_vanished = 0;  // whose corners fell together

  std::size_t bytes() const;
};

struct NodeMeshOptions {
  Variant variant = Variant::Conservative;
  dual_contouring::Placement placement = dual_contouring::Placement::Mean;
  /// Columns and rows of the finest level: the surface ends at their outermost stacks. 0: it goes
  /// on to the ends of the nodes.
  glm::ivec2 outline{0};
  /// Whether nothing is known of a stack of a level, which lies in the field: no face crosses it.
  /// Empty: there are no holes.
  std::function<bool(int level, int i, int j)> is_hole = {};
};

/// The faces of the lattice edges whose lower end is one of the node's voxels.
///
/// around  what lies beside the node in a balanced tree
///
///   (1) The meshes of all drawn nodes of a balanced tree, their vertices joined by name, have no
///       open edge but beyond the field's borders.
///   (2) A function of its arguments alone: the same bits everywhere.
/// Source: [Löffler, Müller & Schumann 2011, section 3.4], with the two rules of
/// docs/algorithms/material-stacks.md in place of its replacement of densities.
NodeMesh node_mesh(const Node& node, const Surroundings& around, const DensitySource& densities,
                   const NodeMeshOptions& options);

/// What all densities of a level in a box of its samples are, where that is plain; nothing where
/// they differ.
using UniformDensity =
    std::function<std::optional<float>(int level, const dual_contouring::LatticeBox&)>;

/// False only of a node whose mesh is empty, told without making it.
bool may_have_faces(const Node& node, const Surroundings& around, const UniformDensity& uniform);

}  // namespace plumb::mesh::stacks
