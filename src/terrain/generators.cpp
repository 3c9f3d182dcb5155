#include "terrain/generators.h"

#include <limits>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "terrain/generator_parameters.h"
#include "terrain/gradient_noise.h"
#include "terrain/memory_check.h"

namespace plumb::terrain {
namespace {

constexpr int kLevels = 65536;

/// How deep in a blob of void a sample lies, as a level below kLevels.
std::size_t void_level(int i, int j, std::uint64_t seed) {
  constexpr double kBlob = 1.0 / 24.0;  // in samples
  // Half a lattice step aside, as the noise is 0 on the lattice; a little hash parts equals.
  const double noise = gradient_noise((i + 0.5) * kBlob, (j + 0.5) * kBlob, seed);
  const double fine = lattice_part(i, j, ~seed);
  const double level = ((noise + 1.0) * 0.5 * 0.98 + 0.02 * fine) * (kLevels - 1);
  return static_cast<std::size_t>(level);
}

/// Makes the samples of the highest levels void: as many levels as stay within `part` of all.
/// Returns how many.
std::int64_t punch_voids(Grid<float>& heights_m, double part, std::uint64_t seed) {
  using Counts = std::vector<std::int64_t>;
  const Counts counts = parallel_ordered_reduce(
      heights_m.rows(), 256, Counts(kLevels, 0),
      [&](std::int64_t begin, std::int64_t end, Counts found) {
        for (std::int64_t j = begin; j < end; ++j) {
          for (int i = 0; i < heights_m.columns(); ++i) {
            ++found[void_level(i, static_cast<int>(j), seed)];
          }
        }
        return found;
      },
      [](Counts a, const Counts& b) {
        for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
        return a;
      });
  const double wanted = part * static_cast<double>(heights_m.size());
  std::size_t first_void = kLevels;
  std::int64_t voids = 0;
  while (first_void > 0 && static_cast<double>(voids + counts[first_void - 1]) <= wanted) {
    voids += counts[--first_void];
  }
  parallel_for(heights_m.rows(), 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < heights_m.columns(); ++i) {
      if (void_level(i, j, seed) >= first_void) {
        heights_m(i, j) = std::numeric_limits<float>::quiet_NaN();
      }
    }
  });
  return voids;
}

glm::dvec2 origin_of(const GeneratorValues& values) {
  const bool utm = values.whole("utm", 0, 1) == 1;
  if (utm && values.is_given("origin")) {
    values.refuse("origin", "either origin or utm=1, not both");
  }
  if (utm) return {500000.0, 4500000.0};
  const auto origin = values.pair("origin", -1e9, 1e9);
  return {origin.first, origin.second};
}

}  // namespace

Heightfield generate(const std::string& argument) {
  const GeneratorValues values(argument);
  const GridShape shape = values.shape();
  const RowFiller fill = row_filler(values, shape);
  const double voids = values.number("voids", 0.0, 1.0);
  const std::uint64_t seed = values.seed();
  require_memory("generate:" + values.name(), shape.columns, shape.rows, sizeof(float));
  Heightfield field;
  field.origin_m = origin_of(values);
  field.dx_m = shape.dx_m;
  field.dy_m = shape.dy_m;
  Grid<float> heights_m(shape.columns, shape.rows);
  parallel_for(shape.rows, 1, [&](std::int64_t j) {
    fill(static_cast<int>(j), heights_m.row(static_cast<int>(j)));
  });
  if (voids > 0.0) {
    field.provenance.voids_declared = punch_voids(heights_m, voids, seed ^ 0x85ebca6bULL);
  }
  field.heights_m = std::move(heights_m);
  field.provenance.source = values.canonical();
  field.provenance.format = "generated";
  field.provenance.file_columns = shape.columns;
  field.provenance.file_rows = shape.rows;
  return field;
}

}  // namespace plumb::terrain
