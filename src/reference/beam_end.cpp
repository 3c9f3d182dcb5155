#include "reference/beam_end.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFewRoundings = 1e-14;  // relative; 45 units in the last place
constexpr double kLater = 1e-9;          // relative; far more than the roundings of a hit's t

// Where a beam is at one t, in units of cells.
struct Section {
  double west, east, south, north, low, high;
};

struct Span {
  double low = kInfinity, high = -kInfinity;
  void take(double height) {
    low = std::min(low, height);
    high = std::max(high, height);
  }
};

class Follower {
 public:
  Follower(const terrain::Heightfield& field, terrain::Diagonal diagonal,
           const HeightPyramid& pyramid, const Beam& beam)
      : field_(field),
        diagonal_(diagonal),
        pyramid_(pyramid),
        beam_(beam),
        limits_(walk_limits(field, pyramid, beam.origin_m)) {}

  // In a section's box over the terrain, with room for roundings.
  Section at(double t) const {
    const double slack = limits_.place_slack;
    const double west = t * beam_.low.x / field_.dx_m, east = t * beam_.high.x / field_.dx_m;
    const double south = t * beam_.low.y / field_.dy_m, north = t * beam_.high.y / field_.dy_m;
    const double u = beam_.origin_m.x / field_.dx_m, v = beam_.origin_m.y / field_.dy_m;
    const double up = kFewRoundings * t * std::max(std::abs(beam_.low.z), std::abs(beam_.high.z)) +
                      2.0 * limits_.height_slack;
    return {u + west - kFewRoundings * std::abs(west) - slack,
            u + east + kFewRoundings * std::abs(east) + slack,
            v + south - kFewRoundings * std::abs(south) - slack,
            v + north + kFewRoundings * std::abs(north) + slack,
            beam_.origin_m.z + t * beam_.low.z - up,
            beam_.origin_m.z + t * beam_.high.z + up};
  }
  bool contains(const Section& s) const {
    return s.west >= 0.0 && s.south >= 0.0 && s.east <= field_.cell_columns() &&
           s.north <= field_.cell_rows();
  }
  // Heights under a section that lies over the terrain.
  Span under(const Section& s) const {
    const double width = std::max(s.east - s.west, s.north - s.south);
    int level = 0;
    while (level < pyramid_.top_level() && static_cast<double>(std::int64_t{1} << level) < width)
      ++level;
    const double side = static_cast<double>(std::int64_t{1} << level);
    Span heights;
    for (int j = static_cast<int>(s.south / side); j <= static_cast<int>(s.north / side); ++j) {
      for (int i = static_cast<int>(s.west / side); i <= static_cast<int>(s.east / side); ++i) {
        const Span there = level == 0 ? cell(i, j, s) : node_at(level, i, j);
        heights.take(there.low);
        heights.take(there.high);
      }
    }
    return heights;
  }
  // t from one cell to the next, sideways or down.
  double step() const {
    const auto most = [](double a, double b) { return std::max(std::abs(a), std::abs(b)); };
    return 1.0 / std::max({most(beam_.low.x, beam_.high.x) / field_.dx_m,
                           most(beam_.low.y, beam_.high.y) / field_.dy_m,
                           most(beam_.low.z, beam_.high.z) / std::min(field_.dx_m, field_.dy_m)});
  }

 private:
  // The heights of both of the cell's triangles, followed on through the cell, under the section.
  // The far borders belong to the last cells.
  Span cell(int i, int j, const Section& s) const {
    i = std::min(i, field_.cell_columns() - 1);
    j = std::min(j, field_.cell_rows() - 1);
    const terrain::HeightGrid& z = field_.heights_m;
    const double sw = z(i, j), se = z(i + 1, j), nw = z(i, j + 1), ne = z(i + 1, j + 1);
    const bool rises = terrain::rises_north_east(diagonal_, i, j);
    Span span;
    for (const double u : {s.west, s.east}) {
      const double a = std::clamp(u - i, 0.0, 1.0);
      for (const double v : {s.south, s.north}) {
        const double b = std::clamp(v - j, 0.0, 1.0);
        span.take(rises ? sw + a * (se - sw) + b * (ne - se) : sw + a * (se - sw) + b * (nw - sw));
        span.take(rises ? sw + a * (ne - nw) + b * (nw - sw)
                        : ne - (1.0 - a) * (ne - nw) - (1.0 - b) * (ne - se));
      }
    }
    return span;
  }
  Span node_at(int level, int i, int j) const {
    const HeightRange range = pyramid_.node(level, std::min(i, pyramid_.columns(level) - 1),
                                            std::min(j, pyramid_.rows(level) - 1));
    return {range.low, range.high};
  }

  const terrain::Heightfield& field_;
  terrain::Diagonal diagonal_;
  const HeightPyramid& pyramid_;
  const Beam& beam_;
  WalkLimits limits_;
};

}  // namespace

double beam_end(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                const HeightPyramid& pyramid, const Beam& beam) {
  const double start = beam_start(field, pyramid, beam).t;
  if (!(start < kInfinity)) return kInfinity;
  const Follower follower(field, diagonal, pyramid, beam);
  const auto is_above = [&](double t) {
    const Section s = follower.at(t);
    return t >= beam.t_min && follower.contains(s) && follower.under(s).high < s.low;
  };
  if (!is_above(beam.t_min) && !is_above(0.5 * start) && !is_above(0.9 * start)) return kInfinity;
  // What is passed between two places is no error: the end found is a later one.
  constexpr int kPlaces = 24;
  double ahead = 0.5 * follower.step();
  for (int k = 0; k < kPlaces; ++k, ahead *= 1.4) {
    const double t = start + ahead;
    const Section s = follower.at(t);
    if (!(t * (1.0 + kLater) < beam.t_max) || !follower.contains(s)) break;
    if (s.high < follower.under(s).low) return t * (1.0 + kLater);
  }
  return kInfinity;
}

}  // namespace plumb::reference
