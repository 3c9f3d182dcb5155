#include "mesh/stacks/amortised_tree.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace plumb::mesh::stacks {
namespace {

using DrawnNodes = std::map<Node, Surroundings>;

DrawnNodes drawn_nodes(const Octree& tree) {
  DrawnNodes nodes;
  for (const Node& node : tree.drawn()) nodes.emplace(node, tree.surroundings(node));
  return nodes;
}

// Meshes of nodes that are others than before.
int updated_between(const DrawnNodes& before, const DrawnNodes& after,
                    const AmortisedTree::HasMesh& has_mesh) {
  int updated = 0;
  for (const auto& [node, around] : after) {
    const auto found = before.find(node);
    if (found != before.end() && found->second == around) continue;
    updated += !has_mesh || has_mesh(node, around) ? 1 : 0;
  }
  return updated;
}

}  // namespace

// Its children are drawn, the aim does not divide it, and nothing beside it is finer than they are.
bool AmortisedTree::may_merge(const Node& node, const Octree& aim) const {
  if (!tree_.is_divided(node) || aim.is_divided(node)) return false;
  for (int k = 0; k < 8; ++k) {
    if (tree_.is_divided(node.child(k))) return false;
  }
  bool fits = true;
  for (int k = 0; k < 64 && fits; ++k) {
    const Node beside{node.level - 1,
                      2 * node.at + glm::ivec3(k % 4 - 1, k / 4 % 4 - 1, k / 16 - 1)};
    fits = !tree_.is_divided(beside);
  }
  return fits;
}

// The coarsest splits first, then the finest merges.
std::vector<Node> AmortisedTree::wanted(const Octree& aim) const {
  std::vector<Node> nodes, merges;
  for (const Node& node : tree_.drawn()) {
    if (aim.is_divided(node)) nodes.push_back(node);
    if (node.level < tree_.root_level() && may_merge(node.parent(), aim))
      merges.push_back(node.parent());
  }
  std::reverse(nodes.begin(), nodes.end());
  std::sort(merges.begin(), merges.end());
  merges.erase(std::unique(merges.begin(), merges.end()), merges.end());
  nodes.insert(nodes.end(), merges.begin(), merges.end());
  return nodes;
}

// Every change that is wanted and possible now; false if there was none.
bool AmortisedTree::pass(const Octree& aim, int budget, TreeChange& change) {
  bool changed = false;
  change.wanting = 0;
  DrawnNodes now = drawn_nodes(tree_);
  for (const Node& node : wanted(aim)) {
    const bool is_split = aim.is_divided(node);
    if (is_split ? !tree_.is_drawn(node) : !may_merge(node, aim)) continue;
    Octree next = tree_;
    if (is_split) {
      next.divide(node);
      next.balance();
    } else {
      next.merge(node);
    }
    DrawnNodes then = drawn_nodes(next);
    const int updated = updated_between(now, then, has_mesh_);
    if (budget > 0 && change.updated > 0 && change.updated + updated > budget) {
      ++change.wanting;
      continue;
    }
    change.updated += updated;
    ++(is_split ? change.splits : change.merges);
    tree_ = std::move(next);
    now = std::move(then);
    changed = true;
  }
  return changed;
}

TreeChange AmortisedTree::step(const Octree& aim, int budget) {
  TreeChange change;
  while (pass(aim, budget, change)) {
  }
  return change;
}

}  // namespace plumb::mesh::stacks
