#include "mesh/stacks/level_cells.h"

#include <utility>

#include "mesh/dual_contouring/attributes.h"
#include "mesh/dual_contouring/gradients.h"

namespace plumb::mesh::stacks {

using dual_contouring::CellCorners;
using dual_contouring::CellLoops;
using dual_contouring::Lattice;

LevelCells::LevelCells(Lattice<float> smoothed, std::optional<Lattice<float>> drawn,
                       const Owners& owners)
    : smoothed_(std::move(smoothed)),
      drawn_(std::move(drawn)),
      inside_(this->drawn()),
      owners_(owners) {}

bool LevelCells::is_drawn(const glm::ivec3& cell) const {
  const PlaceBits places = owners_.places.of(cell, cell + 1);
  return (places & owners_.coarser) == 0 && (places & owners_.own) != 0;
}

const CellLoops& LevelCells::loops(const glm::ivec3& cell, Variant variant) const {
  const dual_contouring::CellMask mask = this->mask(cell);
  if (variant == Variant::Published) return dual_contouring::single_loop(mask);
  const int face = dual_contouring::face_to_split(mask);
  if (face < 0) return dual_contouring::manifold_loops(mask);
  glm::ivec3 beside = cell;
  beside[face / 2] += face % 2 == 0 ? -1 : 1;
  return dual_contouring::manifold_loops(
      mask, dual_contouring::face_to_split(this->mask(beside)) == (face ^ 1) && is_drawn(beside));
}

CellCorners LevelCells::corners(const glm::ivec3& cell, bool with_gradients) const {
  CellCorners corners = dual_contouring::corners_of(drawn(), cell, false);
  if (with_gradients) corners.gradient = dual_contouring::central_gradients(smoothed_, cell);
  return corners;
}

glm::dvec3 LevelCells::gradient(const glm::ivec3& cell, const glm::dvec3& at) const {
  return dual_contouring::trilinear(dual_contouring::sobel_gradients(smoothed_, cell), at);
}

}  // namespace plumb::mesh::stacks
