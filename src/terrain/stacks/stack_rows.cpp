#include "terrain/stacks/stack_rows.h"

#include <limits>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::terrain {
namespace {

// Appends a row to `field` and gives its memory back.
void append(StackField& field, StackField row, int j) {
  const std::size_t before = field.end_m.size();
  for (std::size_t k = 1; k < row.first_layer.size(); ++k)
    field.first_layer.push_back(static_cast<std::uint32_t>(before + row.first_layer[k]));
  field.end_m.insert(field.end_m.end(), row.end_m.begin(), row.end_m.end());
  field.material.insert(field.material.end(), row.material.begin(), row.material.end());
  if (row.holes.empty()) return;
  if (field.holes.empty()) field.holes.assign(field.size(), 0);
  std::copy(row.holes.begin(), row.holes.end(),
            field.holes.begin() + static_cast<std::ptrdiff_t>(field.index(0, j)));
}

}  // namespace

StackField field_of_rows(StackField shape, const StackRowFiller& fill) {
  StackField field = std::move(shape);
  StackWriter{field};  // empties the arrays
  StackField empty = field;
  empty.rows = 1;
  std::vector<StackField> rows(static_cast<std::size_t>(field.rows), empty);
  parallel_for(field.rows, 1, [&](std::int64_t j) {
    StackField& row = rows[static_cast<std::size_t>(j)];
    StackWriter writer(row);
    fill(static_cast<int>(j), writer);
    row.end_m.shrink_to_fit();
    row.material.shrink_to_fit();
  });
  std::size_t layers = 0;
  for (const StackField& row : rows) {
    require(row.first_layer.size() == row.size() + 1, "a row of {} stacks was given {}", row.size(),
            row.first_layer.size() - 1);
    layers += row.end_m.size();
  }
  require(layers <= std::numeric_limits<std::uint32_t>::max(),
          "a field must have at most 2^32 - 1 layers, got {}", layers);
  field.end_m.reserve(layers);
  field.material.reserve(layers);
  for (int j = 0; j < field.rows; ++j)
    append(field, std::exchange(rows[static_cast<std::size_t>(j)], {}), j);
  return field;
}

}  // namespace plumb::terrain
