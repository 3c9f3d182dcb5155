#include "mesh/tessellation/patch_bounds.h"

#include <algorithm>
#include <cmath>

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchLayout;
using patch_quadtree::PatchPlace;

namespace {

// What rounding may hide of a deviation, relative to the heights it is a difference of: a few dozen
// operations of 1.1e-16 each.
constexpr double kRounding = 1e-14;

std::vector<double> heights_of_block(const Grid<float>& decoded_m, int i, int j, int cells) {
  std::vector<double> heights;
  heights.reserve(static_cast<std::size_t>((cells + 1) * (cells + 1)));
  for (int b = 0; b <= cells; ++b) {
    for (int a = 0; a <= cells; ++a)
      heights.push_back(double{decoded_m(i * cells + a + 1, j * cells + b + 1)});
  }
  return heights;
}

}  // namespace

std::uint8_t PatchBounds::error_code() const {
  std::uint8_t largest = 0;
  for (std::size_t k = 0; k < codes.size(); k += static_cast<std::size_t>(levels))
    largest = std::max(largest, codes[k]);
  return largest;
}

BoundsOfLevel::BoundsOfLevel(const Grid<float>& heights_m, const PatchLayout& layout, int level,
                             const BlockPieces& pieces, const BoundScale& scale)
    : heights_m_(heights_m), layout_(layout), level_(level), pieces_(pieces), scale_(scale) {
  for (std::size_t shape = 0; shape < kBlockShapes; ++shape) {
    if (const auto places = places_of_shape(layout, level, pieces.block_cells(), shape))
      shapes_[shape].emplace(pieces, *places);
  }
}

BlockPlaces BoundsOfLevel::places_of(const PatchPlace& patch, int i, int j) const {
  const int cells = pieces_.block_cells();
  BlockPlaces places;
  for (int k = 0; k <= cells; ++k) {
    places.column.push_back(layout_.sample_column(patch, i * cells + k));
    places.row.push_back(layout_.sample_row(patch, j * cells + k));
  }
  return places;
}

BoundsOfLevel::Beneath BoundsOfLevel::beneath(const BlockPlaces& places) const {
  Beneath found{0.0f, 0.0f, false, false};
  for (int row = places.row.front(); row <= places.row.back(); ++row) {
    const auto heights = heights_m_.row(row);
    for (int column = places.column.front(); column <= places.column.back(); ++column) {
      const float height = heights[static_cast<std::size_t>(column)];
      if (std::isnan(height)) {
        found.some_void = true;
        continue;
      }
      found.low_m = found.some_height ? std::min(found.low_m, height) : height;
      found.high_m = found.some_height ? std::max(found.high_m, height) : height;
      found.some_height = true;
    }
  }
  return found;
}

// Full detail amid voids: what is drawn is what exists.
double BoundsOfLevel::error_of_samples(const BlockPlaces& places,
                                       const std::vector<double>& drawn_m) const {
  double largest = 0.0;
  for (std::size_t j = 0; j < places.row.size(); ++j) {
    for (std::size_t i = 0; i < places.column.size(); ++i) {
      const double off = std::abs(drawn_m[j * places.column.size() + i] -
                                  heights_m_(places.column[i], places.row[j]));
      if (off > largest) largest = off;  // false for voids
    }
  }
  return largest;
}

void BoundsOfLevel::measure(const MixtureDeviation& blocks, const std::vector<double>& drawn_m,
                            const TruthBelow& truth, std::uint8_t* codes) const {
  double magnitude = 0.0;
  for (const double height : drawn_m) magnitude = std::max(magnitude, std::abs(height));
  blocks.for_each_thinning(0, drawn_m, truth, [&](int thinning, double deviation) {
    codes[thinning] = scale_.code(deviation > 0.0 ? deviation + kRounding * magnitude : 0.0);
  });
}

PatchBounds BoundsOfLevel::bounds(const PatchPlace& patch, const Grid<float>& decoded_m) const {
  const int cells = pieces_.block_cells();
  PatchBounds bounds;
  bounds.blocks = layout_.patch_cells / cells;
  bounds.levels = pieces_.coarsest() + 1;
  const auto levels = static_cast<std::size_t>(bounds.levels);
  std::vector<std::uint8_t> codes(
      static_cast<std::size_t>(bounds.blocks) * static_cast<std::size_t>(bounds.blocks) * levels,
      0);
  std::uint8_t* at = codes.data();
  for (int j = 0; j < bounds.blocks; ++j) {
    for (int i = 0; i < bounds.blocks; ++i, at += levels) {
      const auto shape = shape_of(layout_, patch, cells, i, j);
      if (!shape) continue;
      const BlockPlaces places = places_of(patch, i, j);
      const Beneath found = beneath(places);
      if (!found.some_height) continue;
      const bool first = bounds.low_m > bounds.high_m;
      bounds.low_m = first ? found.low_m : std::min(bounds.low_m, found.low_m);
      bounds.high_m = first ? found.high_m : std::max(bounds.high_m, found.high_m);
      const std::vector<double> drawn_m = heights_of_block(decoded_m, i, j, cells);
      if (found.some_void) {
        std::fill(at, at + levels, BoundScale::kNone);
        if (level_ == 0) at[0] = scale_.code(error_of_samples(places, drawn_m));
        continue;
      }
      const TruthBelow truth{&heights_m_(places.column.front(), places.row.front()),
                             heights_m_.columns()};
      measure(*shapes_[*shape], drawn_m, truth, at);
    }
  }
  if (bounds.low_m <= bounds.high_m) bounds.codes = std::move(codes);
  return bounds;
}

}  // namespace plumb::mesh::tessellation
