#include "terrain/generators.h"

#include <limits>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "terrain/generated_voids.h"
#include "terrain/generator_parameters.h"
#include "terrain/memory_check.h"
#include "terrain/stacks/stack_source.h"

namespace plumb::terrain {
namespace {

/// Makes samples void; returns how many.
std::int64_t punch_voids(Grid<float>& heights_m, double part, std::uint64_t seed) {
  const GeneratedVoids voids(heights_m.columns(), heights_m.rows(), part, seed);
  parallel_for(heights_m.rows(), 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < heights_m.columns(); ++i) {
      if (voids.at(i, j)) heights_m(i, j) = std::numeric_limits<float>::quiet_NaN();
    }
  });
  return voids.count();
}

Heightfield top_of_stacks(const GeneratorValues& values) {
  const std::string& surface = values.text("surface");
  if (surface != "top" && surface != "stacks") values.refuse("surface", "stacks or top");
  if (surface == "stacks") {
    input_error(
        "generate:{}: {} is a terrain of stacks: method stacks draws it; surface=top asks for the "
        "heights of its top surface alone",
        values.name(), values.name());
  }
  require_memory("generate:" + values.name(), values.shape().columns, values.shape().rows,
                 sizeof(float) + kBytesAStack);
  return top_surface(make_stacks(values));
}

}  // namespace

Heightfield generate(const std::string& argument) {
  const GeneratorValues values(argument);
  if (values.makes_stacks()) return top_of_stacks(values);
  const GridShape shape = values.shape();
  const RowFiller fill = row_filler(values, shape);
  const double voids = values.number("voids", 0.0, 1.0);
  require_memory("generate:" + values.name(), shape.columns, shape.rows, sizeof(float));
  Heightfield field;
  field.origin_m = values.origin_m();
  field.dx_m = shape.dx_m;
  field.dy_m = shape.dy_m;
  Grid<float> heights_m(shape.columns, shape.rows);
  parallel_for(shape.rows, 1, [&](std::int64_t j) {
    fill(static_cast<int>(j), heights_m.row(static_cast<int>(j)));
  });
  if (voids > 0.0) {
    field.provenance.voids_declared = punch_voids(heights_m, voids, values.void_seed());
  }
  field.heights_m = std::move(heights_m);
  field.provenance.source = values.canonical();
  field.provenance.format = "generated";
  field.provenance.file_columns = shape.columns;
  field.provenance.file_rows = shape.rows;
  return field;
}

}  // namespace plumb::terrain
