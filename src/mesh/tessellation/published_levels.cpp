#include "mesh/tessellation/published_levels.h"

#include <algorithm>
#include <cmath>

#include "mesh/tessellation/block_errors.h"

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchPlace;

namespace {

bool mends(const Mends& mended, Cause cause) { return mended[static_cast<std::size_t>(cause)]; }

// The screen's distance between both ends of a vertical length, each divided by its own depth as
// hardware does, wherever they lie.
double projected_px(const Camera& camera, const glm::dvec3& middle, double length_m) {
  const glm::dvec3 half{0.0, 0.0, 0.5 * length_m};
  const glm::dvec2 low = view_to_pixel(camera, to_view(camera, middle - half));
  const glm::dvec2 high = view_to_pixel(camera, to_view(camera, middle + half));
  const glm::dvec2 apart = high - low;
  return std::sqrt(glm::dot(apart, apart));
}

// What a side is tested by.
struct SideTest {
  glm::dvec3 middle{0.0};
  Box box;  // of the blocks on either side: what is drawn up to it may be in view where it is not
  bool is_void = true;  // no sample of it exists, or nothing is drawn on either side
};

double tested_length_px(const ViewTest& view, const SideTest& side, double length_m,
                        const Mends& mended) {
  const bool whole_side = mends(mended, Cause::EdgeMidpoint);
  const bool from_above = mends(mended, Cause::ViewFromAbove);
  const double as_seen_px = whole_side ? displacement_bound_px(view.camera, side.box, kUp, length_m)
                                       : projected_px(view.camera, side.middle, length_m);
  if (!from_above) return as_seen_px;
  // As if it were seen from the side; over the whole side, no less than it is seen.
  double depth = to_view(view.camera, side.middle).z;
  for (int k = 0; whole_side && k < 8; ++k)
    depth = std::min(depth, to_view(view.camera, side.box.corner(k)).z);
  depth = std::max(depth, view.camera.near_m);
  const double sideways_px = std::max(view.camera.gamma_h, view.camera.gamma_v) * length_m / depth;
  return whole_side ? std::max(sideways_px, as_seen_px) : sideways_px;
}

// The coarsest thinning that the test lets pass; lengths by thinning, the first unused.
std::uint8_t level_of_side(const ViewTest& view, const SideTest& side,
                           const std::vector<double>& lengths_m, const Mends& mended) {
  const auto passes = [&](std::size_t level) {
    if (!std::isfinite(lengths_m[level])) return false;
    if (view.in_metres()) return lengths_m[level] < view.tolerance.value;
    return tested_length_px(view, side, lengths_m[level], mended) < view.tolerance.value;
  };
  if (mends(mended, Cause::NotMonotone)) {
    std::size_t level = 0;
    while (level + 1 < lengths_m.size() && passes(level + 1)) ++level;
    return static_cast<std::uint8_t>(level);
  }
  for (std::size_t level = lengths_m.size() - 1; level > 0; --level) {
    if (passes(level)) return static_cast<std::uint8_t>(level);
  }
  return 0;
}

// How far a side is thinned; of one that is void it says nothing.
struct DecidedSide {
  std::uint8_t level = 0;
  bool is_void = false;
};

class PublishedPatch {
 public:
  PublishedPatch(const Prepared& prepared, const ViewTest& view, const PatchPlace& patch,
                 const Grid<float>& heights_m, LevelCounts& counts)
      : prepared_(prepared),
        view_(view),
        patch_(patch),
        heights_m_(heights_m),
        counts_(counts),
        mended_(prepared.parameters.mends),
        cells_(prepared.pieces->block_cells()),
        coarsest_(static_cast<std::uint8_t>(prepared.pieces->coarsest())),
        blocks_(prepared.header().layout.patch_cells / cells_),
        known_(blocks_, blocks_) {
    const auto number = prepared.header().layout.index(patch);
    error_m_ =
        mends(mended_, Cause::BilinearError)
            ? prepared.bounds->error_m(number)
            : double{prepared.bounds->patches[static_cast<std::size_t>(number)].published_m} +
                  prepared.header().quantiser.error_m(patch.level);
    for (int j = 0; j < blocks_; ++j)
      for (int i = 0; i < blocks_; ++i) known_(i, j) = measure(i, j);
  }

