#include "mesh/stacks/node_mesh.h"

#include <algorithm>
#include <bit>
#include <memory>
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

// The cells of the node's level, and of the next one where a coarser node is beside it.
struct NodeCells {
  std::optional<LevelCells> fine, coarse;
};

// A block of 2 x 2 x 2 samples that lies in a coarser node or touches one has the next level's
// densities; in a balanced tree none of a finer node does. `blocks`: the places that blocks lie in.
Lattice<float> replaced(const Lattice<float>& smoothed, const Lattice<float>& next,
                        const NodePlaces& blocks) {
  Lattice<float> drawn = smoothed;
  const glm::ivec3 low = drawn.box().low, high = drawn.box().high(), next_low = next.box().low;
  for (int z = low.z; z < high.z; ++z) {
    for (int y = low.y; y < high.y; ++y) {
      const int by = y >> 1, bz = z >> 1;
      const PlaceBits coarser = blocks.kind(Beside::Coarser) & blocks.along(1, by - 1, by + 1) &
                                blocks.along(2, bz - 1, bz + 1);
      if (coarser == 0) continue;
      const auto row = drawn.row(y, z);
      const auto next_row = next.row(by, bz);
      for (int x = low.x; x < high.x; ++x) {
        const int bx = x >> 1;
        if ((blocks.along(0, bx - 1, bx + 1) & coarser) != 0)
          row[static_cast<std::size_t>(x - low.x)] =
              next_row[static_cast<std::size_t>(bx - next_low.x)];
      }
    }
  }
  return drawn;
}

// True where all samples are inside, or none is.
bool is_one_sided(const Lattice<float>& density) {
  std::size_t inside = 0;
  for (const float value : density.values()) inside += dual_contouring::is_inside(value) ? 1 : 0;
  return inside == 0 || inside == density.values().size();
}

// The samples of a node's level that it looks at, and of the next level where a coarser node is
// beside it: its cells there, their samples, and those beside them.
LatticeBox samples_of(const Node& node) { return voxels_of(node).grown(kMargin); }

LatticeBox coarser_samples_of(const Node& node) {
  const LatticeBox beside = halved(cells_around(voxels_of(node)));
  return {beside.low - 1, beside.size + 3};
}

// None where no edge of the node can cross the surface.
NodeCells cells_of(const Node& node, const Surroundings& around, const DensitySource& densities) {
  NodeCells cells;
  const NodePlaces places(around, node.at * kNodeVoxels, kNodeVoxels);
  const PlaceBits coarser = places.kind(Beside::Coarser), outside = places.kind(Beside::Outside);
  Lattice<float> smoothed = densities(node.level, samples_of(node));
  const Owners owners{places, places.kind(Beside::Same) | outside, coarser};
  if (coarser == 0) {
    if (!is_one_sided(smoothed)) cells.fine.emplace(std::move(smoothed), std::nullopt, owners);
    return cells;
  }
  Lattice<float> next = densities(node.level + 1, coarser_samples_of(node));
  const NodePlaces blocks(around, node.at * (kNodeVoxels / 2), kNodeVoxels / 2);
  Lattice<float> drawn = replaced(smoothed, next, blocks);
  if (is_one_sided(drawn)) return cells;
  cells.fine.emplace(std::move(smoothed), std::move(drawn), owners);
  cells.coarse.emplace(std::move(next), std::nullopt, Owners{blocks, coarser | outside, 0});
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
        used_((kSlots * (fine_.count() + coarse_.count()) + 63) / 64),
        vertex_(std::make_unique_for_overwrite<std::uint32_t[]>(64 * used_.size())) {}

  NodeMesh mesh() {
    const LatticeBox voxels = voxels_of(node_);
    const glm::ivec3 low = voxels.low, high = voxels.high();
    for (int z = low.z; z < high.z; ++z)
      for (int y = low.y; y < high.y; ++y) add_row({low.x, y, z}, voxels.size.x);
    add_vertices();
    for (Face& face : mesh_.faces) {
      for (std::uint32_t& corner : face) corner = corner == kNoCorner ? kNoCorner : vertex_[corner];
    }
    mesh_.faces.shrink_to_fit();
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

  // The edges that start in `count` voxels from p on along x.
  void add_row(const glm::ivec3& p, int count) {
    const dual_contouring::InsideBits& inside = cells_.fine->inside();
    const glm::ivec3 at = p - inside.samples().low;
    const std::uint64_t here = inside.row(at.y, at.z)[0] >> at.x;
    const std::uint64_t crossing[] = {here ^ here >> 1,
                                      here ^ inside.row(at.y + 1, at.z)[0] >> at.x,
                                      here ^ inside.row(at.y, at.z + 1)[0] >> at.x};
    std::uint64_t any = (crossing[0] | crossing[1] | crossing[2]) & ((1U << count) - 1);
    for (; any != 0; any &= any - 1) {
      const int x = std::countr_zero(any);
      for (int axis = 0; axis < 3; ++axis) {
        if ((crossing[axis] >> x & 1) != 0)
          add_edge(p + glm::ivec3(x, 0, 0), axis, (here >> x & 1) != 0);
      }
    }
  }

  void add_edge(const glm::ivec3& p, int axis, bool is_inside) {
    if (!outline_.holds(node_.level, p, axis) || is_in_hole(p, axis)) return;
    glm::ivec3 a(0), b(0);
    a[(axis + 1) % 3] = b[(axis + 2) % 3] = 1;
    std::array<glm::ivec3, 4> around{p - a - b, p - b, p, p - a};
    if (!is_inside) std::swap(around[1], around[3]);
    Face slots{};
    for (std::size_t k = 0; k < 4; ++k) slots[k] = slot_of(around[k], p, axis);
    add_face(slots);
  }

  // Whether a stack that the edge from p along an axis touches is a hole.
  bool is_in_hole(const glm::ivec3& p, int axis) const {
    if (!options_.is_hole) return false;
    const int level = node_.level;
    return options_.is_hole(level, p.x, p.y) ||
           options_.is_hole(level, p.x + (axis == 0 ? 1 : 0), p.y + (axis == 1 ? 1 : 0));
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
    for (std::size_t k = 0; k < corners; ++k)
      used_[face[k] / 64] |= std::uint64_t{1} << face[k] % 64;
    mesh_.faces.push_back(face);
  }

  void add_vertices() {
    std::size_t count = 0;
    for (const std::uint64_t word : used_) count += static_cast<std::size_t>(std::popcount(word));
    mesh_.names.reserve(count);
    mesh_.position.reserve(count);
    mesh_.normal.reserve(count);
    for (std::size_t at = 0; at < used_.size(); ++at) {
      for (std::uint64_t word = used_[at]; word != 0; word &= word - 1)
        add_vertex(static_cast<std::uint32_t>(64 * at) +
                   static_cast<std::uint32_t>(std::countr_zero(word)));
    }
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
  LatticeBox fine_, coarse_;                 // the cells that have slots
  std::vector<std::uint64_t> used_;          // the slots that have a vertex, a bit each
  std::unique_ptr<std::uint32_t[]> vertex_;  // of each of these
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
  return cells.fine ? Mesher(node, cells, options).mesh() : NodeMesh();
}

bool may_have_faces(const Node& node, const Surroundings& around, const UniformDensity& uniform) {
  const std::optional<float> own = uniform(node.level, samples_of(node));
  if (!own) return true;
  const bool is_beside_coarser =
      std::find(around.begin(), around.end(), Beside::Coarser) != around.end();
  return is_beside_coarser && uniform(node.level + 1, coarser_samples_of(node)) != own;
}

}  // namespace plumb::mesh::stacks
