#include "mesh/stacks/joined_surface.h"

#include <bit>

namespace plumb::mesh::stacks {
namespace {

std::uint64_t hash_of(const VertexName& name) {
  std::uint64_t x = static_cast<std::uint32_t>(name.cell.x);
  x = x * 0x9e3779b97f4a7c15ULL + static_cast<std::uint32_t>(name.cell.y);
  x = x * 0x9e3779b97f4a7c15ULL + static_cast<std::uint32_t>(name.cell.z);
  x = x * 0x9e3779b97f4a7c15ULL + static_cast<std::uint32_t>(4 * name.level + name.loop);
  return x ^ x >> 29;
}

// Nodes of a level meet at multiples of 16 of its voxels, those of finer levels at a coarser node
// too: a cell that several of them have reaches over such a place.
bool may_be_shared(const VertexName& name) {
  constexpr int kLast = kNodeVoxels - 1;
  return (name.cell.x & kLast) == kLast || (name.cell.y & kLast) == kLast ||
         (name.cell.z & kLast) == kLast;
}

// Vertices by name: their indices, each at the first free place from its hash on.
class SharedVertices {
 public:
  /// At most half of the places are taken.
  explicit SharedVertices(std::size_t most) : index_(std::bit_ceil(2 * most + 1), kNoCorner) {}

  /// The vertex of that name among `names`, or else `next`, which is then to be the next of them.
  std::uint32_t find_or_add(const std::vector<VertexName>& names, const VertexName& name,
                            std::uint32_t next) {
    const std::size_t last = index_.size() - 1;
    std::size_t at = hash_of(name) & last;
    while (index_[at] != kNoCorner && !(names[index_[at]] == name)) at = (at + 1) & last;
    if (index_[at] == kNoCorner) index_[at] = next;
    return index_[at];
  }

 private:
  std::vector<std::uint32_t> index_;
};

// Room for all vertices and faces; how many vertices may be shared.
std::size_t reserve(std::span<const NodeMesh* const> meshes, JoinedSurface& surface) {
  std::size_t vertices = 0, faces = 0, shared = 0, colours = 0;
  for (const NodeMesh* mesh : meshes) {
    vertices += mesh->names.size();
    faces += mesh->faces.size();
    colours += mesh->colour.size();
    for (const VertexName& name : mesh->names) shared += may_be_shared(name) ? 1 : 0;
  }
  surface.names.reserve(vertices);
  surface.position.reserve(vertices);
  surface.normal.reserve(vertices);
  surface.colour.reserve(colours);
  surface.faces.reserve(faces);
  surface.first_face.reserve(meshes.size() + 1);
  return shared;
}

}  // namespace

JoinedSurface joined(std::span<const NodeMesh* const> meshes) {
  JoinedSurface surface;
  SharedVertices shared(reserve(meshes, surface));
  std::vector<std::uint32_t> index;
  for (const NodeMesh* mesh : meshes) {
    surface.first_face.push_back(static_cast<std::uint32_t>(surface.faces.size()));
    index.resize(mesh->names.size());
    for (std::size_t k = 0; k < mesh->names.size(); ++k) {
      const auto next = static_cast<std::uint32_t>(surface.names.size());
      index[k] = next;
      if (may_be_shared(mesh->names[k]))
        index[k] = shared.find_or_add(surface.names, mesh->names[k], next);
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
