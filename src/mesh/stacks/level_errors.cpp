#include "mesh/stacks/level_errors.h"

#include <algorithm>

#include "core/parallel.h"
#include "mesh/stacks/surface_distance.h"

namespace plumb::mesh::stacks {
namespace {

// Pieces of another surface nearer than this part of a voxel are near enough not to be cut.
constexpr double kFineVoxels = 1.0 / 64.0;

Surroundings alone() {
  Surroundings around{};
  around.fill(Beside::Same);
  return around;
}

// The places of the children of a node and of those beside them: 4 x 4 x 4 of the next finer level.
template <class Visit>
void for_each_finer_around(const Node& node, const Visit& visit) {
  for (int k = 0; k < 64; ++k)
    visit(Node{node.level - 1, 2 * node.at + glm::ivec3(k % 4 - 1, k / 4 % 4 - 1, k / 16 - 1)});
}

std::vector<Node> nodes_of(const Octree& octree, int level) {
  std::vector<Node> nodes;
  const glm::ivec3 size = octree.size(level);
  const glm::ivec3 count = (size + (kNodeVoxels - 1)) / kNodeVoxels;
  for (int z = 0; z < count.z; ++z)
    for (int y = 0; y < count.y; ++y)
      for (int x = 0; x < count.x; ++x) nodes.push_back({level, {x, y, z}});
  return nodes;
}

}  // namespace

std::vector<Corners> triangles_of(const NodeMesh& mesh, const StackDensities& densities) {
  std::vector<glm::dvec3> places;
  for (const glm::dvec3& position : mesh.position) places.push_back(densities.metres(position));
  std::vector<Corners> triangles;
  for (const Face& face : mesh.faces) {
    triangles.push_back({places[face[0]], places[face[1]], places[face[2]]});
    if (face[3] != kNoCorner)
      triangles.push_back({places[face[0]], places[face[2]], places[face[3]]});
  }
  return triangles;
}

LevelErrors::LevelErrors(const StackDensities& densities, NodeCache& cache)
    : densities_(&densities) {
  const Octree octree(densities.size());
  levels_.resize(static_cast<std::size_t>(octree.root_level()) + 1);
  for (int level = 0; level <= octree.root_level(); ++level) add_level(level, octree, cache);
}

const NodeError* LevelErrors::find(const Node& node) const {
  if (node.level < 0 || node.level >= static_cast<int>(levels_.size())) return nullptr;
  const Level& level = levels_[static_cast<std::size_t>(node.level)];
  const auto found = level.find(node);
  return found == level.end() ? nullptr : &found->second;
}

double LevelErrors::worst_m(const Node& node) const {
  const NodeError* error = find(node);
  return error == nullptr ? 0.0 : error->worst_m();
}

std::vector<const TriangleTree*> LevelErrors::trees_around(const Node& node) const {
  std::vector<const TriangleTree*> trees;
  for_each_around(node, [&](const Node& beside) {
    const NodeError* error = find(beside);
    if (error != nullptr && !error->triangles.triangles().empty())
      trees.push_back(&error->triangles);
  });
  return trees;
}

// A node of a coarser level is kept where it or anything finer within it has a surface.
void LevelErrors::add_level(int level, const Octree& octree, NodeCache& cache) {
  const std::vector<Node> nodes = nodes_of(octree, level);
  std::vector<NodeError> errors(nodes.size());
  parallel_for(static_cast<std::int64_t>(nodes.size()), 1, [&](std::int64_t k) {
    const auto at = static_cast<std::size_t>(k);
    errors[at].triangles = TriangleTree(triangles_of(*cache.mesh(nodes[at], alone()), *densities_));
  });
  Level& here = levels_[static_cast<std::size_t>(level)];
  std::vector<Node> kept;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    bool is_kept = !errors[k].triangles.triangles().empty();
    for (int child = 0; level > 0 && child < 8; ++child)
      is_kept = is_kept || find(nodes[k].child(child)) != nullptr;
    if (!is_kept) continue;
    kept.push_back(nodes[k]);
    here.emplace(nodes[k], std::move(errors[k]));
  }
  if (level == 0) return;
  std::vector<double> from_finer(kept.size());
  parallel_for(static_cast<std::int64_t>(kept.size()), 1, [&](std::int64_t k) {
    const auto at = static_cast<std::size_t>(k);
    from_finer[at] = step_from_finer(kept[at]);
    NodeError& error = here.find(kept[at])->second;
    error.to_finest_m = step_to_finer(kept[at], error);
  });
  sum_up(kept, from_finer);
}

// What the finer surface of a node's children misses here, and of those around: a point of the
// finest surface may go to a neighbour's first.
void LevelErrors::sum_up(const std::vector<Node>& nodes, const std::vector<double>& from_finer) {
  std::unordered_map<Node, double, NodeHash> step;
  for (std::size_t k = 0; k < nodes.size(); ++k) step.emplace(nodes[k], from_finer[k]);
  Level& here = levels_[static_cast<std::size_t>(nodes.empty() ? 0 : nodes.front().level)];
  for (const Node& node : nodes) {
    double finer = 0.0, around = 0.0;
    for (int child = 0; child < 8; ++child) {
      const NodeError* error = find(node.child(child));
      if (error != nullptr) finer = std::max(finer, error->from_finest_m);
    }
    for_each_around(node, [&](const Node& beside) {
      const auto found = step.find(beside);
      if (found != step.end()) around = std::max(around, found->second);
    });
    here.find(node)->second.from_finest_m = finer + around;
  }
}

double LevelErrors::step_to_finer(const Node& node, const NodeError& error) const {
  if (error.triangles.triangles().empty()) return 0.0;
  std::vector<const TriangleTree*> trees;
  double finer = 0.0;
  for_each_finer_around(node, [&](const Node& child) {
    const NodeError* found = find(child);
    if (found == nullptr) return;
    finer = std::max(finer, found->to_finest_m);
    if (!found->triangles.triangles().empty()) trees.push_back(&found->triangles);
  });
  return finer + distance_bound(error.triangles.triangles(), trees, fine_m(node.level));
}

double LevelErrors::step_from_finer(const Node& node) const {
  const std::vector<const TriangleTree*> trees = trees_around(node);
  double largest = 0.0;
  for (int k = 0; k < 8; ++k) {
    const NodeError* child = find(node.child(k));
    if (child != nullptr)
      largest = distance_bound(child->triangles.triangles(), trees, fine_m(node.level), largest);
  }
  return largest;
}

double LevelErrors::fine_m(int level) const {
  return kFineVoxels * static_cast<double>(1 << level) * densities_->field().voxel_m;
}

}  // namespace plumb::mesh::stacks
