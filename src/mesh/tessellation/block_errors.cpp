#include "mesh/tessellation/block_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/parallel.h"

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchLayout;
using patch_quadtree::PatchPlace;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Place {
  std::int64_t column, row;

  friend bool operator==(const Place&, const Place&) = default;
};

Place place(int i, int j, const BlockPlaces& places) {
  return {places.column[static_cast<std::size_t>(i)], places.row[static_cast<std::size_t>(j)]};
}

// Twice the area of a triangle, positive if it runs counter-clockwise.
std::int64_t area(const Place& a, const Place& b, const Place& c) {
  return (b.column - a.column) * (c.row - a.row) - (c.column - a.column) * (b.row - a.row);
}

}  // namespace

BlockGeometry::BlockGeometry(const BlockPieces& pieces, const BlockPlaces& places)
    : cells_(pieces.block_cells()),
      coarsest_(pieces.coarsest()),
      whole_(piece_of(pieces.whole(), places)) {
  for (int inside = 0; inside < coarsest_; ++inside) {
    interior_.push_back(piece_of(pieces.interior(inside), places));
    for (std::size_t side = 0; side < 4; ++side) {
      for (int along = 0; along <= coarsest_; ++along)
        strips_.push_back(piece_of(pieces.strip(inside, side, along), places));
    }
  }
}

BlockGeometry::Piece BlockGeometry::piece_of(const std::vector<BlockTriangle>& triangles,
                                             const BlockPlaces& places) const {
  Piece piece;
  std::set<std::pair<BlockPoint, BlockPoint>> edges;
  for (const BlockTriangle& triangle : triangles) {
    add_plane(triangle, places, piece);
    for (std::size_t k = 0; k < 3; ++k)
      edges.insert(std::minmax(triangle[k], triangle[(k + 1) % 3]));
  }
  for (const auto& [from, to] : edges) add_crossings(from, to, places, piece);
  return piece;
}

void BlockGeometry::add_plane(const BlockTriangle& triangle, const BlockPlaces& places,
                              Piece& piece) const {
  const auto& [p, q, r] = triangle;
  const Place a = place(p.i, p.j, places), b = place(q.i, q.j, places), c = place(r.i, r.j, places);
  const std::int64_t whole = area(a, b, c);
  if (whole <= 0) return;  // beyond the terrain
  Plane plane{{number(p.i, p.j), number(q.i, q.j), number(r.i, r.j)}, piece.covered.size(), 0};
  const auto [west, east] = std::minmax({p.i, q.i, r.i});
  const auto [south, north] = std::minmax({p.j, q.j, r.j});
  for (int j = south; j <= north; ++j) {
    for (int i = west; i <= east; ++i) {
      const Place at = place(i, j, places);
      if (at == a || at == b || at == c) continue;
      // Where cells have no width several samples are one.
      if ((i > west && place(i - 1, j, places) == at) ||
          (j > south && place(i, j - 1, places) == at))
        continue;
      const std::int64_t left_of_ab = area(a, b, at), left_of_ca = area(c, a, at);
      if (left_of_ab < 0 || left_of_ca < 0 || whole - left_of_ab - left_of_ca < 0) continue;
      piece.covered.push_back({number(i, j),
                               static_cast<double>(left_of_ca) / static_cast<double>(whole),
                               static_cast<double>(left_of_ab) / static_cast<double>(whole)});
    }
  }
  plane.last = piece.covered.size();
  piece.planes.push_back(plane);
}

// Full detail's edges are the sides of cells and one diagonal of each, to the block's centre.
void BlockGeometry::add_crossings(const BlockPoint& from, const BlockPoint& to,
                                  const BlockPlaces& places, Piece& piece) const {
  const Place p = place(from.i, from.j, places), q = place(to.i, to.j, places);
  if (p.column == q.column || p.row == q.row) return;  // along edges of full detail
  const auto add = [&](int a_i, int a_j, int b_i, int b_j) {
    const Place a = place(a_i, a_j, places), b = place(b_i, b_j, places);
    const std::int64_t a_off = area(p, q, a), b_off = area(p, q, b), from_off = area(a, b, p),
                       to_off = area(a, b, q);
    const auto apart = [](std::int64_t x, std::int64_t y) {
      return (x < 0 && y > 0) || (x > 0 && y < 0);
    };
    if (!apart(a_off, b_off) || !apart(from_off, to_off)) return;
    piece.crossings.push_back(
        {number(from.i, from.j), number(to.i, to.j), number(a_i, a_j), number(b_i, b_j),
         static_cast<double>(from_off) / static_cast<double>(from_off - to_off),
         static_cast<double>(a_off) / static_cast<double>(a_off - b_off)});
  };
  const int half = cells_ / 2;
  const auto [west, east] = std::minmax(from.i, to.i);
  const auto [south, north] = std::minmax(from.j, to.j);
  for (int j = south; j < north; ++j) {
    for (int i = west; i < east; ++i) {
      add(i, j, i, j + 1);
      add(i, j, i + 1, j);
      if ((i < half) == (j < half))
        add(i, j, i + 1, j + 1);
      else
        add(i, j + 1, i + 1, j);
    }
  }
}

