#include "mesh/stacks/drawn_errors.h"

#include <algorithm>

#include "core/parallel.h"
#include "mesh/stacks/surface_distance.h"

namespace plumb::mesh::stacks {

std::size_t DrawnErrors::NodeHash::operator()(const Node& node) const {
  std::uint64_t x = static_cast<std::uint32_t>(node.level);
  for (int axis = 0; axis < 3; ++axis)
    x = x * 0x9e3779b97f4a7c15ULL + static_cast<std::uint32_t>(node.at[axis]);
  return static_cast<std::size_t>(x ^ x >> 31);
}

DrawnErrors::DrawnErrors(const Octree& octree, std::span<const Node> nodes,
                         std::span<const std::shared_ptr<const NodeMesh>> meshes,
                         const StackDensities& densities, const LevelErrors& levels)
    : octree_(octree), nodes_(nodes), meshes_(meshes), densities_(densities), levels_(levels) {
  plant_trees();
}

// Nodes beside coarser or finer ones alone are drawn otherwise than among their equals.
void DrawnErrors::plant_trees() {
  fitted_.assign(nodes_.size(), 0);
  trees_.resize(nodes_.size());
  parallel_for(static_cast<std::int64_t>(nodes_.size()), 4, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    const Surroundings around = octree_.surroundings(nodes_[k]);
    fitted_[k] = std::any_of(around.begin(), around.end(), [](Beside beside) {
      return beside == Beside::Coarser || beside == Beside::Finer;
    });
    if (fitted_[k] != 0) trees_[k] = TriangleTree(triangles_of(*meshes_[k], densities_));
  });
  for (std::size_t k = 0; k < nodes_.size(); ++k) place_.emplace(nodes_[k], k);
}

double DrawnErrors::fine_m(const Node& node) const {
  return static_cast<double>(1 << node.level) * densities_.field().voxel_m / 64.0;
}

// Every drawn tree within a node, or that of the node which holds it.
void DrawnErrors::collect(const Node& node, std::vector<const TriangleTree*>& trees) const {
  if (!octree_.is_inside(node)) return;
  Node holder = node;
  while (holder.level < octree_.root_level() && !octree_.exists(holder)) holder = holder.parent();
  const auto found = place_.find(holder);
  if (found != place_.end()) {
    const NodeError* own = levels_.find(holder);
    const TriangleTree* tree = fitted_[found->second] != 0 ? &trees_[found->second]
                               : own != nullptr            ? &own->triangles
                                                           : nullptr;
    if (tree != nullptr && !tree->triangles().empty() &&
        std::find(trees.begin(), trees.end(), tree) == trees.end())
      trees.push_back(tree);
    return;
  }
  for (int k = 0; k < 8; ++k) collect(holder.child(k), trees);
}

double DrawnErrors::drawn_to_finest(std::size_t k) const {
  const Node& node = nodes_[k];
  const NodeError* own = levels_.find(node);
  if (fitted_[k] == 0) return own == nullptr ? 0.0 : own->to_finest_m;
  if (trees_[k].triangles().empty()) return 0.0;
  double around = 0.0;
  for_each_around(node, [&](const Node& beside) {
    const NodeError* error = levels_.find(beside);
    if (error != nullptr) around = std::max(around, error->to_finest_m);
  });
  return around + distance_bound(trees_[k].triangles(), levels_.trees_around(node), fine_m(node));
}

double DrawnErrors::level_to_drawn(const Node& node) const {
  const NodeError* own = levels_.find(node);
  if (own == nullptr || own->triangles.triangles().empty()) return 0.0;
  const auto found = place_.find(node);
  if (found != place_.end() && fitted_[found->second] == 0) return 0.0;
  std::vector<const TriangleTree*> trees;
  for_each_around(node, [&](const Node& beside) { collect(beside, trees); });
  return distance_bound(own->triangles.triangles(), trees, fine_m(node));
}

std::vector<double> DrawnErrors::bounds_m() {
  // The level's own surface around fitted nodes, each place once.
  std::vector<Node> asked;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (levels_.find(nodes_[k]) != nullptr)
      for_each_around(nodes_[k], [&](const Node& beside) { asked.push_back(beside); });
  }
  std::sort(asked.begin(), asked.end());
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  std::vector<double> missed(asked.size());
  parallel_for(static_cast<std::int64_t>(asked.size()), 1, [&](std::int64_t k) {
    missed[static_cast<std::size_t>(k)] = level_to_drawn(asked[static_cast<std::size_t>(k)]);
  });
  std::vector<double> bounds(nodes_.size());
  parallel_for(static_cast<std::int64_t>(nodes_.size()), 1, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    const NodeError* own = levels_.find(nodes_[k]);
    double around = 0.0;
    for_each_around(nodes_[k], [&](const Node& beside) {
      const auto found = std::lower_bound(asked.begin(), asked.end(), beside);
      if (found != asked.end() && *found == beside)
        around = std::max(around, missed[static_cast<std::size_t>(found - asked.begin())]);
    });
    const double from_finest = own == nullptr ? 0.0 : own->from_finest_m + around;
    bounds[k] = std::max(drawn_to_finest(k), from_finest);
  });
  return bounds;
}

}  // namespace plumb::mesh::stacks
