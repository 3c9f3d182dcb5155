#include "mesh/stacks/level_cells.h"

#include <utility>

#include "mesh/dual_contouring/attributes.h"
#include "mesh/dual_contouring/classification.h"
#include "mesh/dual_contouring/gradients.h"

namespace plumb::mesh::stacks {

using dual_contouring::CellCorners;
using dual_contouring::CellLoops;
using dual_contouring::Lattice;

namespace {

glm::ivec3 corner_at(const glm::ivec3& cell, int corner) {
  return cell + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
}

}  // namespace

LevelCells::LevelCells(Lattice<float> smoothed, Lattice<float> drawn, Lattice<Owner> owners)
    : smoothed_(std::move(smoothed)),
      drawn_(std::move(drawn)),
      owners_(std::move(owners)),
      masks_(dual_contouring::cell_masks(drawn_)) {}

bool LevelCells::is_coarser(const glm::ivec3& cell) const {
  if (owners_.values().empty()) return false;
  for (int corner = 0; corner < 8; ++corner) {
    if (owners_(corner_at(cell, corner)) == Owner::Coarser) return true;
  }
  return false;
}

bool LevelCells::is_drawn(const glm::ivec3& cell) const {
  if (owners_.values().empty()) return true;
  bool is_own = false;
  for (int corner = 0; corner < 8; ++corner) {
    const Owner owner = owners_(corner_at(cell, corner));
    if (owner == Owner::Coarser) return false;
    is_own = is_own || owner == Owner::Own;
  }
  return is_own;
}

const CellLoops& LevelCells::loops(const glm::ivec3& cell, Variant variant) const {
  const dual_contouring::CellMask mask = masks_(cell);
  if (variant == Variant::Published) return dual_contouring::single_loop(mask);
  const int face = dual_contouring::face_to_split(mask);
  if (face < 0) return dual_contouring::manifold_loops(mask);
  glm::ivec3 beside = cell;
  beside[face / 2] += face % 2 == 0 ? -1 : 1;
  return dual_contouring::manifold_loops(
      mask, dual_contouring::face_to_split(masks_(beside)) == (face ^ 1) && is_drawn(beside));
}

CellCorners LevelCells::corners(const glm::ivec3& cell, bool with_gradients) const {
  CellCorners corners = dual_contouring::corners_of(drawn_, cell, false);
  if (with_gradients) corners.gradient = dual_contouring::central_gradients(smoothed_, cell);
  return corners;
}

glm::dvec3 LevelCells::gradient(const glm::ivec3& cell, const glm::dvec3& at) const {
  return dual_contouring::trilinear(dual_contouring::sobel_gradients(smoothed_, cell), at);
}

}  // namespace plumb::mesh::stacks
