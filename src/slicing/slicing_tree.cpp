#include "slicing/slicing_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/memory.h"
#include "core/parallel.h"

namespace plumb::slicing {
namespace {

using terrain::Heightfield;

int levels_for(const Heightfield& field, int leaf_cells) {
  int levels = 1;
  while ((static_cast<std::int64_t>(leaf_cells) << (levels - 1)) <
         std::max(field.cell_columns(), field.cell_rows())) {
    ++levels;
  }
  return levels;
}

// The slope of one half of a cell, m/m; below 0 if one of its samples is void.
double slope_of(const Heightfield& field, bool north_east, int half, int i, int j) {
  const double sw = field.heights_m(i, j), se = field.heights_m(i + 1, j);
  const double nw = field.heights_m(i, j + 1), ne = field.heights_m(i + 1, j + 1);
  const double across = (half == 0 ? se - sw : ne - nw) / field.dx_m;
  const double up = ((half == 0) == north_east ? ne - se : nw - sw) / field.dy_m;
  const double squared = across * across + up * up;
  return std::isnan(squared) ? -1.0 : std::sqrt(squared);
}

}  // namespace

SlicingTree::SlicingTree(const Heightfield& field, terrain::Diagonal diagonal, int leaf_cells)
    : field_(&field),
      diagonal_(diagonal),
      leaf_cells_(leaf_cells),
      levels_(levels_for(field, std::max(1, leaf_cells))) {
  require(leaf_cells >= 2 && leaf_cells <= 256 && leaf_cells % 2 == 0,
          "a leaf must have an even number of cells in 2..256, got {}", leaf_cells);
  terrain::require_valid(field);
  require(levels_ <= 16, "a slicing tree may have at most 16 levels, got {}", levels_);
  require_memory(
      static_cast<std::int64_t>(first_of(levels_)) * static_cast<std::int64_t>(sizeof(SlicingNode)),
      "the slicing tree");
  nodes_.resize(first_of(levels_));
  for (int level = levels_ - 1; level >= 0; --level) {
    const std::int64_t side = std::int64_t{1} << level;
    const std::uint32_t first = first_of(level);
    parallel_for(side, 8, [&](std::int64_t row) {
      for (std::int64_t column = 0; column < side; ++column) {
        const auto index = first + static_cast<std::uint32_t>(row * side + column);
        if (level == levels_ - 1) {
          fill_leaf(index, static_cast<int>(column), static_cast<int>(row));
        } else {
          fill_inner(index);
        }
      }
    });
  }
}

int SlicingTree::level_of(std::uint32_t index) const {
  int level = 0;
  while (first_of(level + 1) <= index) ++level;
  return level;
}

std::array<std::uint32_t, 4> SlicingTree::children(std::uint32_t index) const {
  const int level = level_of(index);
  const std::uint32_t side = std::uint32_t{1} << level, place = index - first_of(level);
  const std::uint32_t column = place % side, row = place / side;
  const std::uint32_t first = first_of(level + 1) + 2 * row * (2 * side) + 2 * column;
  return {first, first + 1, first + 2 * side, first + 2 * side + 1};
}

void SlicingTree::fill_leaf(std::uint32_t index, int column, int row) {
  const Heightfield& field = *field_;
  SlicingNode& node = nodes_[index];
  const std::int64_t i0 = std::int64_t{column} * leaf_cells_, j0 = std::int64_t{row} * leaf_cells_;
  node.complete = i0 + leaf_cells_ <= field.cell_columns() && j0 + leaf_cells_ <= field.cell_rows();
  node.i0 = static_cast<int>(std::min<std::int64_t>(i0, field.cell_columns()));
  node.j0 = static_cast<int>(std::min<std::int64_t>(j0, field.cell_rows()));
  node.i1 = static_cast<int>(std::min<std::int64_t>(i0 + leaf_cells_, field.cell_columns()));
  node.j1 = static_cast<int>(std::min<std::int64_t>(j0 + leaf_cells_, field.cell_rows()));
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int j = std::max(0, node.j0 - 1); j < std::min(node.j1 + 1, field.cell_rows()); ++j) {
    for (int i = std::max(0, node.i0 - 1); i < std::min(node.i1 + 1, field.cell_columns()); ++i) {
      const bool own = i >= node.i0 && i < node.i1 && j >= node.j0 && j < node.j1;
      for (int half = 0; half < 2; ++half) {
        const double slope = slope_of(field, rises_north_east(diagonal_, i, j), half, i, j);
        node.complete = node.complete && (!own || slope >= 0.0);
        node.steepest = std::max(node.steepest, slope);
      }
    }
  }
  node.inland = node.complete && is_surrounded(node);
  if (node.i0 == node.i1 || node.j0 == node.j1) return;
  for (int j = node.j0; j <= node.j1; ++j) {
    for (int i = node.i0; i <= node.i1; ++i) {
      const double height = field.heights_m(i, j);
      if (std::isnan(height)) continue;
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  if (!(low <= high)) return;
  node.box.low = {node.i0 * field.dx_m, node.j0 * field.dy_m, low};
  node.box.high = {node.i1 * field.dx_m, node.j1 * field.dy_m, high};
}

bool SlicingTree::is_surrounded(const SlicingNode& node) const {
  const Heightfield& field = *field_;
  if (node.i0 == 0 || node.j0 == 0 || node.i1 == field.cell_columns() ||
      node.j1 == field.cell_rows()) {
    return false;
  }
  for (int j = node.j0 - 1; j <= node.j1 + 1; ++j) {
    for (int i = node.i0 - 1; i <= node.i1 + 1; ++i) {
      if (field.is_void(i, j)) return false;
    }
  }
  return true;
}

void SlicingTree::fill_inner(std::uint32_t index) {
  SlicingNode& node = nodes_[index];
  const std::array<std::uint32_t, 4> below = children(index);
  node.i0 = nodes_[below[0]].i0;
  node.j0 = nodes_[below[0]].j0;
  node.i1 = nodes_[below[3]].i1;
  node.j1 = nodes_[below[3]].j1;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::uint32_t k : below) {
    const SlicingNode& child = nodes_[k];
    node.complete = node.complete && child.complete;
    node.inland = node.inland && child.inland;
    node.steepest = std::max(node.steepest, child.steepest);
    if (child.empty()) continue;
    low = std::min(low, child.box.low.z);
    high = std::max(high, child.box.high.z);
  }
  if (!(low <= high)) return;
  // The whole square, voids and all: a ray that is inside it is inside one of its children.
  node.box.low = {node.i0 * field_->dx_m, node.j0 * field_->dy_m, low};
  node.box.high = {node.i1 * field_->dx_m, node.j1 * field_->dy_m, high};
}

}  // namespace plumb::slicing
