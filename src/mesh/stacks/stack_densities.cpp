#include "mesh/stacks/stack_densities.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/check.h"
#include "terrain/stacks/stack_pyramid.h"

namespace plumb::mesh::stacks {

using dual_contouring::Lattice;
using dual_contouring::LatticeBox;

namespace {

// Calls visit(stack) for the stacks that a box of samples looks at, until it returns false.
template <class Visit>
void for_stacks(const terrain::StackField& field, const dual_contouring::NearestStacks& nearest,
                const LatticeBox& box, const Visit& visit) {
  const auto columns = static_cast<std::size_t>(field.columns);
  for (int j = box.low.y; j < box.high().y; ++j) {
    for (int i = box.low.x; i < box.high().x; ++i) {
      const std::size_t index = nearest.at(i, j);
      if (!visit(field.stack(static_cast<int>(index % columns), static_cast<int>(index / columns))))
        return;
    }
  }
}

// Heights of a box, a voxel more on either side for roundings.
struct Heights {
  Heights(const terrain::StackField& field, const LatticeBox& box)
      : from_m(field.low_m + (box.low.z - 1.0) * field.voxel_m),
        to_m(field.low_m + (box.high().z + 1.0) * field.voxel_m) {}

  double from_m, to_m;
};

// Calls visit(material) for what fills a stack there, the air above it too.
template <class Visit>
void for_materials(const terrain::StackView& stack, const Heights& heights, const Visit& visit) {
  for (std::size_t k = 0; k < stack.size(); ++k) {
    if (k > 0 && stack.end_m[k - 1] >= heights.to_m) return;
    if (stack.end_m[k] > heights.from_m) visit(stack.material[k]);
  }
  if (stack.size() == 0 || stack.end_m.back() < heights.to_m) visit(terrain::kAir);
}

// 1 where all samples of a box are ground, 0 where they are air; nothing where that is not so, or
// hardly so.
std::optional<float> uniform_density(const terrain::StackField& field,
                                     const dual_contouring::NearestStacks& nearest,
                                     const LatticeBox& box) {
  const Heights heights(field, box);
  bool air = false, ground = false;
  for_stacks(field, nearest, box, [&](const terrain::StackView& stack) {
    for_materials(stack, heights,
                  [&](terrain::Material m) { (m == terrain::kAir ? air : ground) = true; });
    return !(air && ground);
  });
  if (air == ground) return std::nullopt;
  return ground ? 1.0F : 0.0F;
}

}  // namespace

StackDensities::StackDensities(terrain::StackField finest, const dual_contouring::Filter& filter)
    : filter_(filter) {
  dual_contouring::require_valid(filter);
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
  if (const auto density = uniform(level, box)) return Lattice<float>(box, *density);
  const LatticeBox wide = box.grown(filter_.radius);
  return dual_contouring::smoothed(dual_contouring::density_of(levels_[at], wide, nearest_[at]),
                                   filter_);
}

std::optional<float> StackDensities::uniform(int level, const LatticeBox& box) const {
  const auto at = static_cast<std::size_t>(level);
  return uniform_density(levels_[at], nearest_[at], box.grown(filter_.radius));
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
  const LatticeBox wide = box.grown(filter_.radius);
  const Heights heights(levels_[at], wide);
  std::vector<bool> found(field().materials.size());
  for_stacks(levels_[at], nearest_[at], wide, [&](const terrain::StackView& stack) {
    for_materials(stack, heights, [&](terrain::Material m) { found[m] = true; });
    return true;
  });
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
