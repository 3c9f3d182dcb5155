#include "mesh/stacks/node_mesh.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace plumb::mesh::stacks {

using dual_contouring::CellLoops;
using dual_contouring::Lattice;
using dual_contouring::LatticeBox;

namespace {

constexpr int kMargin = 2;  // a cell and what its normals, or a split beside it, look at

// The voxels whose edges a node draws. The lowest nodes draw those that rise from below the field
// as well: the low-pass, and a coarse voxel that its ground fills by less than half, may bring the
// surface down there.
LatticeBox voxels_of(const Node& node) {
  LatticeBox voxels{node.at * kNodeVoxels, glm::ivec3(kNodeVoxels)};
  if (node.at.z == 0) {
    --voxels.low.z;
    ++voxels.size.z;
  }
  return voxels;
}

// The cells around the edges that start in some voxels.
LatticeBox cells_around(const LatticeBox& voxels) { return {voxels.low - 1, voxels.size + 1}; }

// The same of the next level.
LatticeBox halved(const LatticeBox& cells) {
  const glm::ivec3 low(cells.low.x >> 1, cells.low.y >> 1, cells.low.z >> 1);
  const glm::ivec3 last = cells.high() - 1;
  return {low, glm::ivec3(last.x >> 1, last.y >> 1, last.z >> 1) - low + 1};
}

// What lies where a sample `p` of the node's own level lies; `per_node` samples a node.
Beside beside_at(const Surroundings& around, const glm::ivec3& p, int per_node) {
  int k = 13, step = 1;
  for (int axis = 0; axis < 3; ++axis, step *= 3)
    k += p[axis] < 0 ? -step : p[axis] >= per_node ? step : 0;
  return around[static_cast<std::size_t>(k)];
}

// Whether a block of 2 x 2 x 2 samples lies in a coarser node or touches one, itself not being
// divided further: its densities are then the next level's.
bool is_replaced(const Surroundings& around, const glm::ivec3& block) {
  const Beside here = beside_at(around, block, kNodeVoxels / 2);
  if (here == Beside::Coarser) return true;
  if (here == Beside::Finer) return false;
  for (int k = 0; k < 27; ++k) {
    const glm::ivec3 offset(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    if (beside_at(around, block + offset, kNodeVoxels / 2) == Beside::Coarser) return true;
  }
  return false;
}

template <class Visit>
void for_each(const LatticeBox& box, const Visit& visit) {
  const glm::ivec3 high = box.high();
  for (int z = box.low.z; z < high.z; ++z)
    for (int y = box.low.y; y < high.y; ++y)
      for (int x = box.low.x; x < high.x; ++x) visit(glm::ivec3(x, y, z));
}

// The cells of the node's level, and of the next one where a coarser node is beside it.
struct NodeCells {
  std::optional<LevelCells> fine, coarse;
};

Lattice<Owner> owners_of(const LatticeBox& box, const glm::ivec3& low, int per_node,
                         const Surroundings& around, bool of_coarser_level) {
  Lattice<Owner> owners(box);
  for_each(box, [&](const glm::ivec3& p) {
    const Beside beside = beside_at(around, p - low, per_node);
    const Owner fine = beside == Beside::Coarser ? Owner::Coarser
                       : beside == Beside::Finer ? Owner::Finer
                                                 : Owner::Own;
    const bool is_own = beside == Beside::Coarser || beside == Beside::Outside;
    owners(p) = !of_coarser_level ? fine : is_own ? Owner::Own : Owner::Finer;
  });
  return owners;
}

NodeCells cells_of(const Node& node, const Surroundings& around, const DensitySource& densities) {
  NodeCells cells;
  const glm::ivec3 low = node.at * kNodeVoxels, half = node.at * (kNodeVoxels / 2);
  const LatticeBox box = voxels_of(node).grown(kMargin);
  Lattice<float> smoothed = densities(node.level, box);
  const bool is_alike = std::all_of(around.begin(), around.end(), [](Beside beside) {
    return beside == Beside::Same || beside == Beside::Outside;
  });
  if (is_alike) {
    Lattice<float> drawn = smoothed;
    cells.fine.emplace(std::move(smoothed), std::move(drawn), Lattice<Owner>());
    return cells;
  }
  Lattice<float> drawn = smoothed;
  Lattice<Owner> owners = owners_of(box, low, kNodeVoxels, around, false);
  if (std::find(around.begin(), around.end(), Beside::Coarser) != around.end()) {
    const LatticeBox cells_there = halved(cells_around(voxels_of(node)));
    const LatticeBox coarse{cells_there.low - 1,
                            cells_there.size + 3};  // their samples, and beside
    Lattice<float> next = densities(node.level + 1, coarse);
    for_each(box, [&](const glm::ivec3& p) {
      const glm::ivec3 block(p.x >> 1, p.y >> 1, p.z >> 1);
      if (is_replaced(around, block - half)) drawn(p) = next(block);
    });
    Lattice<float> same = next;
    cells.coarse.emplace(std::move(next), std::move(same),
                         owners_of(coarse, half, kNodeVoxels / 2, around, true));
  }
  cells.fine.emplace(std::move(smoothed), std::move(drawn), std::move(owners));
  return cells;
}

// Where the surface ends: at the places of the outermost stacks. What straddles the rim ends on it.
class Outline {
 public:
  explicit Outline(const glm::ivec2& stacks) : stacks_(stacks) {}

  /// Whether the edge from p along an axis lies between stacks of the field.
  bool holds(int level, const glm::ivec3& p, int axis) const {
    for (int k = 0; k < 2; ++k) {
      if (stacks_[k] > 0 && p[k] + (k == axis ? 1 : 0) >= samples(level, k)) return false;
    }
    return true;
  }
  /// A vertex of a cell, kept within.
  glm::dvec3 within(int level, const glm::ivec3& cell, glm::dvec3 place) const {
    for (int k = 0; k < 2; ++k) {
      if (stacks_[k] == 0) continue;
      const double low = 0.5, high = stacks_[k] - 0.5;
      place[k] = cell[k] < 0                        ? low
                 : cell[k] + 1 >= samples(level, k) ? high
                                                    : std::clamp(place[k], low, high);
    }
    return place;
  }

 private:
  int samples(int level, int axis) const { return (stacks_[axis] + (1 << level) - 1) >> level; }

  glm::ivec2 stacks_;
};

// Collects faces by the slots of their corners: four for each cell that the node's edges touch.
class Mesher {
 public:
  Mesher(const Node& node, const NodeCells& cells, const NodeMeshOptions& options)
      : node_(node),
        cells_(cells),
        options_(options),
        outline_(options.outline),
        fine_(cells_around(voxels_of(node))),
        coarse_(halved(fine_)),
        vertex_(kSlots * (fine_.count() + coarse_.count()), kNoCorner) {}

  NodeMesh mesh() {
    for_each(voxels_of(node_), [&](const glm::ivec3& p) { add_faces(p); });
    for (std::uint32_t slot = 0; slot < vertex_.size(); ++slot) {
      if (vertex_[slot] != kNoCorner) add_vertex(slot);
    }
    for (Face& face : mesh_.faces) {
      for (std::uint32_t& corner : face) corner = corner == kNoCorner ? kNoCorner : vertex_[corner];
    }
    return std::move(mesh_);
  }

 private:
  static constexpr std::uint32_t kSlots = 4;

  // The slot of the vertex that holds the edge from p along an axis in a cell that touches it.
  std::uint32_t slot_of(const glm::ivec3& cell, const glm::ivec3& p, int axis) const {
    const bool is_coarse = cells_.fine->is_coarser(cell);
    const glm::ivec3 c = is_coarse ? glm::ivec3(cell.x >> 1, cell.y >> 1, cell.z >> 1) : cell;
    const glm::ivec3 q = is_coarse ? glm::ivec3(p.x >> 1, p.y >> 1, p.z >> 1) : p;
    const LevelCells& level = is_coarse ? *cells_.coarse : *cells_.fine;
    const int corner = (q.x - c.x) | (q.y - c.y) << 1 | (q.z - c.z) << 2;
    const int loop = level.loops(c, options_.variant)
                         .of_edge[static_cast<std::size_t>(dual_contouring::edge_at(corner, axis))];
    const std::size_t at = is_coarse ? fine_.count() + coarse_.index(c) : fine_.index(c);
    return static_cast<std::uint32_t>(at) * kSlots + static_cast<std::uint32_t>(loop);
  }

  void add_faces(const glm::ivec3& p) {
    const int mask = cells_.fine->mask(p);
    const bool is_inside = (mask & 1) != 0;
    for (int axis = 0; axis < 3; ++axis) {
      if ((mask >> (1 << axis) & 1) == (is_inside ? 1 : 0)) continue;
      if (!outline_.holds(node_.level, p, axis)) continue;
      glm::ivec3 a(0), b(0);
      a[(axis + 1) % 3] = b[(axis + 2) % 3] = 1;
      std::array<glm::ivec3, 4> around{p - a - b, p - b, p, p - a};
      if (!is_inside) std::swap(around[1], around[3]);
      Face slots{};
      for (std::size_t k = 0; k < 4; ++k) slots[k] = slot_of(around[k], p, axis);
      add_face(slots);
    }
  }

  void add_face(const Face& slots) {
    Face face;
    face.fill(kNoCorner);
    std::size_t corners = 0;
    for (const std::uint32_t slot : slots) {
      if (std::find(face.begin(), face.begin() + corners, slot) == face.begin() + corners)
        face[corners++] = slot;
    }
    if (corners < 3) {
      ++mesh_.faces_vanished;
      return;
    }
    for (std::size_t k = 0; k < corners; ++k) vertex_[face[k]] = 0;
    mesh_.faces.push_back(face);
  }

  void add_vertex(std::uint32_t slot) {
    const std::size_t cell_at = slot / kSlots;
    const bool is_coarse = cell_at >= fine_.count();
    const int level = node_.level + (is_coarse ? 1 : 0), loop = static_cast<int>(slot % kSlots);
    const LevelCells& cells = is_coarse ? *cells_.coarse : *cells_.fine;
    const glm::ivec3 cell = is_coarse ? coarse_.at(cell_at - fine_.count()) : fine_.at(cell_at);
    const dual_contouring::CellCorners corners =
        cells.corners(cell, options_.placement != dual_contouring::Placement::Mean);
    const glm::dvec3 offset = dual_contouring::place_vertex(
        corners, cells.loops(cell, options_.variant).edges[static_cast<std::size_t>(loop)],
        options_.placement);
    vertex_[slot] = static_cast<std::uint32_t>(mesh_.names.size());
    mesh_.names.push_back({level, cell, loop});
    const glm::dvec3 place = (glm::dvec3(cell) + 0.5 + offset) * static_cast<double>(1 << level);
    mesh_.position.push_back(outline_.within(level, cell, place));
    mesh_.normal.push_back(-cells.gradient(cell, offset));
  }

  const Node& node_;
  const NodeCells& cells_;
  const NodeMeshOptions& options_;
  Outline outline_;
  LatticeBox fine_, coarse_;           // the cells that have slots
  std::vector<std::uint32_t> vertex_;  // of each slot
  NodeMesh mesh_;
};

}  // namespace

std::size_t NodeMesh::bytes() const {
  return names.size() * (sizeof(VertexName) + 2 * sizeof(glm::dvec3)) +
         colour.size() * sizeof(glm::vec3) + faces.size() * sizeof(Face);
}

NodeMesh node_mesh(const Node& node, const Surroundings& around, const DensitySource& densities,
                   const NodeMeshOptions& options) {
  const NodeCells cells = cells_of(node, around, densities);
  return Mesher(node, cells, options).mesh();
}

}  // namespace plumb::mesh::stacks
