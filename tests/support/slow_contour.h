// Dual contouring word for word: a number for every cell, no bits, no rows.
#pragma once

#include "mesh/dual_contouring/attributes.h"
#include "mesh/dual_contouring/quadrangulate.h"

namespace plumb::testing {

class SlowContour {
 public:
  using Options = mesh::dual_contouring::Options;
  using Lattice = mesh::dual_contouring::Lattice<float>;
  using CellLoops = mesh::dual_contouring::CellLoops;
  using CellMask = mesh::dual_contouring::CellMask;

  /// Without `splits`, pairs of cells that share a face_to_split are left as they are.
  SlowContour(const Lattice& density, const Options& options, bool splits = true)
      : density_(density),
        options_(options),
        splits_(splits),
        masks_(mesh::dual_contouring::cell_masks(density)),
        first_vertex_(masks_.box()) {
    for (std::size_t k = 0; k < masks_.values().size(); ++k) {
      const glm::ivec3 cell = masks_.box().at(k);
      first_vertex_.values()[k] = static_cast<std::uint32_t>(mesh_.position.size());
      for (int v = 0; v < loops(cell).count; ++v) mesh_.position.push_back(place(cell, v));
    }
    for (std::size_t k = 0; k < masks_.values().size(); ++k) {
      for (int axis = 0; axis < 3; ++axis) add_face(masks_.box().at(k), axis);
    }
  }

  const mesh::dual_contouring::QuadMesh& mesh() const { return mesh_; }

 private:
  bool is_split(const glm::ivec3& cell) const {
    const int face = mesh::dual_contouring::face_to_split(masks_(cell));
    if (!splits_ || face < 0) return false;
    glm::ivec3 other = cell;
    other[face / 2] += face % 2 == 0 ? -1 : 1;
    if (!masks_.box().contains(other)) return false;
    const int others = mesh::dual_contouring::face_to_split(masks_(other));
    return others / 2 == face / 2 && others % 2 != face % 2 && others >= 0;
  }

  const CellLoops& loops(const glm::ivec3& cell) const {
    if (options_.variant == mesh::dual_contouring::Variant::Published)
      return mesh::dual_contouring::single_loop(masks_(cell));
    return mesh::dual_contouring::manifold_loops(masks_(cell), is_split(cell));
  }

  glm::dvec3 place(const glm::ivec3& cell, int vertex) const {
    return glm::dvec3(cell) + mesh::dual_contouring::place_vertex(
                                  mesh::dual_contouring::corners_of(density_, cell, true),
                                  loops(cell).edges[static_cast<std::size_t>(vertex)],
                                  options_.placement);
  }

  // The four cells round the edge from p, counter-clockwise seen from its upper end.
  void add_face(const glm::ivec3& p, int axis) {
    glm::ivec3 up(0), a(0), b(0);
    up[axis] = a[(axis + 1) % 3] = b[(axis + 2) % 3] = 1;
    const bool inside = density_(p) > 0.5F;
    if (inside == (density_(p + up) > 0.5F)) return;
    mesh::dual_contouring::Quad quad{};
    const glm::ivec3 cells[] = {p - a - b, p - b, p, p - a};
    for (int k = 0; k < 4; ++k) {
      const glm::ivec3 cell = cells[k], corner = p - cell;
      if (!masks_.box().contains(cell)) return;
      const int edge = mesh::dual_contouring::edge_at(corner.x + 2 * corner.y + 4 * corner.z, axis);
      const int loop = loops(cell).of_edge[static_cast<std::size_t>(edge)];
      quad[static_cast<std::size_t>(inside ? k : (4 - k) % 4)] =
          first_vertex_(cell) + static_cast<std::uint32_t>(loop);
    }
    mesh_.quads.push_back(quad);
  }

  const Lattice& density_;
  Options options_;
  bool splits_;
  mesh::dual_contouring::Lattice<CellMask> masks_;
  mesh::dual_contouring::Lattice<std::uint32_t> first_vertex_;
  mesh::dual_contouring::QuadMesh mesh_;
};

}  // namespace plumb::testing
