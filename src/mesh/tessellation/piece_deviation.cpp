#include "mesh/tessellation/piece_deviation.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace plumb::mesh::tessellation {
namespace {

// Of whole numbers, below > 0.
struct Quotient {
  int whole, rest;  // rest in [0, below)
};
Quotient divide(std::int64_t above, std::int64_t below) {
  std::int64_t whole = above / below, rest = above % below;
  if (rest < 0) {
    --whole;
    rest += below;
  }
  return {static_cast<int>(whole), static_cast<int>(rest)};
}

}  // namespace

PieceGeometry::PieceGeometry(const std::vector<BlockTriangle>& triangles, const BlockPlaces& places,
                             int truth_block)
    : side_(static_cast<int>(places.column.size())), truth_half_(truth_block / 2) {
  std::set<std::pair<BlockPoint, BlockPoint>> edges;
  for (const BlockTriangle& triangle : triangles) {
    add_plane(triangle, places);
    for (std::size_t k = 0; k < 3; ++k)
      edges.insert(std::minmax(triangle[k], triangle[(k + 1) % 3]));
  }
  for (const auto& [from, to] : edges) add_crossings(from, to, places);
}

PieceGeometry::Place PieceGeometry::place(const BlockPoint& point,
                                          const BlockPlaces& places) const {
  return {places.column[point.i] - places.column.front(), places.row[point.j] - places.row.front()};
}

void PieceGeometry::add_plane(const BlockTriangle& triangle, const BlockPlaces& places) {
  std::array<Place, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) corners[k] = place(triangle[k], places);
  const double x1 = corners[1].column - corners[0].column, y1 = corners[1].row - corners[0].row,
               x2 = corners[2].column - corners[0].column, y2 = corners[2].row - corners[0].row;
  const double area = x1 * y2 - x2 * y1;
  if (!(area > 0.0)) return;  // beyond the terrain
  Plane plane{{number(triangle[0]), number(triangle[1]), number(triangle[2])},
              corners[0],
              {y2 / area, -x2 / area},
              {-y1 / area, x1 / area},
              spans_.size(),
              0};
  add_spans(corners);
  plane.last_span = spans_.size();
  planes_.push_back(plane);
}

// A sample is within a triangle that runs counter-clockwise where it lies left of every edge, or on
// it.
void PieceGeometry::add_spans(const std::array<Place, 3>& corners) {
  const auto [low, high] = std::minmax({corners[0].row, corners[1].row, corners[2].row});
  const auto [west, east] = std::minmax({corners[0].column, corners[1].column, corners[2].column});
  for (int row = low; row <= high; ++row) {
    int begin = west, last = east;
    for (std::size_t k = 0; k < 3; ++k) {
      const Place &a = corners[k], &b = corners[(k + 1) % 3];
      const std::int64_t run = b.column - a.column, rise = b.row - a.row;
      // run (row - a.row) - rise (column - a.column) >= 0
      const std::int64_t most = run * (row - a.row) + rise * a.column;
      if (rise > 0) last = std::min(last, divide(most, rise).whole);
      if (rise < 0) begin = std::max(begin, -divide(most, -rise).whole);
      if (rise == 0 && run * (row - a.row) < 0) last = begin - 1;
    }
    if (begin <= last) spans_.push_back({row, begin, last + 1});
  }
}

void PieceGeometry::add_crossings(const BlockPoint& from, const BlockPoint& to,
                                  const BlockPlaces& places) {
  const Place a = place(from, places), b = place(to, places);
  const int run = b.column - a.column, rise = b.row - a.row;
  const std::uint32_t first = number(from), second = number(to);
  // Each family of lines of the truth's grid: value(point) is whole on them, and at samples.
  // at(k) is called for every line strictly between the ends.
  const auto lines = [&](int start, int change, const auto& at) {
    const int step = change < 0 ? -1 : 1;
    for (int k = step; k != change && change != 0; k += step) at(start + k, std::abs(k));
  };
  const auto add = [&](int steps, int of, Place from_a, Place to_b, int rest) {
    crossings_.push_back({first, second, from_a, to_b, static_cast<double>(steps) / of,
                          static_cast<double>(rest) / of});
  };
  lines(a.column, run, [&](int column, int steps) {
    const int of = std::abs(run);
    const Quotient row = divide(std::int64_t{a.row} * of + std::int64_t{rise} * steps, of);
    if (row.rest != 0) add(steps, of, {column, row.whole}, {column, row.whole + 1}, row.rest);
  });
  lines(a.row, rise, [&](int row, int steps) {
    const int of = std::abs(rise);
    const Quotient column = divide(std::int64_t{a.column} * of + std::int64_t{run} * steps, of);
    if (column.rest != 0) add(steps, of, {column.whole, row}, {column.whole + 1, row}, column.rest);
  });
  // Diagonals that rise: row - column is whole; that fall: row + column.
  lines(a.row - a.column, rise - run, [&](int difference, int steps) {
    const int of = std::abs(rise - run);
    const Quotient column = divide(std::int64_t{a.column} * of + std::int64_t{run} * steps, of);
    const int row = column.whole + difference;
    if (column.rest != 0 && rises(column.whole, row))
      add(steps, of, {column.whole, row}, {column.whole + 1, row + 1}, column.rest);
  });
  lines(a.row + a.column, rise + run, [&](int sum, int steps) {
    const int of = std::abs(rise + run);
    const Quotient column = divide(std::int64_t{a.column} * of + std::int64_t{run} * steps, of);
    const int row = sum - column.whole - 1;  // of the cell
    if (column.rest != 0 && !rises(column.whole, row))
      add(steps, of, {column.whole, row + 1}, {column.whole + 1, row}, column.rest);
  });
}

double PieceGeometry::sample_deviation(std::span<const double> drawn_m,
                                       const TruthBelow& truth) const {
  double largest = 0.0;
  for (const Plane& plane : planes_) {
    const double height = drawn_m[plane.corner[0]];
    const double rise_1 = drawn_m[plane.corner[1]] - height,
                 rise_2 = drawn_m[plane.corner[2]] - height;
    const double east = plane.slope_1[0] * rise_1 + plane.slope_2[0] * rise_2;
    const double north = plane.slope_1[1] * rise_1 + plane.slope_2[1] * rise_2;
    for (std::size_t k = plane.first_span; k < plane.last_span; ++k) {
      const Span& span = spans_[k];
      const float* row = truth.first + span.row * truth.stride;
      const double start = height + north * (span.row - plane.at.row) - east * plane.at.column;
      for (int column = span.begin; column < span.end; ++column) {
        const double off = std::abs(start + east * column - double{row[column]});
        largest = off > largest ? off : largest;
      }
    }
  }
  return largest;
}

double PieceGeometry::deviation(std::span<const double> drawn_m, const TruthBelow& truth) const {
  double largest = sample_deviation(drawn_m, truth);
  for (const Crossing& each : crossings_) {
    const double from = drawn_m[each.from],
                 a = truth.first[each.a.row * truth.stride + each.a.column];
    const double drawn = from + each.along * (drawn_m[each.to] - from);
    const double b = truth.first[each.b.row * truth.stride + each.b.column];
    const double off = std::abs(drawn - (a + each.across * (b - a)));
    largest = off > largest ? off : largest;
  }
  return largest;
}

}  // namespace plumb::mesh::tessellation
