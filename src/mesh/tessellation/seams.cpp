#include "mesh/tessellation/seams.h"

#include <algorithm>
#include <cmath>

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchLayout;
using patch_quadtree::PatchPlace;

namespace {

// Walls hang this much below the lower rim: more than the rasteriser's 1/256 of a pixel, far less
// than what is tolerated.
constexpr double kMarginOfTolerance = 0.125, kLeastMargin_px = 1.0 / 64.0;
constexpr double kMarginOfSpacing = 1e-3;  // where no camera looks

bool runs_up(std::size_t side) { return side == West || side == East; }
std::size_t facing(std::size_t side) { return (side + 2) % 4; }

// A rim as it is drawn: vertices by their place along it, in cells of the finest level.
struct RimVertex {
  std::int64_t at;
  PatchPoint point;
  double height_m;
  bool drawn_after;  // the piece from here to the next vertex
};
struct Rim {
  std::int32_t drawn;
  std::vector<RimVertex> vertices;

  // The piece that holds the stretch from `at` on; the last vertex if there is none.
  std::size_t piece(std::int64_t at, std::size_t from) const {
    while (from + 2 < vertices.size() && vertices[from + 1].at <= at) ++from;
    return from;
  }
  double height_m(std::size_t piece, std::int64_t at) const {
    const RimVertex &a = vertices[piece], &b = vertices[piece + 1];
    if (at == a.at) return a.height_m;
    if (at == b.at) return b.height_m;
    const double share = static_cast<double>(at - a.at) / static_cast<double>(b.at - a.at);
    return a.height_m + share * (b.height_m - a.height_m);
  }
};

// Of a piece of a rim that the other rim's vertices split: the walls' lower ends at the first and
// the last of these.
struct Split {
  bool some = false;
  glm::dvec3 first_m{0.0}, last_m{0.0};
};

class SeamsOfPatch {
 public:
  SeamsOfPatch(const Prepared& prepared, const ViewTest& view, const PatchSelection& selection,
               const std::vector<Grid<float>>& heights_m, const ChosenLevels& levels,
               const std::vector<PatchMesh>& meshes, std::size_t drawn)
      : prepared_(prepared),
        view_(view),
        selection_(selection),
        heights_m_(heights_m),
        levels_(levels),
        meshes_(meshes),
        layout_(prepared.header().layout),
        cells_(prepared.pieces->block_cells()),
        blocks_(layout_.patch_cells / cells_),
        drawn_(static_cast<std::int32_t>(drawn)),
        place_(selection.drawn[drawn]) {}

  std::vector<SeamTriangle> take() {
    for (std::size_t side = 0; side < 4; ++side) {
      const std::int32_t other = coarser_across(side);
      if (other < 0) continue;
      side_ = side;
      set_margins();
      close(rim_of(drawn_, side), rim_of(other, facing(side)));
    }
    return std::move(triangles_);
  }

 private:
  std::int32_t coarser_across(std::size_t side) const {
    PatchPlace other = place_;
    (runs_up(side) ? other.px : other.py) += side == West || side == South ? -1 : 1;
    if (!layout_.contains(other)) return -1;
    const auto state = [&](const PatchPlace& patch) {
      return selection_.state[static_cast<std::size_t>(layout_.index(patch))];
    };
    if (state(other) != PatchSelection::kLeftOut) return -1;  // of this level, or finer
    while (state(other) == PatchSelection::kLeftOut && other.level + 1 < layout_.levels)
      other = other.parent();
    return state(other);
  }

  int last() const { return (runs_up(side_) ? layout_.rows : layout_.columns) - 1; }