  PatchLevels take() {
    // Sides by their lower left block: west of block (i, j) at (i, j), and so on.
    Grid<DecidedSide> upright(blocks_ + 1, blocks_), level(blocks_, blocks_ + 1);
    for (int j = 0; j < blocks_; ++j)
      for (int i = 0; i <= blocks_; ++i) upright(i, j) = decide(i, j, West);
    for (int j = 0; j <= blocks_; ++j)
      for (int i = 0; i < blocks_; ++i) level(i, j) = decide(i, j, South);
    PatchLevels result{Grid<BlockLevels>(blocks_, blocks_), Grid<double>(blocks_, blocks_)};
    for (int j = 0; j < blocks_; ++j) {
      for (int i = 0; i < blocks_; ++i) {
        const std::array<DecidedSide, 4> sides{upright(i, j), level(i, j), upright(i + 1, j),
                                               level(i, j + 1)};
        result.levels(i, j) = levels_of(known_(i, j), sides);
        result.bound_m(i, j) = bound_m(i, j, result.levels(i, j));
      }
    }
    return result;
  }

 private:
  struct Block {
    const BlockGeometry* geometry = nullptr;  // null: nothing is drawn
    Box box;
    BlockErrors errors;
  };

  std::vector<double> heights_of(int i, int j) const {
    std::vector<double> heights;
    heights.reserve(static_cast<std::size_t>((cells_ + 1) * (cells_ + 1)));
    for (int b = 0; b <= cells_; ++b)
      for (int a = 0; a <= cells_; ++a)
        heights.push_back(double{heights_m_(i * cells_ + a + 1, j * cells_ + b + 1)});
    return heights;
  }

  Block measure(int i, int j) const {
    Block block;
    block.box = box_of_samples(prepared_, patch_, heights_m_, i * cells_, j * cells_,
                               (i + 1) * cells_, (j + 1) * cells_);
    if (block.box.empty()) return block;
    block.geometry = prepared_.geometries->of(patch_, i, j);
    if (block.geometry != nullptr && prepared_.parameters.fine_selection)
      block.errors = block.geometry->errors(heights_of(i, j));
    return block;
  }

  BlockLevels levels_of(const Block& block, const std::array<DecidedSide, 4>& sides) {
    BlockLevels levels;
    std::uint8_t finest = coarsest_, coarsest = 0;
    bool some = false;
    for (std::size_t k = 0; k < 4; ++k) {
      levels.side[k] = sides[k].level;
      if (sides[k].is_void) continue;
      some = true;
      finest = std::min(finest, sides[k].level);
      coarsest = std::max(coarsest, sides[k].level);
    }
    if (block.geometry == nullptr) {
      levels.inside = prepared_.parameters.fine_selection ? coarsest_ : std::uint8_t{0};
      return levels;
    }
    ++counts_.blocks;
    if (!some) return levels;  // what there is lies amid voids: in full
    const bool mended = mends(mended_, Cause::InnerMinimum);
    levels.inside = mended ? finest : coarsest;
    counts_.finer[static_cast<std::size_t>(Cause::InnerMinimum)] += !mended && finest != coarsest;
    return levels;
  }

  // As printed it is what the paper claims of a block, whether or not its sides keep it. Where the
  // inside is finer than sides, they are drawn as no printed lambda says: then it is what is drawn.
  double bound_m(int i, int j, const BlockLevels& levels) const {
    const Block& block = known_(i, j);
    if (block.geometry == nullptr) return 0.0;
    if (!prepared_.parameters.fine_selection) return error_m_;
    if (mends(mended_, Cause::InnerMinimum))
      return block.geometry->drawn_error_m(levels, heights_of(i, j)) + error_m_;
    const bool mixed = mends(mended_, Cause::MixedFactors);
    return lambdas_m(block.errors, mixed)[levels.inside] + error_m_;
  }

