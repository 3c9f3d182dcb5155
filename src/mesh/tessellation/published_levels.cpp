#include "mesh/tessellation/published_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/tessellation/piece_deviation.h"

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchPlace;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool mends(const Mends& mended, Cause cause) { return mended[static_cast<std::size_t>(cause)]; }

// A block's pieces over the patch's own samples.
struct OwnGeometry {
  std::vector<PieceGeometry> interior, strips;
  PieceGeometry whole;
};

OwnGeometry geometry_over_samples(const BlockPieces& pieces) {
  BlockPlaces places;
  const int cells = pieces.block_cells();
  for (int k = 0; k <= cells; ++k) places.column.push_back(k);
  places.row = places.column;
  OwnGeometry geometry{{}, {}, PieceGeometry(pieces.whole(), places, cells)};
  for (int inside = 0; inside < pieces.coarsest(); ++inside) {
    geometry.interior.emplace_back(pieces.interior(inside), places, cells);
    for (std::size_t side = 0; side < 4; ++side) {
      for (int along = 0; along <= pieces.coarsest(); ++along)
        geometry.strips.emplace_back(pieces.strip(inside, side, along), places, cells);
    }
  }
  return geometry;
}

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
  Box box;
};

double tested_length_px(const ViewTest& view, const SideTest& side, double length_m,
                        const Mends& mended) {
  const bool whole_side = mends(mended, Cause::EdgeMidpoint);
  const bool from_above = mends(mended, Cause::ViewFromAbove);
  if (!from_above)
    return whole_side ? displacement_bound_px(view.camera, side.box, kUp, length_m)
                      : projected_px(view.camera, side.middle, length_m);
  // As if it were seen from the side.
  double depth = to_view(view.camera, side.middle).z;
  for (int k = 0; whole_side && k < 8; ++k)
    depth = std::min(depth, to_view(view.camera, side.box.corner(k)).z);
  depth = std::max(depth, view.camera.near_m);
  return std::max(view.camera.gamma_h, view.camera.gamma_v) * length_m / depth;
}

// The coarsest thinning that the test lets pass; lengths by thinning, the first unused.
std::uint8_t level_of_side(const ViewTest& view, const SideTest& side,
                           const std::vector<double>& lengths_m, const Mends& mended) {
  const auto passes = [&](std::size_t level) {
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
        blocks_(prepared.header().layout.patch_cells / cells_),
        printed_(*prepared.pieces, heights_m, false),
        mixed_(*prepared.pieces, heights_m, true) {
    const auto number = prepared.header().layout.index(patch);
    error_m_ =
        mends(mended_, Cause::BilinearError)
            ? prepared.bounds->error_m(number)
            : double{prepared.bounds->patches[static_cast<std::size_t>(number)].published_m} +
                  prepared.header().quantiser.error_m(patch.level);
  }

  PatchLevels take() {
    // Sides by their lower left block: west of block (i, j) at (i, j), and so on.
    Grid<std::uint8_t> upright(blocks_ + 1, blocks_), level(blocks_, blocks_ + 1);
    for (int j = 0; j < blocks_; ++j)
      for (int i = 0; i <= blocks_; ++i) upright(i, j) = decide(i, j, West);
    for (int j = 0; j <= blocks_; ++j)
      for (int i = 0; i < blocks_; ++i) level(i, j) = decide(i, j, South);
    PatchLevels result{Grid<BlockLevels>(blocks_, blocks_), Grid<double>(blocks_, blocks_)};
    for (int j = 0; j < blocks_; ++j) {
      for (int i = 0; i < blocks_; ++i) {
        BlockLevels& levels = result.levels(i, j);
        levels.side = {upright(i, j), level(i, j), upright(i + 1, j), level(i, j + 1)};
        const auto [finest, coarsest] = std::minmax_element(levels.side.begin(), levels.side.end());
        const bool mended = mends(mended_, Cause::InnerMinimum);
        levels.inside = mended ? *finest : *coarsest;
        ++counts_.blocks;
        counts_.finer[static_cast<std::size_t>(Cause::InnerMinimum)] +=
            !mended && *finest != *coarsest;
        result.bound_m(i, j) = errors().lambda_m(i, j, levels.inside) + error_m_;
      }
    }
    return result;
  }

 private:
  const BlockErrors& errors() const {
    return mends(mended_, Cause::MixedFactors) ? mixed_ : printed_;
  }

  // The larger Lambda of the blocks on either side, by thinning.
  std::vector<double> lengths_m(const BlockErrors& errors, int i, int j, Side side) const {
    std::vector<double> lengths(static_cast<std::size_t>(prepared_.pieces->coarsest()) + 1, 0.0);
    const int left = side == West ? i - 1 : i, below = side == South ? j - 1 : j;
    for (std::size_t level = 1; level < lengths.size(); ++level) {
      double lambda = 0.0;
      if (i < blocks_ && j < blocks_) lambda = errors.lambda_m(i, j, static_cast<int>(level));
      if (left >= 0 && below >= 0)
        lambda = std::max(lambda, errors.lambda_m(left, below, static_cast<int>(level)));
      lengths[level] = lambda + error_m_;
    }
    return lengths;
  }

  SideTest test_of(int i, int j, Side side) const {
    const int first_i = i * cells_, first_j = j * cells_;
    const int last_i = side == West ? first_i : first_i + cells_,
              last_j = side == South ? first_j : first_j + cells_;
    SideTest test;
    test.box = box_of_samples(prepared_, patch_, heights_m_, first_i, first_j, last_i, last_j);
    if (test.box.empty()) return test;
    const auto& header = prepared_.header();
    const int middle_i = (first_i + last_i) / 2, middle_j = (first_j + last_j) / 2;
    const float height = heights_m_(middle_i + 1, middle_j + 1);
    test.middle = {header.layout.sample_column(patch_, middle_i) * header.dx_m,
                   header.layout.sample_row(patch_, middle_j) * header.dy_m,
                   std::isnan(height) ? test.box.low.z : double{height}};
    return test;
  }

  std::uint8_t decide(int i, int j, Side side) {
    const SideTest test = test_of(i, j, side);
    if (!prepared_.parameters.fine_selection) return 0;
    if (test.box.empty()) return static_cast<std::uint8_t>(prepared_.pieces->coarsest());
    ++counts_.sides;
    const std::vector<double> lengths = lengths_m(errors(), i, j, side);
    const std::uint8_t chosen = level_of_side(view_, test, lengths, mended_);
    for (const Cause cause : {Cause::EdgeMidpoint, Cause::ViewFromAbove, Cause::NotMonotone}) {
      if (mends(mended_, cause)) continue;
      Mends one_more = mended_;
      one_more[static_cast<std::size_t>(cause)] = true;
      counts_.finer[static_cast<std::size_t>(cause)] +=
          level_of_side(view_, test, lengths, one_more) < chosen;
    }
    if (!mends(mended_, Cause::MixedFactors)) {
      counts_.finer[static_cast<std::size_t>(Cause::MixedFactors)] +=
          level_of_side(view_, test, lengths_m(mixed_, i, j, side), mended_) < chosen;
    }
    return chosen;
  }

  const Prepared& prepared_;
  const ViewTest& view_;
  const PatchPlace& patch_;
  const Grid<float>& heights_m_;
  LevelCounts& counts_;
  const Mends& mended_;
  int cells_, blocks_;
  BlockErrors printed_, mixed_;
  double error_m_ = 0.0;
};

}  // namespace

