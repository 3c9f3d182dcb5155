#include "terrain/stacks/stack_pyramid.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/check.h"
#include "terrain/stacks/stack_aggregation.h"
#include "terrain/stacks/stack_rows.h"

namespace plumb::terrain {
namespace {

StackField half_shape(const StackField& finer) {
  StackField shape;
  shape.columns = (finer.columns - 1) / 2 + 1;
  shape.rows = (finer.rows - 1) / 2 + 1;
  shape.dx_m = 2.0 * finer.dx_m;
  shape.dy_m = 2.0 * finer.dy_m;
  shape.voxel_m = 2.0 * finer.voxel_m;
  shape.origin_m = finer.origin_m + 0.5 * glm::dvec2(finer.dx_m, finer.dy_m);
  shape.low_m = finer.low_m;
  shape.voxels = (finer.voxels - 1) / 2 + 1;
  shape.materials = finer.materials;
  shape.provenance = finer.provenance;
  return shape;
}

}  // namespace

StackField halved(const StackField& finer) { return halved(finer, finer.highest_m()); }

StackField halved(const StackField& finer, float high_m) {
  return field_of_rows(half_shape(finer), [&](int j, StackWriter& row) {
    Aggregation aggregation;
    std::array<StackView, 4> stacks;
    for (int i = 0; i <= (finer.columns - 1) / 2; ++i) {
      std::size_t known = 0;
      for (const int y : {2 * j, std::min(2 * j + 1, finer.rows - 1)}) {
        for (const int x : {2 * i, std::min(2 * i + 1, finer.columns - 1)})
          if (!finer.is_hole(x, y)) stacks[known++] = finer.stack(x, y);
      }
      if (known == 0) {
        row.add_hole();
        continue;
      }
      aggregate(std::span(stacks).first(known), high_m, aggregation);
      row.add(aggregation.layers);
    }
  });
}

std::vector<StackField> stack_pyramid(StackField finest, int levels) {
  require(levels >= 1 && levels <= 31, "a pyramid must have 1 to 31 levels, got {}", levels);
  require_valid(finest);
  std::vector<StackField> pyramid;
  pyramid.reserve(static_cast<std::size_t>(levels));
  pyramid.push_back(std::move(finest));
  const float high_m = pyramid.front().highest_m();
  while (pyramid.size() < static_cast<std::size_t>(levels))
    pyramid.push_back(halved(pyramid.back(), high_m));
  return pyramid;
}

}  // namespace plumb::terrain
