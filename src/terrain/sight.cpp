#include "terrain/sight.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"

namespace plumb::terrain {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFarStep = 0.01;  // of the distance
// Where in its cell a stand lies: on no edge and on neither diagonal, exact in binary.
constexpr double kInCellX = 0.375, kInCellY = 0.3125;

bool is_solid(const Heightfield& field, int i, int j) {
  return !field.is_void(i, j) && !field.is_void(i + 1, j) && !field.is_void(i, j + 1) &&
         !field.is_void(i + 1, j + 1);
}

Stand stand_in(const Heightfield& field, int i, int j) {
  Stand stand;
  stand.place_m = {(i + kInCellX) * field.dx_m, (j + kInCellY) * field.dy_m};
  stand.ground_m = ground_height_m(field, stand.place_m.x, stand.place_m.y);
  const float height = field.heights_m(i, j);
  stand.is_level = field.heights_m(i + 1, j) == height && field.heights_m(i, j + 1) == height &&
                   field.heights_m(i + 1, j + 1) == height;
  return stand;
}

struct Block {
  int i_begin, i_end, j_begin, j_end;  // cells
};

/// The solid cell of the block that is nearest to its middle, counted in cells.
std::optional<Stand> stand_of(const Heightfield& field, const Block& block) {
  const int middle_i = (block.i_begin + block.i_end - 1) / 2;
  const int middle_j = (block.j_begin + block.j_end - 1) / 2;
  if (is_solid(field, middle_i, middle_j)) return stand_in(field, middle_i, middle_j);
  std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
  int best_i = 0, best_j = 0;
  for (int j = block.j_begin; j < block.j_end; ++j) {
    for (int i = block.i_begin; i < block.i_end; ++i) {
      const std::int64_t across = i - middle_i, along = j - middle_j;
      const std::int64_t distance = across * across + along * along;
      if (distance < nearest && is_solid(field, i, j)) {
        nearest = distance;
        best_i = i;
        best_j = j;
      }
    }
  }
  if (nearest == std::numeric_limits<std::int64_t>::max()) return std::nullopt;
  return stand_in(field, best_i, best_j);
}

double step_m(const Heightfield& field, double distance_m) {
  return std::max(0.5 * std::min(field.dx_m, field.dy_m), kFarStep * distance_m);
}

/// Narrows [begin, end] to where start + t * speed lies in [low, high].
void clip(double start, double speed, double low, double high, double& begin, double& end) {
  if (speed == 0.0) {
    if (start < low || start > high) end = -kInfinity;
    return;
  }
  const double a = (low - start) / speed, b = (high - start) / speed;
  begin = std::max(begin, std::min(a, b));
  end = std::min(end, std::max(a, b));
}

}  // namespace

double ground_height_m(const Heightfield& field, double x_m, double y_m) {
  const double x = x_m / field.dx_m, y = y_m / field.dy_m;
  if (!(x >= 0.0 && y >= 0.0 && x <= field.cell_columns() && y <= field.cell_rows())) return kNaN;
  if (field.cell_columns() < 1 || field.cell_rows() < 1) return kNaN;
  const int i = std::min(static_cast<int>(x), field.cell_columns() - 1);
  const int j = std::min(static_cast<int>(y), field.cell_rows() - 1);
  const double u = x - i, v = y - j;
  const double south_west = field.heights_m(i, j), south_east = field.heights_m(i + 1, j);
  const double north_west = field.heights_m(i, j + 1), north_east = field.heights_m(i + 1, j + 1);
  const double rising =
      u >= v ? south_west + u * (south_east - south_west) + v * (north_east - south_east)
             : south_west + v * (north_west - south_west) + u * (north_east - north_west);
  const double falling =
      u + v <= 1.0 ? south_west + u * (south_east - south_west) + v * (north_west - south_west)
                   : north_east + (1.0 - u) * (north_west - north_east) +
                         (1.0 - v) * (south_east - north_east);
  return std::isnan(rising + falling) ? kNaN : std::max(rising, falling);
}

std::vector<Stand> stands_of(const Heightfield& field, int per_side) {
  const int across = std::min(per_side, field.cell_columns());
  const int along = std::min(per_side, field.cell_rows());
  if (across < 1 || along < 1) return {};
  const auto part = [](int cells, int k, int parts) {
    return static_cast<int>(std::int64_t{cells} * k / parts);
  };
  std::vector<std::optional<Stand>> found(static_cast<std::size_t>(across) *
                                          static_cast<std::size_t>(along));
  parallel_for(static_cast<std::int64_t>(found.size()), 1, [&](std::int64_t k) {
    const int a = static_cast<int>(k) % across, b = static_cast<int>(k) / across;
    found[static_cast<std::size_t>(k)] = stand_of(
        field, {part(field.cell_columns(), a, across), part(field.cell_columns(), a + 1, across),
                part(field.cell_rows(), b, along), part(field.cell_rows(), b + 1, along)});
  });
  std::vector<Stand> stands;
  for (const auto& stand : found) {
    if (stand) stands.push_back(*stand);
  }
  return stands;
}

SightLine look_along(const Heightfield& field, const glm::dvec3& eye_m,
                     const glm::dvec2& direction) {
  SightLine line;
  line.skyline = -kInfinity;
  double lowest = kInfinity, highest = -kInfinity;
  bool was_seen = false;
  double begin = 0.0, end = kInfinity;
  clip(eye_m.x, direction.x, 0.0, field.cell_columns() * field.dx_m, begin, end);
  clip(eye_m.y, direction.y, 0.0, field.cell_rows() * field.dy_m, begin, end);
  for (double distance = begin + step_m(field, 0.0); distance <= end;
       distance += step_m(field, distance)) {
    const double ground =
        ground_height_m(field, eye_m.x + distance * direction.x, eye_m.y + distance * direction.y);
    const double slope = (ground - eye_m.z) / distance;
    const bool is_seen = slope >= line.skyline;  // false for NaN
    line.layers += is_seen && !was_seen ? 1 : 0;
    was_seen = is_seen;
    if (is_seen) {
      line.skyline = slope;
      line.reach_m = distance;
      lowest = std::min(lowest, ground);
      highest = std::max(highest, ground);
    }
  }
  if (lowest <= highest) line.relief_m = highest - lowest;
  return line;
}

std::optional<double> first_ground(const Heightfield& field, const Box& box,
                                   const glm::dvec3& eye_m, const glm::dvec3& direction) {
  if (box.empty()) return std::nullopt;
  double begin = 0.0, end = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    clip(eye_m[axis], direction[axis], box.low[axis], box.high[axis], begin, end);
  }
  const double length = glm::length(direction);
  double t = begin;
  while (t <= end) {
    const double ground =
        ground_height_m(field, eye_m.x + t * direction.x, eye_m.y + t * direction.y);
    if (eye_m.z + t * direction.z <= ground) return t;  // false for NaN
    if (t == end) break;
    t = std::min(end, t + step_m(field, (t - begin) * length) / length);
  }
  return std::nullopt;
}

}  // namespace plumb::terrain