  // How far walls hang below the lower rim, by the patch's blocks along the side.
  void set_margins() {
    const Grid<float>& heights_m = heights_m_[static_cast<std::size_t>(drawn_)];
    const auto& header = prepared_.header();
    margins_m_.assign(static_cast<std::size_t>(blocks_), 0.0);
    for (int k = 0; k < blocks_; ++k) {
      const int i = side_ == West ? 0 : side_ == East ? blocks_ - 1 : k;
      const int j = side_ == South ? 0 : side_ == North ? blocks_ - 1 : k;
      const Box box = box_of_samples(prepared_, place_, heights_m, i * cells_, j * cells_,
                                     (i + 1) * cells_, (j + 1) * cells_);
      const double unseen_m = kMarginOfSpacing * std::max(header.dx_m, header.dy_m);
      double margin_m = kMarginOfTolerance * view_.tolerance.value;
      if (view_.in_metres()) {
        margin_m = margin_m > 0.0 ? margin_m : unseen_m;
      } else {
        margin_m =
            allowed_displacement_m(view_.camera, box, kUp, std::max(margin_m, kLeastMargin_px));
      }
      margins_m_[static_cast<std::size_t>(k)] = std::isfinite(margin_m) ? margin_m : unseen_m;
    }
  }
  double margin_m(std::int64_t at) const {
    const std::int64_t first =
        (std::int64_t{runs_up(side_) ? place_.py : place_.px} * layout_.patch_cells)
        << place_.level;
    const std::int64_t block = (at - first) / (std::int64_t{cells_} << place_.level);
    return margins_m_[static_cast<std::size_t>(std::clamp<std::int64_t>(block, 0, blocks_ - 1))];
  }

  Rim rim_of(std::int32_t drawn, std::size_t side) const {
    const auto index = static_cast<std::size_t>(drawn);
    const PatchPlace& place = selection_.drawn[index];
    const int across = side == West || side == South ? 0 : layout_.patch_cells;
    const auto marks = meshes_[index].rim(side);
    Rim rim{drawn, {}};
    const auto add = [&](int along) {
      const PatchPoint point{static_cast<std::uint16_t>(runs_up(side) ? across : along),
                             static_cast<std::uint16_t>(runs_up(side) ? along : across)};
      const int at =
          runs_up(side) ? layout_.sample_row(place, along) : layout_.sample_column(place, along);
      if (!rim.vertices.empty() && rim.vertices.back().at == at) return;  // beyond the terrain
      rim.vertices.push_back(
          {at, point, double{heights_m_[index](point.i + 1, point.j + 1)},
           along < layout_.patch_cells && marks[static_cast<std::size_t>(along)] != 0});
    };
    for (int k = 0; k < blocks_; ++k) {
      const int i = side == West ? 0 : side == East ? blocks_ - 1 : k;
      const int j = side == South ? 0 : side == North ? blocks_ - 1 : k;
      const int step = 1 << levels_.patches[index].levels(i, j).side[side];
      for (int along = k * cells_; along < (k + 1) * cells_; along += step) add(along);
    }
    add(layout_.patch_cells);
    return rim;
  }

  glm::dvec3 position(std::int64_t at, double height_m) const {
    const auto& header = prepared_.header();
    const int n = layout_.patch_cells;
    const int fixed = side_ == West    ? layout_.sample_column(place_, 0)
                      : side_ == East  ? layout_.sample_column(place_, n)
                      : side_ == South ? layout_.sample_row(place_, 0)
                                       : layout_.sample_row(place_, n);
    const auto along = static_cast<double>(at);
    return runs_up(side_) ? glm::dvec3{fixed * header.dx_m, along * header.dy_m, height_m}
                          : glm::dvec3{along * header.dx_m, fixed * header.dy_m, height_m};
  }

  // Piece by piece between all vertices of both rims.
  void close(const Rim& fine, const Rim& coarse) {
    std::vector<std::int64_t> places;
    for (const RimVertex& vertex : fine.vertices) places.push_back(vertex.at);
    for (const RimVertex& vertex : coarse.vertices)
      if (vertex.at > places.front() && vertex.at < fine.vertices.back().at)
        places.push_back(vertex.at);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    close_between(fine, coarse, places);
    close_between(coarse, fine, places);
  }

