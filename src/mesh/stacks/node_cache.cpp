#include "mesh/stacks/node_cache.h"

#include "core/parallel.h"
#include "mesh/stacks/node_colours.h"

namespace plumb::mesh::stacks {
namespace {

// Two bits a place. Where nothing coarser or finer is near, what lies beyond the field changes no
// mesh.
std::uint64_t packed(const Surroundings& around) {
  std::uint64_t key = 0;
  bool is_alike = true;
  for (const Beside beside : around) {
    key = key << 2 | static_cast<std::uint64_t>(beside);
    is_alike = is_alike && (beside == Beside::Same || beside == Beside::Outside);
  }
  return is_alike ? 0 : key;
}

}  // namespace

std::vector<std::shared_ptr<const NodeMesh>> NodeCache::meshes(const Octree& octree,
                                                               std::span<const Node> nodes) {
  std::vector<std::shared_ptr<const NodeMesh>> found(nodes.size());
  std::vector<Surroundings> around(nodes.size());
  std::vector<std::size_t> missing;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      around[k] = octree.surroundings(nodes[k]);
      const auto mesh = meshes_.find({nodes[k], packed(around[k])});
      if (mesh != meshes_.end()) {
        found[k] = mesh->second;
      } else {
        missing.push_back(k);
      }
    }
  }
  parallel_for(static_cast<std::int64_t>(missing.size()), 1, [&](std::int64_t i) {
    const std::size_t k = missing[static_cast<std::size_t>(i)];
    found[k] = made(nodes[k], around[k]);
  });
  // Another thread may have been faster: its mesh is the one that is kept.
  const std::lock_guard lock(mutex_);
  for (const std::size_t k : missing)
    found[k] = meshes_.try_emplace({nodes[k], packed(around[k])}, found[k]).first->second;
  return found;
}

std::shared_ptr<const NodeMesh> NodeCache::mesh(const Node& node, const Surroundings& around) {
  const Key key{node, packed(around)};
  {
    const std::lock_guard lock(mutex_);
    const auto found = meshes_.find(key);
    if (found != meshes_.end()) return found->second;
  }
  std::shared_ptr<const NodeMesh> mesh = made(node, around);
  const std::lock_guard lock(mutex_);
  return meshes_.try_emplace(key, std::move(mesh)).first->second;
}

std::shared_ptr<const NodeMesh> NodeCache::made(const Node& node,
                                                const Surroundings& around) const {
  const auto densities = [this](int level, const dual_contouring::LatticeBox& box) {
    return (*densities_)(level, box);
  };
  auto mesh = std::make_shared<NodeMesh>(node_mesh(node, around, densities, options_));
  mesh->colour = node_colours(*mesh, *densities_);
  return mesh;
}

std::size_t NodeCache::bytes() const {
  const std::lock_guard lock(mutex_);
  std::size_t bytes = 0;
  for (const auto& [key, mesh] : meshes_) bytes += mesh->bytes();
  return bytes;
}

}  // namespace plumb::mesh::stacks
