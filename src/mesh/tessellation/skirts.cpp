#include "mesh/tessellation/skirts.h"

#include <algorithm>

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchLayout;
using patch_quadtree::PatchPlace;

namespace {

// A stretch along a side, in cells of the finest level (beyond the terrain as well).
struct Stretch {
  std::int64_t begin, end;
};

// The blocks drawn on the other side of a stretch.
struct Beyond {
  bool some = false;
  double bound_m = 0.0, delta_m = 0.0;
  float low_m = 0.0f, high_m = 0.0f;
};

class SkirtsOfPatch {
 public:
  SkirtsOfPatch(const Prepared& prepared, const PatchSelection& selection,
                const ChosenLevels& levels, std::size_t drawn)
      : prepared_(prepared),
        selection_(selection),
        levels_(levels),
        layout_(prepared.header().layout),
        cells_(prepared.pieces->block_cells()),
        blocks_(layout_.patch_cells / cells_),
        place_(selection.drawn[drawn]),
        own_(levels.patches[drawn]) {}

  std::vector<Skirt> take() {
    std::vector<Skirt> skirts;
    for (std::size_t side = 0; side < 4; ++side) {
      PatchPlace other = place_;
      (side == West || side == East ? other.px : other.py) +=
          side == West || side == South ? -1 : 1;
      if (!layout_.contains(other)) continue;
      for (int k = 0; k < blocks_; ++k) add(side, k, other, skirts);
    }
    return skirts;
  }

 private:
  static bool runs_up(std::size_t side) { return side == West || side == East; }

  void add(std::size_t side, int k, const PatchPlace& other, std::vector<Skirt>& skirts) const {
    const int last = blocks_ - 1;
    const int i = side == West ? 0 : side == East ? last : k;
    const int j = side == South ? 0 : side == North ? last : k;
    const std::int64_t patch = runs_up(side) ? place_.py : place_.px;
    const std::int64_t first = (patch * blocks_ + k) * cells_;
    const Stretch stretch{first << place_.level, (first + cells_) << place_.level};
    Beyond beyond;
    look(other, side, stretch, beyond);
    if (!beyond.some) return;
    const PatchBounds& bounds = bounds_of(place_);
    const double delta = prepared_.header().quantiser.error_m(place_.level);
    const double most = double{std::max(bounds.high_m, beyond.high_m)} -
                        double{std::min(bounds.low_m, beyond.low_m)} +
                        2.0 * std::max(delta, beyond.delta_m);
    skirts.push_back({top_of(side, i, j), std::min(most, own_.bound_m(i, j) + beyond.bound_m)});
  }

  // West runs down, south to the east, east up, north to the west: outside lies to the right.
  std::vector<PatchPoint> top_of(std::size_t side, int i, int j) const {
    const int step = 1 << own_.levels(i, j).side[side];
    const int at = side == West    ? i * cells_
                   : side == East  ? (i + 1) * cells_
                   : side == South ? j * cells_
                                   : (j + 1) * cells_;
    const int first = (runs_up(side) ? j : i) * cells_;
    std::vector<PatchPoint> top;
    for (int along = 0; along <= cells_; along += step) {
      const auto a = static_cast<std::uint16_t>(at), b = static_cast<std::uint16_t>(first + along);
      top.push_back(runs_up(side) ? PatchPoint{a, b} : PatchPoint{b, a});
    }
    if (side == West || side == North) std::reverse(top.begin(), top.end());
    return top;
  }

  const PatchBounds& bounds_of(const PatchPlace& patch) const {
    return prepared_.bounds->patches[static_cast<std::size_t>(layout_.index(patch))];
  }
  std::int32_t state(const PatchPlace& patch) const {
    return selection_.state[static_cast<std::size_t>(layout_.index(patch))];
  }

  // Of the tree at and around a place of the same level: what is drawn along the stretch.
  void look(PatchPlace patch, std::size_t side, const Stretch& stretch, Beyond& beyond) const {
    PatchPlace above = patch;
    while (state(above) == PatchSelection::kLeftOut && above.level + 1 < layout_.levels)
      above = above.parent();
    if (state(above) >= 0) return gather(above, side, stretch, beyond);
    if (state(patch) == PatchSelection::kAbove) descend(patch, side, stretch, beyond);
  }

  void descend(const PatchPlace& patch, std::size_t side, const Stretch& stretch,
               Beyond& beyond) const {
    if (!layout_.contains(patch) || !touches(patch, side, stretch)) return;
    if (state(patch) >= 0) return gather(patch, side, stretch, beyond);
    if (state(patch) != PatchSelection::kAbove) return;
    // Children that face the side looked across.
    const int facing = side == West || side == South ? 1 : 0;
    for (int along = 0; along < 2; ++along) {
      descend(runs_up(side) ? patch.child(facing, along) : patch.child(along, facing), side,
              stretch, beyond);
    }
  }

  bool touches(const PatchPlace& patch, std::size_t side, const Stretch& stretch) const {
    const std::int64_t size = std::int64_t{layout_.patch_cells} << patch.level;
    const std::int64_t begin = (runs_up(side) ? patch.py : patch.px) * size;
    return begin < stretch.end && begin + size > stretch.begin;
  }

  void gather(const PatchPlace& patch, std::size_t side, const Stretch& stretch,
              Beyond& beyond) const {
    const PatchLevels& theirs = levels_.patches[static_cast<std::size_t>(state(patch))];
    const std::int64_t block = std::int64_t{cells_} << patch.level;
    const std::int64_t origin = std::int64_t{runs_up(side) ? patch.py : patch.px} * blocks_;
    const int edge = side == West || side == South ? blocks_ - 1 : 0;
    const auto first = static_cast<int>(std::max<std::int64_t>(stretch.begin / block - origin, 0));
    for (int k = first; k < blocks_ && (origin + k) * block < stretch.end; ++k) {
      const double bound = runs_up(side) ? theirs.bound_m(edge, k) : theirs.bound_m(k, edge);
      beyond.bound_m = std::max(beyond.bound_m, bound);
    }
    const PatchBounds& bounds = bounds_of(patch);
    beyond.low_m = beyond.some ? std::min(beyond.low_m, bounds.low_m) : bounds.low_m;
    beyond.high_m = beyond.some ? std::max(beyond.high_m, bounds.high_m) : bounds.high_m;
    beyond.some = true;
    beyond.delta_m = std::max(beyond.delta_m, prepared_.header().quantiser.error_m(patch.level));
  }

  const Prepared& prepared_;
  const PatchSelection& selection_;
  const ChosenLevels& levels_;
  const PatchLayout& layout_;
  int cells_, blocks_;
  const PatchPlace& place_;
  const PatchLevels& own_;
};

}  // namespace

std::vector<Skirt> skirts_of(const Prepared& prepared, const PatchSelection& selection,
                             const ChosenLevels& levels, std::size_t drawn) {
  return SkirtsOfPatch(prepared, selection, levels, drawn).take();
}

}  // namespace plumb::mesh::tessellation