  // What hangs from `upper` down to `lower`, where it is no lower. Rims that are level hang too:
  // where one has vertices that the other has not, rounding leaves pixels open.
  void close_between(const Rim& upper, const Rim& lower, const std::vector<std::int64_t>& places) {
    std::size_t u = 0, l = 0, of_split = 0;
    Split split;
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      u = upper.piece(places[k], u);
      l = lower.piece(places[k], l);
      if (u != of_split) hang_along(upper, of_split, split);
      of_split = u;
      if (!upper.vertices[u].drawn_after || !lower.vertices[l].drawn_after) continue;
      const Drop a = drop(upper, u, lower, l, places[k]),
                 b = drop(upper, u, lower, l, places[k + 1]);
      const bool is_above = a.top_m > a.lower_m || b.top_m > b.lower_m;
      const bool is_level = a.top_m == a.lower_m && b.top_m == b.lower_m;
      if (!is_above && !is_level) continue;
      hang(a, b);
      for (const Drop& end : {a, b}) {
        if (end.top.drawn >= 0) continue;
        if (!split.some) split.first_m = end.bottom;
        split = {true, split.first_m, end.bottom};
      }
    }
    hang_along(upper, of_split, split);
  }

  // A place of the wall: its upper end, and how far down it goes.
  struct Drop {
    SeamCorner top;
    double top_m, lower_m, bottom_m;
    glm::dvec3 bottom;
  };
  Drop drop(const Rim& upper, std::size_t u, const Rim& lower, std::size_t l,
            std::int64_t at) const {
    const auto vertex = [&](const Rim& rim, std::size_t piece) -> const RimVertex* {
      for (std::size_t k = piece; k <= piece + 1; ++k)
        if (rim.vertices[k].at == at) return &rim.vertices[k];
      return nullptr;
    };
    const RimVertex *own = vertex(upper, u), *theirs = vertex(lower, l);
    Drop result;
    result.top_m = upper.height_m(u, at);
    result.lower_m = lower.height_m(l, at);
    const bool meet = own != nullptr && theirs != nullptr && result.top_m == result.lower_m;
    result.bottom_m = std::min(result.top_m, result.lower_m) - (meet ? 0.0 : margin_m(at));
    result.bottom = position(at, result.bottom_m);
    result.top.place_m = position(at, result.top_m);
    if (own != nullptr) {
      result.top.drawn = upper.drawn;
      result.top.point = own->point;
    }
    return result;
  }

  static SeamCorner corner_at(const glm::dvec3& place_m) { return {-1, {}, place_m}; }

  void hang(const Drop& a, const Drop& b) {
    if (a.top_m > a.bottom_m)
      triangles_.push_back({a.top, corner_at(a.bottom), corner_at(b.bottom)});
    if (b.top_m > b.bottom_m) triangles_.push_back({a.top, corner_at(b.bottom), b.top});
  }

  // Vertices of the other rim split a piece's wall, but not the piece: along its edge, where
  // rounding would leave pixels open, a strip that has the piece's own two vertices.
  void hang_along(const Rim& upper, std::size_t piece, Split& split) {
    if (split.some) {
      const SeamCorner a{upper.drawn, upper.vertices[piece].point, {}},
          b{upper.drawn, upper.vertices[piece + 1].point, {}};
      triangles_.push_back({a, corner_at(split.first_m), b});
      if (split.first_m != split.last_m)
        triangles_.push_back({b, corner_at(split.first_m), corner_at(split.last_m)});
    }
    split = {};
  }

  const Prepared& prepared_;
  const ViewTest& view_;
  const PatchSelection& selection_;
  const std::vector<Grid<float>>& heights_m_;
  const ChosenLevels& levels_;
  const std::vector<PatchMesh>& meshes_;
  const PatchLayout& layout_;
  int cells_, blocks_;
  std::int32_t drawn_;
  const PatchPlace& place_;
  std::size_t side_ = 0;
  std::vector<double> margins_m_;
  std::vector<SeamTriangle> triangles_;
};

}  // namespace

std::vector<SeamTriangle> seams_of(const Prepared& prepared, const ViewTest& view,
                                   const PatchSelection& selection,
                                   const std::vector<Grid<float>>& heights_m,
                                   const ChosenLevels& levels, const std::vector<PatchMesh>& meshes,
                                   std::size_t drawn) {
  return SeamsOfPatch(prepared, view, selection, heights_m, levels, meshes, drawn).take();
}

}  // namespace plumb::mesh::tessellation
