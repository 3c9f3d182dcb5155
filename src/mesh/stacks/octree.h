// Which nodes of the octree over a field of stacks are drawn.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_set>
#include <vector>

namespace plumb::mesh::stacks {

/// A node of level L holds 16 x 16 x 16 voxels of that level: from 16 * at on.
struct Node {
  int level = 0;
  glm::ivec3 at{0};

  Node parent() const { return {level + 1, {at.x >> 1, at.y >> 1, at.z >> 1}}; }
  Node child(int k) const {
    return {level - 1, {2 * at.x + (k & 1), 2 * at.y + (k >> 1 & 1), 2 * at.z + (k >> 2)}};
  }
  friend bool operator==(const Node&, const Node&) = default;
  /// By level, the finest first, then by z, y and x.
  friend bool operator<(const Node& a, const Node& b) {
    if (a.level != b.level) return a.level < b.level;
    if (a.at.z != b.at.z) return a.at.z < b.at.z;
    return a.at.y != b.at.y ? a.at.y < b.at.y : a.at.x < b.at.x;
  }
};

constexpr int kNodeVoxels = 16;

/// For looking nodes up.
struct NodeHash {
  std::size_t operator()(const Node& node) const {
    std::uint64_t x = static_cast<std::uint32_t>(node.level);
    for (int axis = 0; axis < 3; ++axis)
      x = x * 0x9e3779b97f4a7c15ULL + static_cast<std::uint32_t>(node.at[axis]);
    return static_cast<std::size_t>(x ^ x >> 31);
  }
};

/// What lies beside a node, as it sees it.
enum class Beside : std::uint8_t {
  Same,     // a node of its own level
  Finer,    // that is divided further
  Coarser,  // that a coarser node covers
  Outside,  // beyond the field
};

/// The 27 places around a node, itself in the middle: index 13 + dx + 3 dy + 9 dz.
using Surroundings = std::array<Beside, 27>;

/// True where a node is to be divided.
using Split = std::function<bool(const Node&)>;

/// The nodes that are drawn: a partition of a field's voxels. Nodes wholly beyond the field are
/// none.
class Octree {
 public:
  /// size  the finest level's voxels, each at least 1 and at most 2^24
  explicit Octree(const glm::ivec3& size);

  /// The level of the one node that holds everything.
  int root_level() const { return root_level_; }
  Node root() const { return {root_level_, glm::ivec3(0)}; }
  /// Voxels of a level: the finest's, halved and rounded up.
  glm::ivec3 size(int level) const;
  bool is_inside(const Node& node) const;

  /// Divides from the root down wherever `split` asks for it; nodes of level 0 are never divided.
  void divide(const Split& split);
  /// Divides the coarser of any two drawn nodes that touch, at faces, edges or corners, and differ
  /// by more than one level, until none is left. The result is the least such refinement.
  void balance();
  /// Divides one drawn node, and nothing else.
  void divide(const Node& node);

  /// Draws a node in place of its children, which are drawn, and nothing else.
  void merge(const Node& node);

  /// Drawn, or divided further.
  bool exists(const Node& node) const;
  bool is_divided(const Node& node) const;
  bool is_drawn(const Node& node) const { return exists(node) && !is_divided(node); }
  /// Every drawn node, sorted.
  std::vector<Node> drawn() const;
  /// Of a drawn node of a balanced tree.
  Surroundings surroundings(const Node& node) const;
  /// True if no two touching nodes differ by more than one level.
  bool is_balanced() const;

 private:
  static std::uint64_t key(const glm::ivec3& at);
  void ensure(const Node& node);

  glm::ivec3 size_;
  int root_level_ = 0;
  std::vector<std::unordered_set<std::uint64_t>> nodes_;  // a set a level: those that exist
};

}  // namespace plumb::mesh::stacks
