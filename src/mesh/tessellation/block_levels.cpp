#include "mesh/tessellation/block_levels.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "mesh/tessellation/published_levels.h"

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchPlace;

namespace {

constexpr std::array<std::array<int, 2>, 4> kAcross{{{-1, 0}, {0, -1}, {1, 0}, {0, 1}}};  // by Side

// A block's own choice: the coarsest whose bound is allowed.
struct OwnLevel {
  std::uint8_t level = 0;
  bool is_void = false;  // nothing is drawn of it: all void, or beyond the terrain
};

class Chooser {
 public:
  Chooser(const Prepared& prepared, const ViewTest& view, const PatchSelection& selection,
          const std::vector<Grid<float>>& heights_m)
      : prepared_(prepared),
        view_(view),
        selection_(selection),
        heights_m_(heights_m),
        layout_(prepared.header().layout),
        blocks_(layout_.patch_cells / prepared.pieces->block_cells()) {}

  ChosenLevels take() {
    const std::size_t count = selection_.drawn.size();
    ChosenLevels chosen;
    chosen.patches.resize(count);
    own_.resize(count);
    std::vector<LevelCounts> counts(count);
    parallel_for(static_cast<std::int64_t>(count), 1, [&](std::int64_t k) {
      const auto at = static_cast<std::size_t>(k);
      choose_own(at, chosen.patches[at], counts[at]);
    });
    parallel_for(static_cast<std::int64_t>(count), 1, [&](std::int64_t k) {
      agree(static_cast<std::size_t>(k), chosen.patches[static_cast<std::size_t>(k)]);
    });
    for (const LevelCounts& each : counts) chosen.counts.add(each);
    return chosen;
  }

 private:
  void choose_own(std::size_t at, PatchLevels& patch, LevelCounts& counts) {
    const PatchPlace& place = selection_.drawn[at];
    const PatchBounds bounds =
        thinned_bounds(*prepared_.container, *prepared_.bounds, *prepared_.foretold,
                       layout_.index(place), heights_m_[at]);
    const BoundScale& scale = prepared_.bounds->scale;
    const int cells = prepared_.pieces->block_cells();
    const Box whole = box_of(prepared_, place);
    own_[at] = Grid<OwnLevel>(blocks_, blocks_);
    patch = {Grid<BlockLevels>(blocks_, blocks_), Grid<double>(blocks_, blocks_)};
    for (int j = 0; j < blocks_; ++j) {
      for (int i = 0; i < blocks_; ++i) {
        OwnLevel& own = own_[at](i, j);
        Box box = box_of_samples(prepared_, place, heights_m_[at], i * cells, j * cells,
                                 (i + 1) * cells, (j + 1) * cells);
        own.is_void = box.empty() || box.low.x == box.high.x || box.low.y == box.high.y;
        const bool fine = prepared_.parameters.fine_selection;
        own.level = static_cast<std::uint8_t>(fine ? bounds.levels - 1 : 0);
        if (own.is_void) continue;
        ++counts.blocks;
        counts.sides += 4;
        // The truth is no farther from what full detail draws; nor does it leave the patch's box.
        const double full_m = scale.value(bounds.code(i, j, 0));
        box.low.z = std::max(box.low.z - full_m, whole.low.z);
        box.high.z = std::min(box.high.z + full_m, whole.high.z);
        const double allowed_m = view_.allowed_m(box);
        const auto keeps = [&](std::uint8_t code) {
          return code != BoundScale::kNone && scale.value(code) <= allowed_m;
        };
        while (own.level > 0 && !keeps(bounds.code(i, j, own.level))) --own.level;
        const double bound_m = scale.value(bounds.code(i, j, own.level));
        patch.bound_m(i, j) = bound_m;
        if (bound_m > allowed_m) {
          ++counts.unreachable;
          counts.worst_m = std::max(counts.worst_m, bound_m);
          counts.worst_reach = std::max(counts.worst_reach, view_.reach(box, bound_m));
        }
      }
    }
  }

