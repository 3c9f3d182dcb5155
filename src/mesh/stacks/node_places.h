// Which of the places around a node samples lie in.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

#include "mesh/stacks/octree.h"

namespace plumb::mesh::stacks {

/// Bit k: the place k of Surroundings.
using PlaceBits = std::uint32_t;

/// The places around a node as the samples of one level see them.
class NodePlaces {
 public:
  /// low       the node's first sample
  /// per_node  samples along its side
  NodePlaces(const Surroundings& around, const glm::ivec3& low, int per_node)
      : low_(low), per_node_(per_node) {
    for (std::size_t k = 0; k < around.size(); ++k)
      kinds_[static_cast<std::size_t>(around[k])] |= PlaceBits{1} << k;
  }

  /// The places of one kind.
  PlaceBits kind(Beside beside) const { return kinds_[static_cast<std::size_t>(beside)]; }

  /// The places that samples from `first` to `last` along an axis may lie in, wherever they are on
  /// the others: less than a node lies between the two.
  PlaceBits along(int axis, int first, int last) const {
    return kThirds[axis][third(axis, first)] | kThirds[axis][third(axis, last)];
  }
  /// Of all samples from a corner to another one.
  PlaceBits of(const glm::ivec3& first, const glm::ivec3& last) const {
    return along(0, first.x, last.x) & along(1, first.y, last.y) & along(2, first.z, last.z);
  }

 private:
  int third(int axis, int sample) const {
    const int at = sample - low_[axis];
    return at < 0 ? 0 : at < per_node_ ? 1 : 2;
  }

  // Places before, beside and beyond the node along each axis.
  static constexpr PlaceBits kThirds[3][3] = {{0x1249249, 0x2492492, 0x4924924},
                                              {0x01c0e07, 0x0e07038, 0x70381c0},
                                              {0x00001ff, 0x003fe00, 0x7fc0000}};

  glm::ivec3 low_;
  int per_node_;
  std::array<PlaceBits, 4> kinds_{};
};

}  // namespace plumb::mesh::stacks
