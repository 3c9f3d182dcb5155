// A triangle, cut along the edges of a heightfield's full-detail triangles.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "mesh/stacks/height_surface.h"

namespace plumb::mesh::stacks {

struct PieceCorner {
  glm::dvec3 place{0.0};
  std::uint32_t name = 0;  // of whoever cuts
};

/// A convex polygon. Each of the five lines that bound a piece adds a corner at most.
class Piece {
 public:
  void add(const PieceCorner& corner) { corners_[count_++] = corner; }
  std::size_t size() const { return count_; }
  const PieceCorner& operator[](std::size_t k) const { return corners_[k]; }
  const PieceCorner* begin() const { return corners_.data(); }
  const PieceCorner* end() const { return corners_.data() + count_; }

 private:
  std::array<PieceCorner, 16> corners_;
  std::size_t count_ = 0;
};

/// What cuts a triangle: a line of samples across an axis, or a cell's diagonal.
struct CutLine {
  int axis = -1;  // 0 or 1; -1: a diagonal
  double at_m = 0.0;
};

/// Where the edge from a to b meets a line.
inline glm::dvec3 crossing_m(const PieceCorner& a, double at_a, const PieceCorner& b, double at_b,
                             const CutLine& line) {
  glm::dvec3 place = a.place + at_a / (at_a - at_b) * (b.place - a.place);
  if (line.axis >= 0) place[line.axis] = line.at_m;
  return place;
}

namespace height_pieces {

// Of a cell's side, where rounding alone may tell two points of one line apart.
constexpr double kOnDiagonal = 1e-9;

inline std::array<double, 2> range(const Piece& piece, int axis) {
  double low = piece[0].place[axis], high = low;
  for (const PieceCorner& corner : piece) {
    low = std::min(low, corner.place[axis]);
    high = std::max(high, corner.place[axis]);
  }
  return {low, high};
}

// Halves by the sign of side(place). What lies on the line belongs to both, but to the first alone
// where all of it does.
template <class Side, class Cross>
std::array<Piece, 2> parted(const Piece& piece, const CutLine& line, const Side& side,
                            const Cross& cross) {
  std::array<double, 16> at{};
  bool below = false, above = false;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    at[k] = side(piece[k].place);
    below = below || at[k] < 0.0;
    above = above || at[k] > 0.0;
  }
  if (!above) return {piece, {}};
  if (!below) return {Piece{}, piece};
  std::array<Piece, 2> parts;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const std::size_t next = k + 1 < piece.size() ? k + 1 : 0;
    if (at[k] <= 0.0) parts[0].add(piece[k]);
    if (at[k] >= 0.0) parts[1].add(piece[k]);
    if ((at[k] < 0.0 && at[next] > 0.0) || (at[k] > 0.0 && at[next] < 0.0)) {
      const PieceCorner crossing = cross(piece[k], at[k], piece[next], at[next], line);
      parts[0].add(crossing);
      parts[1].add(crossing);
    }
  }
  return parts;
}

// Along lines across an axis, cells apart: visit(cell, piece) in their order.
template <class Cross, class Visit>
void strips(Piece rest, int axis, double step_m, int cells, const Cross& cross,
            const Visit& visit) {
  const auto [low, high] = range(rest, axis);
  const auto cell_of = [&](double at_m) {
    return static_cast<int>(std::clamp(std::floor(at_m / step_m), 0.0, cells - 1.0));
  };
  const int last = cell_of(high);
  for (int cell = cell_of(low); cell < last && rest.size() > 0; ++cell) {
    const double line_m = (cell + 1) * step_m;
    auto parts = parted(
        rest, {axis, line_m}, [&](const glm::dvec3& place) { return place[axis] - line_m; }, cross);
    if (parts[0].size() > 0) visit(cell, parts[0]);
    rest = parts[1];
  }
  if (rest.size() > 0) visit(last, rest);
}

}  // namespace height_pieces

/// Calls visit(CellHalf, Piece) for the pieces of a triangle, one for each full-detail triangle
/// that it meets in plan, whether that exists or not. What lies beyond the heights belongs to the
/// outermost cells.
///
/// cross(a, at_a, b, at_b, line)  makes the corner between two, at_a and at_b on either side of 0.
///                                An edge is cut by the same lines in the same order whatever
///                                triangle it belongs to
template <class Cross, class Visit>
void for_each_height_piece(const HeightSurface& heights, const Piece& triangle, const Cross& cross,
                           const Visit& visit) {
  using namespace height_pieces;
  if (heights.cell_columns() < 1 || heights.cell_rows() < 1) return;
  const auto in_cell = [&](int i, int j, const Piece& piece) {
    const bool rises = heights.rises(i, j);
    const double x_m = i * heights.dx_m(), y_m = j * heights.dy_m();
    const auto parts = parted(
        piece, {},
        [&](const glm::dvec3& place) {
          const double u = (place.x - x_m) / heights.dx_m(), v = (place.y - y_m) / heights.dy_m();
          const double side = rises ? v - u : u + v - 1.0;
          return std::abs(side) < kOnDiagonal ? 0.0 : side;
        },
        cross);
    for (int half = 0; half < 2; ++half) {
      const Piece& part = parts[static_cast<std::size_t>(half)];
      if (part.size() > 2) visit(CellHalf{i, j, half}, part);
    }
  };
  strips(triangle, 0, heights.dx_m(), heights.cell_columns(), cross,
         [&](int i, const Piece& strip) {
           strips(strip, 1, heights.dy_m(), heights.cell_rows(), cross,
                  [&](int j, const Piece& piece) { in_cell(i, j, piece); });
         });
}

}  // namespace plumb::mesh::stacks