  const std::vector<double>& lambdas_m(const BlockErrors& errors, bool mixed) const {
    if (!mixed) return errors.printed_m;
    return mends(mended_, Cause::InnerMinimum) ? errors.any_inside_m : errors.mixed_m;
  }

  // The blocks on either side of one of a patch's sides, those of which anything is drawn.
  template <class Visit>
  void for_each_beside(int i, int j, Side side, const Visit& visit) const {
    const int before_i = side == West ? i - 1 : i, before_j = side == South ? j - 1 : j;
    if (i < blocks_ && j < blocks_ && known_(i, j).geometry != nullptr) visit(known_(i, j));
    if (before_i >= 0 && before_j >= 0 && known_(before_i, before_j).geometry != nullptr)
      visit(known_(before_i, before_j));
  }

  // The larger Lambda of the blocks on either side, by thinning.
  std::vector<double> lengths_m(int i, int j, Side side, bool mixed) const {
    std::vector<double> lengths(std::size_t{coarsest_} + 1, 0.0);
    for_each_beside(i, j, side, [&](const Block& block) {
      const std::vector<double>& lambdas = lambdas_m(block.errors, mixed);
      for (std::size_t level = 1; level < lengths.size(); ++level)
        lengths[level] = std::max(lengths[level], lambdas[level]);
    });
    for (double& length : lengths) length += error_m_;
    return lengths;
  }

  SideTest test_of(int i, int j, Side side) const {
    const int first_i = i * cells_, first_j = j * cells_;
    const int last_i = side == West ? first_i : first_i + cells_,
              last_j = side == South ? first_j : first_j + cells_;
    SideTest test;
    const Box own = box_of_samples(prepared_, patch_, heights_m_, first_i, first_j, last_i, last_j);
    if (own.empty()) return test;
    for_each_beside(i, j, side, [&](const Block& block) {
      test.is_void = false;
      test.box.add(block.box);
    });
    const auto& header = prepared_.header();
    const int middle_i = (first_i + last_i) / 2, middle_j = (first_j + last_j) / 2;
    const float height = heights_m_(middle_i + 1, middle_j + 1);
    test.middle = {header.layout.sample_column(patch_, middle_i) * header.dx_m,
                   header.layout.sample_row(patch_, middle_j) * header.dy_m,
                   std::isnan(height) ? own.low.z : double{height}};
    return test;
  }

  DecidedSide decide(int i, int j, Side side) {
    if (!prepared_.parameters.fine_selection) return {};
    const SideTest test = test_of(i, j, side);
    if (test.is_void) return {coarsest_, true};
    ++counts_.sides;
    const bool mixed = mends(mended_, Cause::MixedFactors);
    const std::vector<double> lengths = lengths_m(i, j, side, mixed);
    const std::uint8_t chosen = level_of_side(view_, test, lengths, mended_);
    for (const Cause cause : {Cause::EdgeMidpoint, Cause::ViewFromAbove, Cause::NotMonotone}) {
      if (mends(mended_, cause)) continue;
      Mends one_more = mended_;
      one_more[static_cast<std::size_t>(cause)] = true;
      counts_.finer[static_cast<std::size_t>(cause)] +=
          level_of_side(view_, test, lengths, one_more) < chosen;
    }
    if (!mixed) {
      counts_.finer[static_cast<std::size_t>(Cause::MixedFactors)] +=
          level_of_side(view_, test, lengths_m(i, j, side, true), mended_) < chosen;
    }
    return {chosen, false};
  }

  const Prepared& prepared_;
  const ViewTest& view_;
  const PatchPlace& patch_;
  const Grid<float>& heights_m_;
  LevelCounts& counts_;
  const Mends& mended_;
  int cells_;
  std::uint8_t coarsest_;
  int blocks_;
  double error_m_ = 0.0;
  Grid<Block> known_;
};

}  // namespace

PatchLevels published_levels(const Prepared& prepared, const ViewTest& view,
                             const PatchPlace& patch, const Grid<float>& heights_m,
                             LevelCounts& counts) {
  return PublishedPatch(prepared, view, patch, heights_m, counts).take();
}

}  // namespace plumb::mesh::tessellation
