#include "mesh/patch_quadtree/patch_decoder.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "mesh/patch_quadtree/rans_models.h"

namespace plumb::mesh::patch_quadtree {
namespace {

// Patches whose subtrees are decoded side by side, at least, where there are so many.
constexpr std::size_t kEnough = 64;

using Body = std::function<void(const PatchPlace&, const PatchNumbers&)>;

struct Decoded {
  PatchPlace place;
  PatchNumbers numbers;
};

// Child (s, t)'s place in a family.
std::size_t place_in_family(const PatchPlace& patch) {
  return static_cast<std::size_t>((patch.px & 1) + 2 * (patch.py & 1));
}

void descend(const PatchDecoder& decoder, const Decoded& patch, int level, const Body& body) {
  if (patch.place.level == level) return;
  Family children = decoder.children(patch.place, patch.numbers);
  for (int c = 0; c < 4; ++c) {
    auto& child = children[static_cast<std::size_t>(c)];
    if (!child) continue;
    const Decoded below{patch.place.child(c & 1, c >> 1), std::move(*child)};
    child.reset();
    body(below.place, below.numbers);
    descend(decoder, below, level, body);
  }
}

// The children of all, each given to the body.
std::vector<Decoded> children_of(const PatchDecoder& decoder, const std::vector<Decoded>& patches,
                                 const Body& body) {
  std::vector<Family> families(patches.size());
  parallel_for(static_cast<std::int64_t>(patches.size()), 1, [&](std::int64_t k) {
    const Decoded& patch = patches[static_cast<std::size_t>(k)];
    Family& family = families[static_cast<std::size_t>(k)];
    family = decoder.children(patch.place, patch.numbers);
    for (int c = 0; c < 4; ++c) {
      const auto& child = family[static_cast<std::size_t>(c)];
      if (child) body(patch.place.child(c & 1, c >> 1), *child);
    }
  });
  std::vector<Decoded> below;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    for (int c = 0; c < 4; ++c) {
      auto& child = families[k][static_cast<std::size_t>(c)];
      if (child) below.push_back({patches[k].place.child(c & 1, c >> 1), std::move(*child)});
    }
  }
  return below;
}

// Writes a patch's samples without its margin; the last along a side is the next patch's first,
// where there is one.
void put_patch(const PatchPlace& place, const Grid<float>& patch, const PatchLayout& layout,
               Grid<float>& level) {
  const int n = layout.patch_cells;
  const int from_x = place.px * n, from_y = place.py * n;
  const bool is_last_x = place.px + 1 == layout.patch_columns(place.level),
             is_last_y = place.py + 1 == layout.patch_rows(place.level);
  const int to_x = is_last_x ? level.columns() : from_x + n,
            to_y = is_last_y ? level.rows() : from_y + n;
  for (int j = from_y; j < to_y; ++j)
    std::copy_n(&patch(1, j - from_y + 1), to_x - from_x, &level(from_x, j));
}

}  // namespace

PatchDecoder::PatchDecoder(const Container& container) : container_(container) {
  if (header().version == CodecVersion::Published) return;
  auto tables = rans_tables_of(header().models, kModels);
  if (tables) tables_ = ModelTables{std::move(*tables)};
  if (!tables_) input_error("cannot read '{}': its models are damaged", container.name());
}

void PatchDecoder::damaged(const PatchPlace& patch) const {
  input_error("cannot read '{}': patch ({}, {}) of level {} is damaged, its bytes are no patch's",
              container_.name(), patch.px, patch.py, patch.level);
}

void PatchDecoder::require_level(int level) const {
  require(level >= 0 && level < header().layout.levels, "a level must be in [0, {}), got {}",
          header().layout.levels, level);
}

PatchNumbers PatchDecoder::root() const {
  const bool published = header().version == CodecVersion::Published;
  const Bytes bytes = container_.heights(published ? header().layout.patch_count() : 0);
  PatchNumbers numbers;
  if (!decode_root(bytes, header().layout.patch_cells, header().quantiser.rule, numbers))
    damaged(header().layout.root());
  return numbers;
}

PatchNumbers PatchDecoder::numbers(const PatchPlace& patch) const {
  require(header().layout.contains(patch), "there is no patch ({}, {}) of level {}", patch.px,
          patch.py, patch.level);
  PatchNumbers numbers_here = root();
  for (int level = header().layout.levels - 2; level >= patch.level; --level) {
    const int up = level - patch.level;
    numbers_here = numbers({level, patch.px >> up, patch.py >> up}, numbers_here);
  }
  return numbers_here;
}

PatchNumbers PatchDecoder::numbers(const PatchPlace& patch, const PatchNumbers& parent) const {
  if (!tables_) return std::move(*children(patch.parent(), parent)[place_in_family(patch)]);
  PatchNumbers child;
  if (!decode_child(parent, {patch.px & 1, patch.py & 1, patch.level},
                    container_.heights(header().layout.index(patch)), *tables_, child))
    damaged(patch);
  return child;
}

Family PatchDecoder::children(const PatchPlace& patch, const PatchNumbers& numbers_here) const {
  require(patch.level > 0 && header().layout.contains(patch),
          "there are no children of patch ({}, {}) of level {}", patch.px, patch.py, patch.level);
  Family children;
  std::array<bool, 4> there{};
  for (int c = 0; c < 4; ++c) {
    const PatchPlace child = patch.child(c & 1, c >> 1);
    there[static_cast<std::size_t>(c)] = header().layout.contains(child);
    if (tables_ && there[static_cast<std::size_t>(c)])
      children[static_cast<std::size_t>(c)] = numbers(child, numbers_here);
  }
  if (!tables_ && !decode_family(numbers_here, there,
                                 container_.heights(header().layout.index(patch)), children))
    damaged(patch);
  return children;
}

Grid<float> PatchDecoder::heights(const PatchPlace& patch) const {
  return heights_of(numbers(patch), header().quantiser, patch.level);
}

void PatchDecoder::visit(int level, const Body& body) const {
  require_level(level);
  std::vector<Decoded> side_by_side;
  side_by_side.push_back({header().layout.root(), root()});
  body(side_by_side.front().place, side_by_side.front().numbers);
  while (side_by_side.front().place.level > level + 1 && side_by_side.size() < kEnough)
    side_by_side = children_of(*this, side_by_side, body);
  parallel_for(static_cast<std::int64_t>(side_by_side.size()), 1, [&](std::int64_t k) {
    descend(*this, side_by_side[static_cast<std::size_t>(k)], level, body);
  });
}

Grid<float> PatchDecoder::level_heights(int level) const {
  require_level(level);
  const PatchLayout& layout = header().layout;
  const auto along = [&](int samples) {
    return static_cast<int>((std::int64_t{samples} - 1 + (std::int64_t{1} << level) - 1) >> level) +
           1;
  };
  const int columns = along(layout.columns), rows = along(layout.rows);
  // Floats, and numbers of the level above with their voids at most.
  require_memory(
      std::int64_t{columns} * rows * 6,
      fmt::format("level {} of '{}', {} x {} samples,", level, container_.name(), columns, rows));
  Grid<float> heights(columns, rows);
  visit(level, [&](const PatchPlace& place, const PatchNumbers& numbers_here) {
    if (place.level == level)
      put_patch(place, heights_of(numbers_here, header().quantiser, level), layout, heights);
  });
  return heights;
}

}  // namespace plumb::mesh::patch_quadtree
