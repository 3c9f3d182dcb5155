#include "mesh/stacks/joined_surface.h"

#include <unordered_map>

namespace plumb::mesh::stacks {
namespace {

struct NameHash {
  std::size_t operator()(const VertexName& name) const {
    std::uint64_t x = static_cast<std::uint32_t>(name.cell.x);
    x = x * 0x9e3779b97f4a7c15ULL + static_cast<std::uint32_t>(name.cell.y);
    x = x * 0x9e3779b97f4a7c15ULL + static_cast<std::uint32_t>(name.cell.z);
    x = x * 0x9e3779b97f4a7c15ULL + static_cast<std::uint32_t>(4 * name.level + name.loop);
    return x ^ x >> 29;
  }
};

// Nodes of a level meet at multiples of 16 of its voxels, those of finer levels at a coarser node
// too: a cell that several of them have reaches over such a place.
bool may_be_shared(const VertexName& name) {
  constexpr int kLast = kNodeVoxels - 1;
  return (name.cell.x & kLast) == kLast || (name.cell.y & kLast) == kLast ||
         (name.cell.z & kLast) == kLast;
}

}  // namespace

JoinedSurface joined(std::span<const NodeMesh* const> meshes) {
  JoinedSurface surface;
  std::unordered_map<VertexName, std::uint32_t, NameHash> shared;
  std::vector<std::uint32_t> index;
  for (const NodeMesh* mesh : meshes) {
    surface.first_face.push_back(static_cast<std::uint32_t>(surface.faces.size()));
    index.resize(mesh->names.size());
    for (std::size_t k = 0; k < mesh->names.size(); ++k) {
      const auto next = static_cast<std::uint32_t>(surface.names.size());
      index[k] = next;
      if (may_be_shared(mesh->names[k]))
        index[k] = shared.try_emplace(mesh->names[k], next).first->second;
      if (index[k] != next) continue;
      surface.names.push_back(mesh->names[k]);
      surface.position.push_back(mesh->position[k]);
      surface.normal.push_back(mesh->normal[k]);
      if (!mesh->colour.empty()) surface.colour.push_back(mesh->colour[k]);
    }
    for (Face face : mesh->faces) {
      for (std::uint32_t& corner : face) corner = corner == kNoCorner ? kNoCorner : index[corner];
      surface.faces.push_back(face);
    }
  }
  surface.first_face.push_back(static_cast<std::uint32_t>(surface.faces.size()));
  return surface;
}

}  // namespace plumb::mesh::stacks
