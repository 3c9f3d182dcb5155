#include "mesh/tessellation/build.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/check.h"
#include "core/little_endian.h"
#include "core/parallel.h"
#include "mesh/tessellation/bounds_record.h"
#include "mesh/tessellation/published_error.h"

namespace plumb::mesh::tessellation {

using patch_quadtree::ContainerHeader;
using patch_quadtree::ContainerRecords;
using patch_quadtree::EncodedHeights;
using patch_quadtree::PatchLayout;
using patch_quadtree::PatchPlace;
using patch_quadtree::Payload;
using patch_quadtree::RansCounts;
using patch_quadtree::RansTable;

namespace {

// Codes reach from the whole relief down by 2^-31 of it.
BoundScale scale_for(const terrain::Heightfield& field, double error_m) {
  Box box = terrain::bounds(field);
  box.add(glm::dvec3(0.0));
  return {std::ldexp(box.high.z - box.low.z + 4.0 * error_m, -31)};
}

// All patches' bounds, from heights as they will be decoded, and what foretells them.
struct Measured {
  std::vector<PatchBounds> bounds;
  std::vector<std::vector<double>> distances_m;
};

Measured measured_bounds(const terrain::HeightGrid& field_m, const Grid<float>& heights_m,
                         const ContainerHeader& header, const BlockPieces& pieces,
                         const BoundScale& scale) {
  const PatchLayout& layout = header.layout;
  const std::vector<float> published = published_errors(heights_m, layout);
  const ThinnedForetold foretold(pieces);
  const auto count = static_cast<std::size_t>(layout.patch_count());
  Measured measured{std::vector<PatchBounds>(count), std::vector<std::vector<double>>(count)};
  for (int level = 0; level < layout.levels; ++level) {
    const BoundsOfLevel measure(heights_m, layout, level, pieces, scale);
    const std::int64_t first = layout.first_of_level(level);
    parallel_for(layout.first_of_level(level - 1) - first, 1, [&](std::int64_t k) {
      const auto at = static_cast<std::size_t>(first + k);
      const PatchPlace patch = layout.place(first + k);
      const Grid<float> decoded = patch_quadtree::heights_of(
          patch_quadtree::numbers_of(field_m, layout, patch, header.quantiser), header.quantiser,
          level);
      measured.bounds[at] = measure.bounds(patch, decoded);
      measured.bounds[at].published_m = published[at];
      measured.distances_m[at] = foretold.distances_m(layout, patch, decoded);
    });
  }
  return measured;
}

Bytes parameter_bytes(int block_cells, const BoundScale& scale,
                      const std::vector<RansCounts>& counts) {
  Bytes bytes;
  put_number(static_cast<std::uint64_t>(block_cells), bytes);
  put(scale.unit_m, bytes);
  put_part(patch_quadtree::rans_model_bytes(counts), bytes);
  return bytes;
}

struct Parameters {
  int block_cells = 0;
  BoundScale scale;
  std::vector<RansTable> tables;
};

int levels_of(int block_cells) { return std::countr_zero(static_cast<unsigned>(block_cells)) + 1; }

// `named`: the file, for what is wrong with it.
Parameters parameters_of(const ContainerHeader& header, const std::string& named) {
  ByteReader reader(header.parameters);
  Parameters parameters;
  const std::uint64_t cells = reader.number();
  parameters.scale.unit_m = take<double>(reader);
  const auto models = reader.bytes(reader.number());
  const bool fits = cells >= 8 && cells <= 64 && std::has_single_bit(cells) &&
                    cells <= static_cast<std::uint64_t>(header.layout.patch_cells) &&
                    parameters.scale.unit_m > 0.0 && std::isfinite(parameters.scale.unit_m) &&
                    !reader.overrun() && reader.rest().empty();
  if (fits) {
    parameters.block_cells = static_cast<int>(cells);
    auto tables =
        patch_quadtree::rans_tables_of(models, bound_contexts(levels_of(parameters.block_cells)));
    if (tables) parameters.tables = std::move(*tables);
  }
  if (parameters.tables.empty())
    input_error("cannot read '{}': the parameters of its bounds are damaged", named);
  return parameters;
}

}  // namespace

Bytes build(const terrain::Heightfield& field, const BuildOptions& options) {
  require(options.block_cells <= options.heights.patch_cells,
          "block_cells must be at most patch_cells, got {} and {}", options.block_cells,
          options.heights.patch_cells);
  const BlockPieces pieces(options.block_cells);
  EncodedHeights encoded = patch_quadtree::encode_heights(field, options.heights);
  ContainerHeader& header = encoded.header;
  header.payload = Payload::Tessellation;
  const terrain::FloatHeights floats(field.heights_m);
  const Grid<float>& heights_m = *floats;
  const BoundScale scale = scale_for(field, options.heights.error_m);
  const Measured measured = measured_bounds(field.heights_m, heights_m, header, pieces, scale);
  const auto foretold = [&](std::size_t k) {
    return ForetoldBounds{measured.distances_m[k], scale};
  };

  std::vector<RansCounts> counts(bound_contexts(levels_of(options.block_cells)));
  for (std::size_t k = 0; k < measured.bounds.size(); ++k)
    count_bounds(measured.bounds[k], foretold(k), counts);
  header.parameters = parameter_bytes(options.block_cells, scale, counts);
  const Parameters parameters = parameters_of(header, header.source);
  ContainerRecords records{std::move(encoded.heights), std::vector<Bytes>(measured.bounds.size())};
  parallel_for(static_cast<std::int64_t>(records.payload.size()), 16, [&](std::int64_t k) {
    const auto at = static_cast<std::size_t>(k);
    records.payload[at] = encode_bounds(measured.bounds[at], foretold(at), parameters.tables);
  });
  return patch_quadtree::container_bytes(header, records);
}

Bounds read_bounds(const patch_quadtree::Container& container) {
  const ContainerHeader& header = container.header();
  if (header.payload != Payload::Tessellation)
    input_error("'{}' was not built for tessellation: plumb build --method tessellation makes one",
                container.name());
  Parameters parameters = parameters_of(header, container.name());
  Bounds bounds{parameters.block_cells, parameters.scale, std::move(parameters.tables),
                std::vector<PatchBounds>(static_cast<std::size_t>(header.layout.patch_count()))};
  const int blocks = header.layout.patch_cells / parameters.block_cells;
  parallel_for(header.layout.patch_count(), 16, [&](std::int64_t k) {
    if (!decode_bounds(container.payload(k), blocks, levels_of(parameters.block_cells),
                       bounds.tables, bounds.patches[static_cast<std::size_t>(k)]))
      input_error("cannot read '{}': the bounds of patch {} are none", container.name(), k);
  });
  return bounds;
}

PatchBounds thinned_bounds(const patch_quadtree::Container& container, const Bounds& bounds,
                           const ThinnedForetold& foretold, std::int64_t patch,
                           const Grid<float>& heights_m) {
  PatchBounds complete = bounds.patches[static_cast<std::size_t>(patch)];
  const std::vector<double> distances_m = foretold.distances_m(
      container.header().layout, container.header().layout.place(patch), heights_m);
  if (!decode_thinned(container.payload(patch), {distances_m, bounds.scale}, bounds.tables,
                      complete))
    input_error("cannot read '{}': the bounds of patch {} are none", container.name(), patch);
  return complete;
}

}  // namespace plumb::mesh::tessellation