BlockErrors::BlockErrors(const BlockPieces& pieces, const Grid<float>& heights_m, bool mixed) {
  const OwnGeometry geometry = geometry_over_samples(pieces);
  const int cells = pieces.block_cells(), coarsest = pieces.coarsest();
  blocks_ = (heights_m.columns() - 3) / cells;
  levels_ = coarsest + 1;
  std::vector<double> drawn_m(static_cast<std::size_t>((cells + 1) * (cells + 1)));
  for (int j = 0; j < blocks_; ++j) {
    for (int i = 0; i < blocks_; ++i) {
      for (int b = 0; b <= cells; ++b)
        for (int a = 0; a <= cells; ++a)
          drawn_m[static_cast<std::size_t>(b * (cells + 1) + a)] =
              double{heights_m(i * cells + a + 1, j * cells + b + 1)};
      const TruthBelow own{&heights_m(i * cells + 1, j * cells + 1), heights_m.columns()};
      const auto deviation = [&](const PieceGeometry& piece) {
        return mixed ? piece.deviation(drawn_m, own) : piece.sample_deviation(drawn_m, own);
      };
      errors_m_.push_back(0.0);
      for (int level = 1; level <= coarsest; ++level) {
        const int inside = pieces.drawn_inside(level);
        // Under one factor, 1 all round is two triangles.
        const bool one_whole = level == coarsest;
        double largest = one_whole ? deviation(geometry.whole) : 0.0;
        if (!one_whole || mixed) {
          largest =
              std::max(largest, deviation(geometry.interior[static_cast<std::size_t>(inside)]));
          for (int side = 0; side < 4; ++side) {
            for (int along = mixed ? 0 : level; along <= level; ++along)
              largest = std::max(largest, deviation(geometry.strips[static_cast<std::size_t>(
                                              (inside * 4 + side) * (coarsest + 1) + along)]));
          }
        }
        errors_m_.push_back(largest);
      }
    }
  }
}

PatchLevels published_levels(const Prepared& prepared, const ViewTest& view,
                             const PatchPlace& patch, const Grid<float>& heights_m,
                             LevelCounts& counts) {
  return PublishedPatch(prepared, view, patch, heights_m, counts).take();
}

}  // namespace plumb::mesh::tessellation
