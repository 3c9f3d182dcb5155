#include "reference/heightfield_nearest.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "reference/triangle_distance.h"

namespace plumb::reference {
namespace {

using terrain::Heightfield;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Query {
  glm::dvec3 point;
  double best_squared;  // a little more than the radius at first
  NearestPoint found;
};

double squared(double x) { return x * x; }

double outside(double at, double low, double high) {
  return at < low ? low - at : at > high ? at - high : 0.0;
}

// True if even the triangle's plane lies farther off than the best so far, by more than roundings.
bool plane_is_beyond(const Query& query, const glm::dvec3& a, const glm::dvec3& b,
                     const glm::dvec3& c) {
  constexpr double kRoundings = 1e-9;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double height = glm::dot(normal, query.point - a);
  return height * height > query.best_squared * (1.0 + kRoundings) * glm::dot(normal, normal);
}

// `across_squared`: of the point's distance from the cell in the plane.
void look_at_cell(Query& query, const Heightfield& field, terrain::Diagonal diagonal, int i, int j,
                  double across_squared) {
  const auto corner = [&](int a, int b) {
    return glm::dvec3((i + a) * field.dx_m, (j + b) * field.dy_m, field.heights_m(i + a, j + b));
  };
  const glm::dvec3 sw = corner(0, 0), se = corner(1, 0), nw = corner(0, 1), ne = corner(1, 1);
  // A triangle lies within the heights of its cell, whatever the void corners that it has not.
  const double up = outside(query.point.z, std::min({sw.z, se.z, nw.z, ne.z}),
                            std::max({sw.z, se.z, nw.z, ne.z}));
  if (across_squared + squared(up) >= query.best_squared) return;
  const bool north_east = rises_north_east(diagonal, i, j);
  const std::array<std::array<glm::dvec3, 3>, 2> halves{
      {{sw, se, north_east ? ne : nw}, {north_east ? sw : se, ne, nw}}};
  for (int half = 0; half < 2; ++half) {
    const auto& [a, b, c] = halves[static_cast<std::size_t>(half)];
    if (std::isnan(a.z + b.z + c.z)) continue;
    if (plane_is_beyond(query, a, b, c)) continue;
    const glm::dvec3 nearest = nearest_on_triangle(query.point, a, b, c),
                     apart = nearest - query.point;
    const double distance_squared = glm::dot(apart, apart);
    if (distance_squared >= query.best_squared) continue;
    query.best_squared = distance_squared;
    query.found = {nearest, std::sqrt(distance_squared),
                   terrain::triangle_index(field.cell_columns(), i, j, half)};
  }
}

struct Node {
  int level, i, j;
  double distance_squared;
};

Node make_node(const Query& query, const Heightfield& field, const HeightPyramid& pyramid,
               int level, int i, int j) {
  const int i1 = std::min((i + 1) << level, field.cell_columns()),
            j1 = std::min((j + 1) << level, field.cell_rows());
  double up = 0.0;
  if (level > 0) {
    const HeightRange range = pyramid.node(level, i, j);
    up = range.empty() ? kInfinity : outside(query.point.z, range.low, range.high);
  }
  return {level, i, j,
          squared(outside(query.point.x, (i << level) * field.dx_m, i1 * field.dx_m)) +
              squared(outside(query.point.y, (j << level) * field.dy_m, j1 * field.dy_m)) +
              squared(up)};
}

// Goes down the pyramid, the nearest of each node's children first.
void search_tree(Query& query, const Heightfield& field, terrain::Diagonal diagonal,
                 const HeightPyramid& pyramid) {
  std::array<Node, 4 * 32> stack;
  std::size_t count = 0;
  // Begins at the level whose nodes are as wide as the ball: four of them hold it.
  const double width_m = 2.0 * std::sqrt(query.best_squared),
               step_m = std::min(field.dx_m, field.dy_m);
  int level = 1;
  while (level < pyramid.top_level() && (1 << level) * step_m < width_m) ++level;
  const auto first = [&](double at, double step, int nodes) {
    return static_cast<int>(
        std::clamp(std::floor((at - 0.5 * width_m) / (step * (1 << level))), 0.0, nodes - 1.0));
  };
  const bool whole = level == pyramid.top_level();
  const int i0 = whole ? 0 : first(query.point.x, field.dx_m, pyramid.columns(level));
  const int j0 = whole ? 0 : first(query.point.y, field.dy_m, pyramid.rows(level));
  for (int j = j0; j < std::min(j0 + 2, pyramid.rows(level)); ++j) {
    for (int i = i0; i < std::min(i0 + 2, pyramid.columns(level)); ++i) {
      stack[count++] = make_node(query, field, pyramid, level, i, j);
    }
  }
  while (count > 0) {
    const Node node = stack[--count];
    if (node.distance_squared >= query.best_squared) continue;
    if (node.level == 0) {
      look_at_cell(query, field, diagonal, node.i, node.j, node.distance_squared);
      continue;
    }
    const int below = node.level - 1;
    const int columns = below > 0 ? pyramid.columns(below) : field.cell_columns();
    const int rows = below > 0 ? pyramid.rows(below) : field.cell_rows();
    std::array<Node, 4> children;
    std::size_t some = 0;
    for (int j = 2 * node.j; j < std::min(2 * node.j + 2, rows); ++j) {
      for (int i = 2 * node.i; i < std::min(2 * node.i + 2, columns); ++i) {
        const Node child = make_node(query, field, pyramid, below, i, j);
        if (child.distance_squared < query.best_squared) children[some++] = child;
      }
    }
    // The nearest on top of the stack.
    for (std::size_t k = 1; k < some; ++k) {
      for (std::size_t at = k;
           at > 0 && children[at - 1].distance_squared < children[at].distance_squared; --at) {
        std::swap(children[at - 1], children[at]);
      }
    }
    for (std::size_t k = 0; k < some; ++k) stack[count++] = children[k];
  }
}

struct Span {
  int first, last;
  int count() const { return last - first + 1; }
};

// The cells along one axis that come within `reach` of a place.
Span cells_within(double at, double reach, double step, int cells) {
  const auto cell = [&](double x) {
    return static_cast<int>(std::clamp(std::floor(x / step), 0.0, cells - 1.0));
  };
  return {cell(at - reach), cell(at + reach)};
}

// Looks at each cell that a small ball may touch, that of its centre first: it is mostly the
// nearest and makes the ball smaller.
void look_at_cells(Query& query, const Heightfield& field, terrain::Diagonal diagonal,
                   const Span& columns, const Span& rows) {
  const auto look = [&](int i, int j) {
    const double across_squared =
        squared(outside(query.point.x, i * field.dx_m, (i + 1) * field.dx_m)) +
        squared(outside(query.point.y, j * field.dy_m, (j + 1) * field.dy_m));
    if (across_squared < query.best_squared)
      look_at_cell(query, field, diagonal, i, j, across_squared);
  };
  const int own_i = cells_within(query.point.x, 0.0, field.dx_m, field.cell_columns()).first;
  const int own_j = cells_within(query.point.y, 0.0, field.dy_m, field.cell_rows()).first;
  look(own_i, own_j);
  for (int j = rows.first; j <= rows.last; ++j) {
    for (int i = columns.first; i <= columns.last; ++i) {
      if (i != own_i || j != own_j) look(i, j);
    }
  }
}

}  // namespace

NearestPoint nearest_on_heightfield(const Heightfield& field, terrain::Diagonal diagonal,
                                    const HeightPyramid& pyramid, const glm::dvec3& point_m,
                                    double max_radius_m) {
  // The radius itself still counts, and the roundings of a vertical distance do not lose the point
  // that gave it.
  Query query{point_m, squared(max_radius_m * (1.0 + 1e-9) + 1e-9), {}};
  if (pyramid.root().empty()) return query.found;
  const double reach_m = std::sqrt(query.best_squared) * (1.0 + 1e-9);
  const Span columns = cells_within(point_m.x, reach_m, field.dx_m, field.cell_columns()),
             rows = cells_within(point_m.y, reach_m, field.dy_m, field.cell_rows());
  constexpr int kFew = 3;
  if (columns.count() <= kFew && rows.count() <= kFew) {
    look_at_cells(query, field, diagonal, columns, rows);
  } else {
    search_tree(query, field, diagonal, pyramid);
  }
  return query.found;
}

}  // namespace plumb::reference
