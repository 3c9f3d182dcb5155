#include "mesh/patch_quadtree/decoded_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/check.h"
#include "mesh/patch_quadtree/patch_decoder.h"

namespace plumb::mesh::patch_quadtree {
namespace {

DecodedLevel compared(const Grid<float>& decoded, const PatchLayout& layout,
                      const PatchPlace& place, const terrain::HeightGrid& heights_m) {
  DecodedLevel found;
  found.patches = 1;
  found.samples = static_cast<std::int64_t>(decoded.size());
  for (int j = 0; j < decoded.rows(); ++j) {
    const int row = layout.sample_row(place, j - 1);
    for (int i = 0; i < decoded.columns(); ++i) {
      const float truth = heights_m(layout.sample_column(place, i - 1), row);
      const float height = decoded(i, j);
      if (std::isnan(truth) || std::isnan(height)) {
        ++(std::isnan(truth) && std::isnan(height) ? found.voids : found.voids_differ);
      } else {
        found.largest_error_m =
            std::max(found.largest_error_m, std::abs(double{height} - double{truth}));
      }
    }
  }
  return found;
}

void add(const DecodedLevel& patch, DecodedLevel& level) {
  level.patches += patch.patches;
  level.samples += patch.samples;
  level.largest_error_m = std::max(level.largest_error_m, patch.largest_error_m);
  level.voids += patch.voids;
  level.voids_differ += patch.voids_differ;
}

}  // namespace

std::vector<DecodedLevel> check_decoded(const Container& container,
                                        const terrain::Heightfield& field) {
  const ContainerHeader& header = container.header();
  const PatchLayout& layout = header.layout;
  require(field.columns() == layout.columns && field.rows() == layout.rows,
          "a container of {} x {} samples is compared with a terrain of {} x {}", layout.columns,
          layout.rows, field.columns(), field.rows());
  std::vector<DecodedLevel> patches(static_cast<std::size_t>(layout.patch_count()));
  PatchDecoder(container).visit(0, [&](const PatchPlace& place, const PatchNumbers& numbers) {
    patches[static_cast<std::size_t>(layout.index(place))] = compared(
        heights_of(numbers, header.quantiser, place.level), layout, place, field.heights_m);
  });
  std::vector<DecodedLevel> levels(static_cast<std::size_t>(layout.levels));
  for (int level = 0; level < layout.levels; ++level) {
    DecodedLevel& of = levels[static_cast<std::size_t>(level)];
    of.promised_m = header.promised_m(level);
    const auto begin = static_cast<std::size_t>(layout.first_of_level(level)),
               end = static_cast<std::size_t>(layout.first_of_level(level - 1));
    for (std::size_t k = begin; k < end; ++k) add(patches[k], of);
  }
  return levels;
}

void require_holds(const std::vector<DecodedLevel>& levels) {
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const DecodedLevel& of = levels[level];
    if (of.holds()) continue;
    throw std::logic_error(fmt::format(
        "level {} decodes up to {} m off, {} m were promised, and has {} voids that differ", level,
        of.largest_error_m, of.promised_m, of.voids_differ));
  }
}

}  // namespace plumb::mesh::patch_quadtree
