#include "mesh/stacks/stack_densities.h"

#include <utility>

#include "terrain/stacks/stack_pyramid.h"

namespace plumb::mesh::stacks {

using dual_contouring::Lattice;
using dual_contouring::LatticeBox;

StackDensities::StackDensities(terrain::StackField finest, const dual_contouring::Filter& filter)
    : filter_(filter) {
  terrain::require_valid(finest);
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

std::vector<terrain::Material> StackDensities::materials_in(int level,
                                                            const LatticeBox& box) const {
  const auto at = static_cast<std::size_t>(level);
  const terrain::StackField& field = levels_[at];
  const LatticeBox wide = box.grown(filter_.radius);
  // A voxel more on either side, for roundings.
  const double from_m = field.low_m + (wide.low.z - 1.0) * field.voxel_m,
               to_m = field.low_m + (wide.high().z + 1.0) * field.voxel_m;
  std::vector<bool> found(field.materials.size());
  const auto columns = static_cast<std::size_t>(field.columns);
  for (int j = wide.low.y; j < wide.high().y; ++j) {
    for (int i = wide.low.x; i < wide.high().x; ++i) {
      const std::size_t index = nearest_[at].at(i, j);
      const terrain::StackView stack =
          field.stack(static_cast<int>(index % columns), static_cast<int>(index / columns));
      for (std::size_t k = 0; k < stack.size() && (k == 0 || stack.start_m(k) < to_m); ++k) {
        if (stack.end_m[k] > from_m) found[stack.material[k]] = true;
      }
    }
  }
  std::vector<terrain::Material> materials;
  for (std::size_t m = 1; m < found.size(); ++m) {
    if (found[m]) materials.push_back(static_cast<terrain::Material>(m));
  }
  return materials;
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
