#include "mesh/restricted_quadtree/triangle_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/memory.h"
#include "core/parallel.h"

namespace plumb::mesh::restricted_quadtree {
namespace {

using terrain::Heightfield;

// Triangles with this many rows or more are measured by several tasks.
constexpr int kLargeRows = 256;

float rounded_up(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest >= value ? nearest
                          : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

// A triangle's plane: height at base vertex m plus slopes, per sample, exact where the heights'
// digits allow it.
struct PlaneOver {
  double at_m, across, up;
};

PlaneOver plane_over(const Grid<float>& heights_m, const BinTriangle& t) {
  const Corner m = base_vertex(t);
  const double a = heights_m(t.a.i, t.a.j), b = heights_m(t.b.i, t.b.j),
               c = heights_m(t.c.i, t.c.j);
  const BaseShape shape = base_shape(m);
  const double at_m = 0.5 * (a + b), h = shape.half;
  const double along =
      0.5 * (b - a) /
      h;  // a sample's step from a towards b, along each axis that the hypotenuse uses
  const double to_apex = (c - at_m) / h;  // and from m towards c
  if (shape.is_centre) {
    // across * x + up * y is known for one step along either diagonal, (sx, sy) and (cx, cy), which
    // are orthogonal: sx * across + sy * up = along, cx * across + cy * up = to_apex.
    const double sx = t.b.i > t.a.i ? 1 : -1, sy = t.b.j > t.a.j ? 1 : -1;
    const double cx = t.c.i > m.i ? 1 : -1, cy = t.c.j > m.j ? 1 : -1;
    return {at_m, 0.5 * (sx * along + cx * to_apex), 0.5 * (sy * along + cy * to_apex)};
  }
  if (shape.along_row)
    return {at_m, t.b.i > t.a.i ? along : -along, t.c.j > m.j ? to_apex : -to_apex};
  return {at_m, t.c.i > m.i ? to_apex : -to_apex, t.b.j > t.a.j ? along : -along};
}

// The samples of row j that the triangle covers, edges included: columns [first, last].
struct Span {
  int first, last;
};

Span span_of_row(const BinTriangle& t, const BaseShape& shape, Corner m, int j) {
  const int h = shape.half;
  if (!shape.is_centre) {
    if (shape.along_row) {
      const int inset = std::abs(j - m.j);
      return {m.i - h + inset, m.i + h - inset};
    }
    const int reach = h - std::abs(j - m.j);
    return t.c.i > m.i ? Span{m.i, m.i + reach} : Span{m.i - reach, m.i};
  }
  const int on_diagonal = shape.rises ? m.i + (j - m.j) : m.i - (j - m.j);
  return t.c.i > m.i ? Span{on_diagonal, m.i + h} : Span{m.i - h, on_diagonal};
}

// Largest |plane - height| over columns [first, last] of a row. Four running maxima, which a
// compiler keeps in lanes.
double largest_in_row(const float* heights, int first, int last, double plane_at_first,
                      double across) {
  std::array<double, 4> largest{0.0, 0.0, 0.0, 0.0};
  const int count = last - first + 1;
  int k = 0;
  for (; k + 4 <= count; k += 4) {
    for (int lane = 0; lane < 4; ++lane) {
      const double distance = std::abs((plane_at_first + across * (k + lane)) -
                                       static_cast<double>(heights[first + k + lane]));
      auto& most = largest[static_cast<std::size_t>(lane)];
      most = distance > most ? distance : most;
    }
  }
  double most = std::max(std::max(largest[0], largest[1]), std::max(largest[2], largest[3]));
  for (; k < count; ++k) {
    most = std::max(
        most, std::abs((plane_at_first + across * k) - static_cast<double>(heights[first + k])));
  }
  return most;
}

double largest_distance(const Grid<float>& heights_m, const BinTriangle& t) {
  const Corner m = base_vertex(t);
  const BaseShape shape = base_shape(m);
  const PlaneOver plane = plane_over(heights_m, t);
  const int j0 = std::min({t.a.j, t.b.j, t.c.j}), j1 = std::max({t.a.j, t.b.j, t.c.j});
  const auto rows = [&](std::int64_t begin, std::int64_t end, double most) {
    for (std::int64_t row = begin; row < end; ++row) {
      const int j = j0 + static_cast<int>(row);
      const Span span = span_of_row(t, shape, m, j);
      const double at_first =
          plane.at_m + (plane.up * (j - m.j) + plane.across * (span.first - m.i));
      most = std::max(most, largest_in_row(heights_m.row(j).data(), span.first, span.last, at_first,
                                           plane.across));
    }
    return most;
  };
  const int count = j1 - j0 + 1;
  if (count < kLargeRows) return rows(0, count, 0.0);
  return parallel_ordered_reduce(count, 64, 0.0, rows,
                                 [](double a, double b) { return std::max(a, b); });
}

}  // namespace

const float TriangleErrors::kBroken = std::numeric_limits<float>::infinity();

TriangleErrors::TriangleErrors(const Heightfield& field) : field_(field) {
  while (root_side_ < std::max(field.cell_columns(), field.cell_rows())) root_side_ *= 2;
  // Codes of heights are looked up so often that it pays to make floats of them for the while.
  const bool is_coded = field.heights_m.is_coded();
  require_memory(
      static_cast<std::int64_t>(field.heights_m.size() * (is_coded ? 3 : 2) * sizeof(float)),
      "the errors of a restricted quadtree");
  const terrain::FloatHeights floats(field.heights_m);
  const Grid<float>& heights_m = *floats;
  errors_.assign(2 * field.heights_m.size(), kEmpty);
  for (int half = 1; half <= std::max(1, root_side_ / 2); half *= 2) {
    fill_level(heights_m, half, false);
    fill_level(heights_m, half, true);
  }
}

void TriangleErrors::fill_level(const Grid<float>& heights_m, int half, bool centres) {
  const int row_step = centres ? 2 * half : half;
  const int first_row = centres ? half : 0;
  const int rows = field_.rows() > first_row ? (field_.rows() - 1 - first_row) / row_step + 1 : 0;
  parallel_for(rows, std::max(1, 64 / half), [&](std::int64_t row) {
    const int j = first_row + static_cast<int>(row) * row_step;
    // Centres: odd multiples of `half` both ways. Sides: one coordinate an odd multiple, the other
    // an even one.
    const int first = centres || (j / half) % 2 == 0 ? half : 0;
    for (int i = first; i < field_.columns(); i += 2 * half) {
      for (int side = 0; side < 2; ++side) {
        errors_[2 * field_.heights_m.index(i, j) + static_cast<std::size_t>(side)] =
            compute(heights_m, {i, j}, side);
      }
    }
  });
}

float TriangleErrors::compute(const Grid<float>& heights_m, Corner v, int side) const {
  const BinTriangle t = triangle_of_base(v, side);
  const auto [first, second] = children(t);
  const float one = state_of_child(first), other = state_of_child(second);
  if (one == kEmpty && other == kEmpty) return kEmpty;
  if (one < 0.0f || other < 0.0f || one == kBroken || other == kBroken) return kBroken;
  return rounded_up(largest_distance(heights_m, t));
}

// 0 or more for complete children, kEmpty and kBroken for the others.
float TriangleErrors::state_of_child(const BinTriangle& child) const {
  if (is_finest(child)) return finest_exists(child) ? 0.0f : kEmpty;
  return error(child);
}

bool TriangleErrors::finest_exists(const BinTriangle& t) const {
  for (const Corner corner : {t.a, t.b, t.c}) {
    if (!field_.heights_m.contains(corner.i, corner.j) || field_.is_void(corner.i, corner.j))
      return false;
  }
  return true;
}

float TriangleErrors::error(const BinTriangle& t) const {
  const Corner v = base_vertex(t);
  if (field_.heights_m.contains(v.i, v.j)) return stored(v, side_of_base(t));
  // Its middle lies beyond the border: part of it is missing. Whether all of it is, its children
  // know.
  const auto [least_i, most_i] = std::minmax({t.a.i, t.b.i, t.c.i});
  const auto [least_j, most_j] = std::minmax({t.a.j, t.b.j, t.c.j});
  if (least_i >= field_.cell_columns() || least_j >= field_.cell_rows() || most_i <= 0 ||
      most_j <= 0)
    return kEmpty;
  const auto [first, second] = children(t);
  return state_of_child(first) == kEmpty && state_of_child(second) == kEmpty ? kEmpty : kBroken;
}

}  // namespace plumb::mesh::restricted_quadtree
