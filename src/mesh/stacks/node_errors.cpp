#include "mesh/stacks/node_errors.h"

#include <algorithm>

#include "mesh/stacks/surface_distance.h"

namespace plumb::mesh::stacks {
namespace {

// Parts along a node's side: 4 x 4 x 4 voxels each.
constexpr int kParts = 4;
// Bounds below this part of a node's voxel are tight enough: most errors are a few times that.
constexpr double kFineVoxels = 1.0 / 8.0;

// The part of a node's box that a triangle's middle lies in, or is nearest to.
std::size_t part_of(const Box& box, const Corners& triangle) {
  const glm::dvec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
  std::size_t part = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const double along = kParts * (middle[axis] - box.low[axis]) / (box.high[axis] - box.low[axis]);
    part = kParts * part + static_cast<std::size_t>(std::clamp(along, 0.0, kParts - 1.0));
  }
  return part;
}

// Looks up what is there under a lock, or makes it without one; what came first stays.
template <class Map, class Key, class Make>
typename Map::mapped_type found_or_made(std::mutex& mutex, Map& map, const Key& key,
                                        const Make& make) {
  {
    const std::lock_guard lock(mutex);
    const auto found = map.find(key);
    if (found != map.end()) return found->second;
  }
  typename Map::mapped_type made = make();
  const std::lock_guard lock(mutex);
  return map.try_emplace(key, std::move(made)).first->second;
}

}  // namespace

NodeErrors::NodeErrors(const StackDensities& densities, NodeCache& cache)
    : densities_(densities), finest_(densities, cache) {}

std::shared_ptr<const TriangleTree> NodeErrors::tree(const NodeMesh& mesh) {
  return found_or_made(mutex_, trees_, &mesh, [&] {
    return std::make_shared<const TriangleTree>(triangles_of(mesh, densities_));
  });
}

PartErrors NodeErrors::measured(const Node& node,
                                std::span<const std::span<const Corners>> triangles,
                                const Surface& surface) const {
  const Box box = densities_.box(node);
  std::vector<std::vector<Corners>> parts(kParts * kParts * kParts);
  for (const std::span<const Corners> some : triangles) {
    for (const Corners& triangle : some) parts[part_of(box, triangle)].push_back(triangle);
  }
  const double fine_m =
      kFineVoxels * static_cast<double>(1 << node.level) * densities_.field().voxel_m;
  PartErrors errors;
  for (const std::vector<Corners>& part : parts) {
    PartError error;
    error.bound_m = distance_bound(part, surface, fine_m);
    if (!(error.bound_m > 0.0)) continue;
    for (const Corners& triangle : part) {
      for (const glm::dvec3& corner : triangle) error.box.add(corner);
    }
    errors.push_back(error);
  }
  return errors;
}

std::shared_ptr<const PartErrors> NodeErrors::to_finest(const DrawnMesh& drawn) {
  return found_or_made(mutex_, to_finest_, drawn.mesh.get(), [&] {
    const auto tree = this->tree(*drawn.mesh);
    const std::span<const Corners> triangles = tree->triangles();
    return std::make_shared<const PartErrors>(
        measured(drawn.node, {&triangles, 1}, *finest_.around(drawn.node)));
  });
}

std::shared_ptr<const PartErrors> NodeErrors::from_finest(
    const Node& node, std::span<const std::shared_ptr<const NodeMesh>> meshes) {
  Asked asked{node, {}};
  for (const auto& mesh : meshes) {
    if (!mesh->faces.empty()) asked.second.push_back(mesh.get());
  }
  return found_or_made(mutex_, from_finest_, asked, [&] {
    std::vector<std::shared_ptr<const TriangleTree>> kept;
    std::vector<const TriangleTree*> trees;
    for (const NodeMesh* mesh : asked.second) {
      kept.push_back(tree(*mesh));
      trees.push_back(kept.back().get());
    }
    std::vector<std::span<const Corners>> triangles;
    for (const TriangleTree* finest : finest_.within(node))
      triangles.push_back(finest->triangles());
    return std::make_shared<const PartErrors>(
        measured(node, triangles, TreesTogether(std::move(trees))));
  });
}

}  // namespace plumb::mesh::stacks
