// The smallest conforming mesh of bisected right triangles, found the slow way: by its definition.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "terrain/heightfield.h"

namespace plumb::test_support {

/// Splits a triangle only where its own error is over the tolerance or a neighbour demands it.
/// Knows nothing of levels, flags or dependencies: a triangle's neighbour across its longest side
/// is looked for among all others.
class SlowRefinement {
 public:
  using Point = std::array<int, 2>;
  using Corners = std::array<Point, 3>;  // the right angle last

  SlowRefinement(const terrain::Heightfield& field,
                 const std::function<bool(const Corners&, double)>& must_split)
      : field_(field), must_split_(must_split) {
    int side = 1;
    while (side < std::max(field.columns(), field.rows()) - 1) side *= 2;
    leaves_ = {{{{0, 0}, {side, side}, {0, side}}}, {{{side, side}, {0, 0}, {side, 0}}}};
    for (bool changed = true; changed;) {
      changed = false;
      for (const Corners& t : std::vector<Corners>(leaves_.begin(), leaves_.end())) {
        if (leaves_.count(t) == 0 || !wants_split(t)) continue;
        split(t);
        changed = true;
      }
    }
  }

  /// Leaves that are drawn: those whose samples all exist.
  std::set<std::set<Point>> drawn() const {
    std::set<std::set<Point>> result;
    for (const Corners& t : leaves_) {
      if (status(t) == Status::Complete) result.insert({t[0], t[1], t[2]});
    }
    return result;
  }

 private:
  enum class Status { Complete, Broken, Empty };

  static int cross(Point a, Point b, Point p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
  }
  static bool holds(const Corners& t, Point p) {
    return cross(t[0], t[1], p) >= 0 && cross(t[1], t[2], p) >= 0 && cross(t[2], t[0], p) >= 0;
  }
  static bool is_half_cell(const Corners& t) { return std::abs(cross(t[0], t[1], t[2])) == 1; }
  bool exists(Point p) const {
    return field_.heights_m.contains(p[0], p[1]) && !field_.is_void(p[0], p[1]);
  }

  // Looks at every half cell under the triangle.
  Status status(const Corners& t) const {
    int there = 0, missing = 0;
    const auto [i0, i1] = std::minmax({t[0][0], t[1][0], t[2][0]});
    const auto [j0, j1] = std::minmax({t[0][1], t[1][1], t[2][1]});
    for (int j = j0; j < j1; ++j) {
      for (int i = i0; i < i1; ++i) {
        const Point sw{i, j}, se{i + 1, j}, nw{i, j + 1}, ne{i + 1, j + 1};
        const bool rises = ((i + j) & 1) == 0;
        const std::array<Corners, 2> halves =
            rises ? std::array<Corners, 2>{{{sw, se, ne}, {sw, ne, nw}}}
                  : std::array<Corners, 2>{{{sw, se, nw}, {se, ne, nw}}};
        for (const Corners& half : halves) {
          if (!holds(t, half[0]) || !holds(t, half[1]) || !holds(t, half[2])) continue;
          (exists(half[0]) && exists(half[1]) && exists(half[2]) ? there : missing) += 1;
        }
      }
    }
    return there == 0 ? Status::Empty : missing == 0 ? Status::Complete : Status::Broken;
  }

  double error(const Corners& t) const {
    const auto height = [&](Point p) { return static_cast<double>(field_.heights_m(p[0], p[1])); };
    const double area = cross(t[0], t[1], t[2]);
    double largest = 0.0;
    for (int j = 0; j < field_.rows(); ++j) {
      for (int i = 0; i < field_.columns(); ++i) {
        const Point p{i, j};
        if (!holds(t, p)) continue;
        const double z =
            (cross(t[1], t[2], p) * height(t[0]) + cross(t[2], t[0], p) * height(t[1]) +
             cross(t[0], t[1], p) * height(t[2])) /
            area;
        largest = std::max(largest, std::abs(z - height(p)));
      }
    }
    return largest;
  }

  bool wants_split(const Corners& t) const {
    if (is_half_cell(t)) return false;
    const Status s = status(t);
    return s == Status::Broken || (s == Status::Complete && must_split_(t, error(t)));
  }

  // Splits; whoever holds the longest side's middle on its border is split until it shares that
  // side, and then with it.
  void split(const Corners& t) {
    const Point m{(t[0][0] + t[1][0]) / 2, (t[0][1] + t[1][1]) / 2};
    for (bool again = true; again;) {
      again = false;
      for (const Corners& other : std::vector<Corners>(leaves_.begin(), leaves_.end())) {
        if (other == t || !holds(other, m) || other[0] == m || other[1] == m || other[2] == m)
          continue;
        if (other[0] == t[1] && other[1] == t[0]) continue;  // its mate
        if (leaves_.count(other) == 0) continue;
        split(other);
        again = true;
        break;
      }
    }
    for (const Corners& half : {t, mate_of(t)}) {
      if (leaves_.erase(half) == 0) continue;
      leaves_.insert({half[2], half[0], m});
      leaves_.insert({half[1], half[2], m});
    }
  }
  static Corners mate_of(const Corners& t) {
    return {t[1], t[0], {t[0][0] + t[1][0] - t[2][0], t[0][1] + t[1][1] - t[2][1]}};
  }

  const terrain::Heightfield& field_;
  std::function<bool(const Corners&, double)> must_split_;
  std::set<Corners> leaves_;
};

}  // namespace plumb::test_support