BlockGeometry::Deviation BlockGeometry::deviation(const Piece& piece,
                                                  std::span<const double> heights_m) {
  Deviation largest;
  for (const Plane& plane : piece.planes) {
    const double height = heights_m[plane.corner[0]];
    const double rise_1 = heights_m[plane.corner[1]] - height,
                 rise_2 = heights_m[plane.corner[2]] - height;
    for (std::size_t k = plane.first; k < plane.last; ++k) {
      const Covered& each = piece.covered[k];
      const double drawn = height + (each.weight_1 * rise_1 + each.weight_2 * rise_2);
      const double off = std::abs(drawn - heights_m[each.sample]);
      largest.at_samples_m = off > largest.at_samples_m ? off : largest.at_samples_m;
    }
  }
  largest.anywhere_m = largest.at_samples_m;
  for (const Crossing& each : piece.crossings) {
    const double from = heights_m[each.from], a = heights_m[each.a];
    const double off = std::abs(from + each.along * (heights_m[each.to] - from) -
                                (a + each.across * (heights_m[each.b] - a)));
    largest.anywhere_m = off > largest.anywhere_m ? off : largest.anywhere_m;
  }
  return largest;
}

bool BlockGeometry::changes_outline(const Piece& piece, std::span<const double> heights_m) {
  for (const Plane& plane : piece.planes) {
    const bool is_drawn = std::none_of(plane.corner.begin(), plane.corner.end(),
                                       [&](std::uint32_t k) { return std::isnan(heights_m[k]); });
    for (std::size_t k = plane.first; k < plane.last; ++k)
      if (std::isnan(heights_m[piece.covered[k].sample]) == is_drawn) return true;
  }
  return false;
}

BlockErrors BlockGeometry::errors(std::span<const double> heights_m) const {
  const bool some_void =
      std::any_of(heights_m.begin(), heights_m.end(), [](double h) { return std::isnan(h); });
  const auto measure = [&](const Piece& piece) {
    if (some_void && changes_outline(piece, heights_m)) return Deviation{kInfinity, kInfinity};
    return deviation(piece, heights_m);
  };
  const auto size = static_cast<std::size_t>(coarsest_) + 1;
  BlockErrors errors{std::vector<double>(size, 0.0), std::vector<double>(size, 0.0),
                     std::vector<double>(size, 0.0)};
  const auto raise = [](std::vector<double>& of, int level, double length_m) {
    double& here = of[static_cast<std::size_t>(level)];
    here = std::max(here, length_m);
  };
  const auto raise_mixed = [&](int level, double length_m) {
    raise(errors.mixed_m, level, length_m);
    raise(errors.any_inside_m, level, length_m);
  };
  for (int inside = 0; inside < coarsest_; ++inside) {
    // Inside 1 beside any other factor is drawn as 2.
    const bool is_last = inside + 1 == coarsest_;
    const Deviation interior = measure(interior_[static_cast<std::size_t>(inside)]);
    raise(errors.printed_m, inside, interior.at_samples_m);
    raise_mixed(inside, interior.anywhere_m);
    if (is_last) raise_mixed(coarsest_, interior.anywhere_m);
    for (std::size_t side = 0; side < 4; ++side) {
      for (int along = 0; along <= coarsest_; ++along) {
        const Deviation off = measure(strip(inside, side, along));
        if (along == inside) raise(errors.printed_m, inside, off.at_samples_m);
        if (along <= inside) raise(errors.mixed_m, inside, off.anywhere_m);
        if (is_last) raise(errors.mixed_m, coarsest_, off.anywhere_m);
        for (int level = std::max(inside, along); level <= coarsest_; ++level)
          raise(errors.any_inside_m, level, off.anywhere_m);
      }
    }
  }
  const Deviation whole = measure(whole_);
  raise(errors.printed_m, coarsest_, whole.at_samples_m);
  raise_mixed(coarsest_, whole.anywhere_m);
  return errors;
}

double BlockGeometry::drawn_error_m(const BlockLevels& levels,
                                    std::span<const double> heights_m) const {
  const bool is_whole =
      levels.inside == coarsest_ && std::all_of(levels.side.begin(), levels.side.end(),
                                                [&](int along) { return along == coarsest_; });
  if (is_whole) return deviation(whole_, heights_m).anywhere_m;
  const int inside = std::min<int>(levels.inside, coarsest_ - 1);
  double largest = deviation(interior_[static_cast<std::size_t>(inside)], heights_m).anywhere_m;
  for (std::size_t side = 0; side < 4; ++side) {
    const Piece& along = strip(inside, side, levels.side[side]);
    largest = std::max(largest, deviation(along, heights_m).anywhere_m);
  }
  return largest;
}

BlockGeometries::BlockGeometries(const BlockPieces& pieces, const PatchLayout& layout)
    : layout_(layout), cells_(pieces.block_cells()), whole_(pieces, even_places(cells_)) {
  cut_off_.resize(kBlockShapes * static_cast<std::size_t>(layout.levels));
  parallel_for(static_cast<std::int64_t>(cut_off_.size()), 1, [&](std::int64_t k) {
    const auto shape = static_cast<std::size_t>(k) % kBlockShapes;
    const int level = static_cast<int>(static_cast<std::size_t>(k) / kBlockShapes);
    if (shape == 0) return;
    if (const auto places = places_of_shape(layout, level, cells_, shape))
      cut_off_[static_cast<std::size_t>(k)].emplace(pieces, *places);
  });
}

const BlockGeometry* BlockGeometries::of(const PatchPlace& patch, int i, int j) const {
  const auto shape = shape_of(layout_, patch, cells_, i, j);
  if (!shape) return nullptr;
  if (*shape == 0) return &whole_;
  return &*cut_off_[kBlockShapes * static_cast<std::size_t>(patch.level) + *shape];
}

}  // namespace plumb::mesh::tessellation
