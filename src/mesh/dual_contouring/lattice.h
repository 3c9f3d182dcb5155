// Values at the centres of voxels, by their three indices.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/check.h"

namespace plumb::mesh::dual_contouring {

/// A box of samples (or of cells): from `low` up to, not including, low + size.
struct LatticeBox {
  glm::ivec3 low{0}, size{0};

  glm::ivec3 high() const { return low + size; }
  bool contains(const glm::ivec3& p) const {
    const glm::ivec3 q = p - low;
    return q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x < size.x && q.y < size.y && q.z < size.z;
  }
  std::size_t count() const {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
  }
  /// x fastest, then y, then z.
  std::size_t index(const glm::ivec3& p) const {
    const glm::ivec3 q = p - low;
    return (static_cast<std::size_t>(q.z) * static_cast<std::size_t>(size.y) +
            static_cast<std::size_t>(q.y)) *
               static_cast<std::size_t>(size.x) +
           static_cast<std::size_t>(q.x);
  }
  glm::ivec3 at(std::size_t index) const {
    const auto x = static_cast<std::size_t>(size.x), y = static_cast<std::size_t>(size.y);
    return low + glm::ivec3(static_cast<int>(index % x), static_cast<int>(index / x % y),
                            static_cast<int>(index / x / y));
  }
  /// Wider by `margin` on every side; narrower where it is negative.
  LatticeBox grown(int margin) const { return {low - margin, size + 2 * margin}; }

  friend bool operator==(const LatticeBox&, const LatticeBox&) = default;
};

/// How many slices of so many samples each are worth a task of their own.
inline std::int64_t slices_a_task(std::size_t samples) {
  constexpr std::size_t kSamples = 1 << 14;
  return static_cast<std::int64_t>(kSamples / std::max<std::size_t>(1, samples)) + 1;
}

/// A value for each index of a box. T is not bool.
template <class T>
class Lattice {
 public:
  Lattice() = default;
  explicit Lattice(const LatticeBox& box, T fill = T{}) : box_(box) {
    require(box.size.x >= 0 && box.size.y >= 0 && box.size.z >= 0,
            "a lattice's size must be >= 0, got {} x {} x {}", box.size.x, box.size.y, box.size.z);
    values_.assign(box.count(), fill);
  }

  const LatticeBox& box() const { return box_; }
  T& operator()(const glm::ivec3& p) { return values_[box_.index(p)]; }
  const T& operator()(const glm::ivec3& p) const { return values_[box_.index(p)]; }
  /// The values along x of row (y, z).
  std::span<T> row(int y, int z) {
    return {values_.data() + box_.index({box_.low.x, y, z}), static_cast<std::size_t>(box_.size.x)};
  }
  std::span<const T> row(int y, int z) const {
    return {values_.data() + box_.index({box_.low.x, y, z}), static_cast<std::size_t>(box_.size.x)};
  }
  std::vector<T>& values() { return values_; }
  const std::vector<T>& values() const { return values_; }

  friend bool operator==(const Lattice&, const Lattice&) = default;

 private:
  LatticeBox box_;
  std::vector<T> values_;
};

}  // namespace plumb::mesh::dual_contouring
