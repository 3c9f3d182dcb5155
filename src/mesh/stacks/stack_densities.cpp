#include "mesh/stacks/stack_densities.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "terrain/stacks/stack_pyramid.h"

namespace plumb::mesh::stacks {

using dual_contouring::Lattice;
using dual_contouring::LatticeBox;

StackDensities::StackDensities(terrain::StackField finest, const dual_contouring::Filter& filter)
    : filter_(filter) {
  terrain::require_valid(finest);
  if (!finest.holes.empty() &&
      std::find(finest.holes.begin(), finest.holes.end(), 0) == finest.holes.end())
    input_error("a terrain of stacks that has holes alone has no surface");
  const Octree octree(glm::ivec3(finest.columns, finest.rows, finest.voxels));
  levels_ = terrain::stack_pyramid(std::move(finest), octree.root_level() + 1);
  for (const terrain::StackField& level : levels_) nearest_.emplace_back(level);
}

glm::ivec3 StackDensities::size() const { return {field().columns, field().rows, field().voxels}; }

std::size_t StackDensities::bytes() const {
  std::size_t bytes = 0;
  for (const terrain::StackField& level : levels_) bytes += level.bytes();
  return bytes;
}

Lattice<float> StackDensities::operator()(int level, const LatticeBox& box) const {
  const auto at = static_cast<std::size_t>(level);
  return dual_contouring::smoothed(
      dual_contouring::density_of(levels_[at], box.grown(filter_.radius), nearest_[at]), filter_);
}

Lattice<float> StackDensities::of_material(int level, terrain::Material material,
                                           const LatticeBox& box) const {
  const auto at = static_cast<std::size_t>(level);
  return dual_contouring::smoothed(
      dual_contouring::material_density_of(levels_[at], material, box.grown(filter_.radius),
                                           nearest_[at]),
      filter_);
}

glm::dvec3 StackDensities::metres(const glm::dvec3& steps) const {
  const terrain::StackField& finest = field();
  return {(steps.x - 0.5) * finest.dx_m, (steps.y - 0.5) * finest.dy_m,
          static_cast<double>(finest.low_m) + steps.z * finest.voxel_m};
}

glm::dvec3 StackDensities::gradient_in_metres(const glm::dvec3& per_voxel) const {
  return {per_voxel.x / field().dx_m, per_voxel.y / field().dy_m, per_voxel.z / field().voxel_m};
}

Box StackDensities::box(const Node& node) const {
  const double side = kNodeVoxels * static_cast<double>(1 << node.level);
  const glm::dvec3 low = glm::dvec3(node.at) * side;
  Box box;
  box.add(metres(low));
  box.add(metres(low + side));
  return box;
}

}  // namespace plumb::mesh::stacks
