#include "mesh/stacks/octree.h"

#include <algorithm>

#include "core/check.h"

namespace plumb::mesh::stacks {
namespace {

template <class Visit>
void for_each_beside(const Visit& visit) {
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) visit(13 + dx + 3 * dy + 9 * dz, glm::ivec3(dx, dy, dz));
}

constexpr std::uint64_t kBits = 21, kCoordinate = (std::uint64_t{1} << kBits) - 1;

glm::ivec3 place_of(std::uint64_t key) {
  return {static_cast<int>(key & kCoordinate), static_cast<int>(key >> kBits & kCoordinate),
          static_cast<int>(key >> 2 * kBits)};
}

}  // namespace

std::uint64_t Octree::key(const glm::ivec3& at) {
  return static_cast<std::uint64_t>(at.x) | static_cast<std::uint64_t>(at.y) << kBits |
         static_cast<std::uint64_t>(at.z) << 2 * kBits;
}

Octree::Octree(const glm::ivec3& size) : size_(size) {
  const int longest = std::max({size.x, size.y, size.z});
  require(std::min({size.x, size.y, size.z}) >= 1 && longest <= 1 << 24,
          "an octree must have 1 to 2^24 voxels a side, got {} x {} x {}", size.x, size.y, size.z);
  while (kNodeVoxels << root_level_ < longest) ++root_level_;
  nodes_.resize(static_cast<std::size_t>(root_level_) + 1);
  nodes_.back().insert(key(glm::ivec3(0)));
}

glm::ivec3 Octree::size(int level) const {
  const int round_up = (1 << level) - 1;
  return {(size_.x + round_up) >> level, (size_.y + round_up) >> level,
          (size_.z + round_up) >> level};
}

bool Octree::is_inside(const Node& node) const {
  const glm::ivec3 size = this->size(node.level);
  for (int axis = 0; axis < 3; ++axis) {
    if (node.at[axis] < 0 || node.at[axis] * kNodeVoxels >= size[axis]) return false;
  }
  return true;
}

bool Octree::exists(const Node& node) const {
  return node.level >= 0 && node.level <= root_level_ && is_inside(node) &&
         nodes_[static_cast<std::size_t>(node.level)].contains(key(node.at));
}

// The first child of a node inside the field is inside it too.
bool Octree::is_divided(const Node& node) const { return node.level > 0 && exists(node.child(0)); }

void Octree::divide(const Node& node) {
  require(node.level > 0 && is_drawn(node), "only a drawn node above level 0 can be divided");
  for (int k = 0; k < 8; ++k) {
    const Node child = node.child(k);
    if (is_inside(child)) nodes_[static_cast<std::size_t>(child.level)].insert(key(child.at));
  }
}

void Octree::merge(const Node& node) {
  require(is_divided(node), "only a divided node can be merged");
  for (int k = 0; k < 8; ++k) {
    const Node child = node.child(k);
    require(!is_divided(child), "a node whose children are divided cannot be merged");
    nodes_[static_cast<std::size_t>(child.level)].erase(key(child.at));
  }
}

void Octree::divide(const Split& split) {
  std::vector<Node> pending{root()};
  while (!pending.empty()) {
    const Node node = pending.back();
    pending.pop_back();
    if (node.level == 0) continue;
    if (!is_divided(node)) {
      if (!split(node)) continue;
      divide(node);
    }
    for (int k = 0; k < 8; ++k) {
      if (is_inside(node.child(k))) pending.push_back(node.child(k));
    }
  }
}

void Octree::ensure(const Node& node) {
  if (exists(node)) return;
  const Node parent = node.parent();
  ensure(parent);
  divide(parent);
}

// A node asks that beside it every node one level up exists; what that brings asks on its own level
// only.
void Octree::balance() {
  for (int level = 0; level + 1 < root_level_; ++level) {
    const auto& present = nodes_[static_cast<std::size_t>(level)];
    for (const std::uint64_t of : std::vector<std::uint64_t>(present.begin(), present.end())) {
      for_each_beside([&](int, const glm::ivec3& offset) {
        const Node beside{level, place_of(of) + offset};
        if (is_inside(beside)) ensure(beside.parent());
      });
    }
  }
}

std::vector<Node> Octree::drawn() const {
  std::vector<Node> nodes;
  for (int level = 0; level <= root_level_; ++level) {
    for (const std::uint64_t of : nodes_[static_cast<std::size_t>(level)]) {
      const Node node{level, place_of(of)};
      if (!is_divided(node)) nodes.push_back(node);
    }
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

Surroundings Octree::surroundings(const Node& node) const {
  Surroundings around{};
  for_each_beside([&](int k, const glm::ivec3& offset) {
    const Node beside{node.level, node.at + offset};
    around[static_cast<std::size_t>(k)] = !is_inside(beside)   ? Beside::Outside
                                          : !exists(beside)    ? Beside::Coarser
                                          : is_divided(beside) ? Beside::Finer
                                                               : Beside::Same;
  });
  return around;
}

bool Octree::is_balanced() const {
  for (const Node& node : drawn()) {
    bool fits = true;
    for_each_beside([&](int, const glm::ivec3& offset) {
      const Node beside{node.level, node.at + offset};
      if (is_inside(beside) && node.level + 1 < root_level_) fits = fits && exists(beside.parent());
    });
    if (!fits) return false;
  }
  return true;
}

}  // namespace plumb::mesh::stacks