  // What lies across a side, of the same level; null if that is another level, or nothing.
  const OwnLevel* across(std::size_t at, int i, int j, std::size_t side) const {
    PatchPlace place = selection_.drawn[at];
    int a = i + kAcross[side][0], b = j + kAcross[side][1];
    if (a < 0 || b < 0 || a >= blocks_ || b >= blocks_) {
      place.px += kAcross[side][0];
      place.py += kAcross[side][1];
      if (!layout_.contains(place)) return nullptr;
      const std::int32_t state = selection_.state[static_cast<std::size_t>(layout_.index(place))];
      if (state < 0) return nullptr;
      at = static_cast<std::size_t>(state);
      a = (a + blocks_) % blocks_;
      b = (b + blocks_) % blocks_;
    }
    return &own_[at](a, b);
  }

  void agree(std::size_t at, PatchLevels& patch) const {
    for (int j = 0; j < blocks_; ++j) {
      for (int i = 0; i < blocks_; ++i) {
        const std::uint8_t own = own_[at](i, j).level;
        BlockLevels& levels = patch.levels(i, j);
        levels.inside = own;
        for (std::size_t side = 0; side < 4; ++side) {
          const OwnLevel* other = across(at, i, j, side);
          levels.side[side] =
              other == nullptr || other->is_void ? own : std::min(own, other->level);
        }
      }
    }
  }

  const Prepared& prepared_;
  const ViewTest& view_;
  const PatchSelection& selection_;
  const std::vector<Grid<float>>& heights_m_;
  const patch_quadtree::PatchLayout& layout_;
  int blocks_;
  std::vector<Grid<OwnLevel>> own_;
};

}  // namespace

void LevelCounts::add(const LevelCounts& other) {
  blocks += other.blocks;
  sides += other.sides;
  unreachable += other.unreachable;
  worst_m = std::max(worst_m, other.worst_m);
  worst_reach = std::max(worst_reach, other.worst_reach);
  for (std::size_t k = 0; k < kCauses; ++k) finer[k] += other.finer[k];
}

Box box_of_samples(const Prepared& prepared, const PatchPlace& patch, const Grid<float>& heights_m,
                   int first_i, int first_j, int last_i, int last_j) {
  const auto& header = prepared.header();
  float low = 0.0f, high = 0.0f;
  bool some = false;
  for (int j = first_j; j <= last_j; ++j) {
    for (int i = first_i; i <= last_i; ++i) {
      const float height = heights_m(i + 1, j + 1);
      if (std::isnan(height)) continue;
      low = some ? std::min(low, height) : height;
      high = some ? std::max(high, height) : height;
      some = true;
    }
  }
  if (!some) return {};
  Box box;
  box.add({header.layout.sample_column(patch, first_i) * header.dx_m,
           header.layout.sample_row(patch, first_j) * header.dy_m, low});
  box.add({header.layout.sample_column(patch, last_i) * header.dx_m,
           header.layout.sample_row(patch, last_j) * header.dy_m, high});
  return box;
}

ChosenLevels choose_levels(const Prepared& prepared, const ViewTest& view,
                           const PatchSelection& selection,
                           const std::vector<Grid<float>>& heights_m) {
  if (prepared.parameters.variant == Variant::Conservative)
    return Chooser(prepared, view, selection, heights_m).take();
  ChosenLevels chosen;
  chosen.patches.resize(selection.drawn.size());
  std::vector<LevelCounts> counts(selection.drawn.size());
  parallel_for(static_cast<std::int64_t>(selection.drawn.size()), 1, [&](std::int64_t k) {
    const auto at = static_cast<std::size_t>(k);
    chosen.patches[at] =
        published_levels(prepared, view, selection.drawn[at], heights_m[at], counts[at]);
  });
  for (const LevelCounts& each : counts) chosen.counts.add(each);
  chosen.counts.finer[static_cast<std::size_t>(Cause::DistanceTest)] = selection.finer_by_distance;
  chosen.counts.finer[static_cast<std::size_t>(Cause::BilinearError)] = selection.finer_by_error;
  return chosen;
}

}  // namespace plumb::mesh::tessellation
