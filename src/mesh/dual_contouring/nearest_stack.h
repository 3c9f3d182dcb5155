// Which stack stands in for a hole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/stacks/stack_field.h"

namespace plumb::mesh::dual_contouring {

/// For each stack of a field itself, for each hole the nearest stack that is none: the smallest
/// distance in columns; of several the lowest row, then the lowest column.
///
///   Throws std::invalid_argument for a field that has holes alone.
class NearestStacks {
 public:
  explicit NearestStacks(const terrain::StackField& field);

  /// The index of the stack that stands for (i, j), which may lie beyond the field's border: then
  /// it is the border column's.
  std::size_t at(int i, int j) const;

 private:
  int columns_, rows_;
  std::vector<std::uint32_t> index_;  // empty where there is no hole
};

}  // namespace plumb::mesh::dual_contouring
