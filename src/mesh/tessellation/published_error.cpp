#include "mesh/tessellation/published_error.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchLayout;
using patch_quadtree::PatchPlace;

namespace {

// Between which of the parent's samples one of its children's stands, and how far along.
struct Between {
  int from, to;
  double along;
};

// By its number along an axis, of two children together. Where the terrain ends the next sample of
// the parent is nearer, or at the same place.
Between between(const std::vector<int>& places, int k) {
  const auto at = [&](int index) { return places[static_cast<std::size_t>(index)]; };
  const int here = at(k), from = at(k & ~1), to = at((k & ~1) + (k & 1) * 2);
  if (here == from || here == to) return {here, here, 0.0};
  return {from, to, static_cast<double>(here - from) / (to - from)};
}

// The largest deviation of a patch, bilinear between its samples, from samples half as far apart.
double interpolation_error(const Grid<float>& heights_m, const PatchLayout& layout,
                           const PatchPlace& patch) {
  const int side = 2 * layout.patch_cells + 1;
  // Of the two children along an axis: where sample k of both together stands.
  const PatchPlace first = patch.child(0, 0);
  std::vector<int> columns, rows;
  for (int k = 0; k < side; ++k) {
    columns.push_back(layout.sample_column(first, k));
    rows.push_back(layout.sample_row(first, k));
  }
  double largest = 0.0;
  for (int j = 0; j < side; ++j) {
    const Between up = between(rows, j);
    for (int i = 0; i < side; ++i) {
      const Between across = between(columns, i);
      const auto along_row = [&](int row) {
        const double west = heights_m(across.from, row), east = heights_m(across.to, row);
        return west + across.along * (east - west);
      };
      const double south = along_row(up.from), north = along_row(up.to);
      const double off = std::abs(south + up.along * (north - south) -
                                  double{heights_m(columns[static_cast<std::size_t>(i)],
                                                   rows[static_cast<std::size_t>(j)])});
      if (off > largest) largest = off;  // false where a sample is void
    }
  }
  return largest;
}

}  // namespace

std::vector<float> published_errors(const Grid<float>& heights_m, const PatchLayout& layout) {
  std::vector<float> errors(static_cast<std::size_t>(layout.patch_count()), 0.0f);
  for (int level = 1; level < layout.levels; ++level) {
    const std::int64_t first = layout.first_of_level(level);
    const std::int64_t count = layout.first_of_level(level - 1) - first;
    parallel_for(count, 1, [&](std::int64_t k) {
      const PatchPlace patch = layout.place(first + k);
      float of_children = 0.0f;
      for (int c = 0; c < 4; ++c) {
        const PatchPlace child = patch.child(c & 1, c >> 1);
        if (layout.contains(child))
          of_children =
              std::max(of_children, errors[static_cast<std::size_t>(layout.index(child))]);
      }
      errors[static_cast<std::size_t>(first + k)] =
          static_cast<float>(interpolation_error(heights_m, layout, patch) + double{of_children});
    });
  }
  return errors;
}

}  // namespace plumb::mesh::tessellation
