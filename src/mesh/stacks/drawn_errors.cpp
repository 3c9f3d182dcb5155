#include "mesh/stacks/drawn_errors.h"

#include <algorithm>

#include "core/parallel.h"
#include "mesh/stacks/surface_distance.h"

namespace plumb::mesh::stacks {

DrawnErrors::DrawnErrors(const StackDensities& densities, const LevelErrors& levels)
    : densities_(densities), levels_(levels) {}

bool DrawnErrors::is_fitted(const Drawn& drawn, const Node& node) const {
  const NodeError* own = levels_.find(node);
  return drawn.trees.at(node) != (own == nullptr ? nullptr : &own->triangles);
}

// Nodes beside coarser or finer ones alone are drawn otherwise than among their equals.
void DrawnErrors::plant(Drawn& drawn, std::span<const std::shared_ptr<const NodeMesh>> meshes) {
  std::vector<std::size_t> fitted;
  for (std::size_t k = 0; k < drawn.nodes.size(); ++k) {
    const Surroundings around = drawn.octree.surroundings(drawn.nodes[k]);
    const bool is_fitted = std::any_of(around.begin(), around.end(), [](Beside beside) {
      return beside == Beside::Coarser || beside == Beside::Finer;
    });
    const NodeError* own = levels_.find(drawn.nodes[k]);
    if (is_fitted && !meshes[k]->faces.empty()) {
      fitted.push_back(k);
      planted_.try_emplace(meshes[k].get());
      drawn.trees.emplace(drawn.nodes[k], &planted_.find(meshes[k].get())->second);
    } else {
      const bool is_own = own != nullptr && !is_fitted;
      drawn.trees.emplace(drawn.nodes[k], is_own ? &own->triangles : nullptr);
    }
  }
  parallel_for(static_cast<std::int64_t>(fitted.size()), 1, [&](std::int64_t i) {
    const std::size_t k = fitted[static_cast<std::size_t>(i)];
    TriangleTree& tree = planted_.find(meshes[k].get())->second;
    if (tree.triangles().empty()) tree = TriangleTree(triangles_of(*meshes[k], densities_));
  });
}

// Every drawn tree within a node, or that of the node which holds it.
void DrawnErrors::collect(const Drawn& drawn, const Node& node,
                          std::vector<const TriangleTree*>& trees) const {
  if (!drawn.octree.is_inside(node)) return;
  Node holder = node;
  while (!drawn.octree.exists(holder)) holder = holder.parent();
  const auto found = drawn.trees.find(holder);
  if (found == drawn.trees.end()) {
    for (int k = 0; k < 8; ++k) collect(drawn, holder.child(k), trees);
  } else if (found->second != nullptr &&
             std::find(trees.begin(), trees.end(), found->second) == trees.end()) {
    trees.push_back(found->second);
  }
}

DrawnErrors::Asked DrawnErrors::around(const Drawn& drawn, const Node& node) const {
  Asked asked{node, {}};
  for_each_around(node, [&](const Node& beside) { collect(drawn, beside, asked.second); });
  return asked;
}

// By how much a level's own surface is missed where something else is drawn: at every place of a
// wanted node's level that is beside it.
void DrawnErrors::measure_levels(Drawn& drawn, std::span<const std::uint8_t> wanted) {
  std::vector<Asked> asked;
  for (std::size_t k = 0; k < drawn.nodes.size(); ++k) {
    if (wanted[k] == 0 || levels_.find(drawn.nodes[k]) == nullptr) continue;
    for_each_around(drawn.nodes[k], [&](const Node& beside) {
      const NodeError* own = levels_.find(beside);
      if (own == nullptr || own->triangles.triangles().empty()) return;
      const auto tree = drawn.trees.find(beside);
      if (tree != drawn.trees.end() && tree->second == &own->triangles) return;
      if (drawn.missed.emplace(beside, 0.0).second) asked.push_back(around(drawn, beside));
    });
  }
  std::vector<double> measured(asked.size());
  parallel_for(static_cast<std::int64_t>(asked.size()), 1, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    const auto known = measured_.find(asked[k]);
    measured[k] = known != measured_.end()
                      ? known->second
                      : distance_bound(levels_.find(asked[k].first)->triangles.triangles(),
                                       asked[k].second, levels_.fine_m(asked[k].first.level));
  });
  for (std::size_t k = 0; k < asked.size(); ++k) {
    drawn.missed[asked[k].first] = measured[k];
    measured_.try_emplace(std::move(asked[k]), measured[k]);
  }
}

double DrawnErrors::drawn_to_finest(const Drawn& drawn, const Node& node) const {
  const NodeError* own = levels_.find(node);
  if (!is_fitted(drawn, node)) return own == nullptr ? 0.0 : own->to_finest_m;
  const TriangleTree* tree = drawn.trees.at(node);
  if (tree == nullptr) return 0.0;
  double around = 0.0;
  for_each_around(node, [&](const Node& beside) {
    const NodeError* error = levels_.find(beside);
    if (error != nullptr) around = std::max(around, error->to_finest_m);
  });
  return around +
         distance_bound(tree->triangles(), levels_.trees_around(node), levels_.fine_m(node.level));
}

std::vector<double> DrawnErrors::bounds_m(const Octree& octree, std::span<const Node> nodes,
                                          std::span<const std::shared_ptr<const NodeMesh>> meshes,
                                          std::span<const std::uint8_t> wanted) {
  Drawn drawn{octree, nodes};
  plant(drawn, meshes);
  measure_levels(drawn, wanted);
  std::vector<double> bounds(nodes.size(), 0.0);
  parallel_for(static_cast<std::int64_t>(nodes.size()), 1, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    if (wanted[k] == 0) return;
    const NodeError* own = levels_.find(nodes[k]);
    double around = 0.0;
    for_each_around(nodes[k], [&](const Node& beside) {
      const auto missed = drawn.missed.find(beside);
      if (missed != drawn.missed.end()) around = std::max(around, missed->second);
    });
    bounds[k] = std::max(drawn_to_finest(drawn, nodes[k]),
                         own == nullptr ? 0.0 : own->from_finest_m + around);
  });
  return bounds;
}

}  // namespace plumb::mesh::stacks
