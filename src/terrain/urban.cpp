#include "terrain/urban.h"

#include <algorithm>
#include <cmath>

#include "core/reproducible_math.h"
#include "terrain/gradient_noise.h"

namespace plumb::terrain {
namespace {

constexpr double kStorey_m = 3.2;
constexpr double kPitch = 0.70020753820970978;  // tan 35 degrees

struct Town {
  double height_m, relief_m, ground_m, block_m, street_m;
  double cosine, sine;  // of the angle that streets are turned by
  std::uint64_t seed;
};

/// Metres along a town's streets.
struct Point {
  double x, y;
};

struct Box2 {
  double west, south, width, depth;
  double inside(Point p) const {  // distance to the nearest side; < 0 outside
    return std::min(std::min(p.x - west, west + width - p.x),
                    std::min(p.y - south, south + depth - p.y));
  }
  Box2 shrunk(double west_by, double south_by, double east_by, double north_by) const {
    return {west + west_by, south + south_by, width - west_by - east_by,
            depth - south_by - north_by};
  }
  Point centre() const { return {west + width / 2.0, south + depth / 2.0}; }
};

/// Random numbers in [0, 1) that belong to one block.
struct Dice {
  std::int64_t column, row;
  std::uint64_t seed;
  double operator()(std::uint64_t which) const {
    return lattice_part(column, row, seed + 0x632be59bd9b4e019ULL * (which + 1));
  }
};

double ground_at(const Town& town, Point p) {
  const double hills = gradient_noise(p.x / 700.0 + 0.31, p.y / 700.0 + 0.57, town.seed);
  return town.height_m + town.ground_m * (0.5 + 0.5 * hills);
}

/// How built-up a quarter is, in [0, 1].
double bustle_at(const Town& town, Point p) {
  const double noise = gradient_noise(p.x / 500.0 + 0.4, p.y / 500.0 + 0.7, town.seed + 1);
  return std::clamp(0.4 + 0.9 * noise, 0.0, 1.0);
}

/// A roof `storeys` above the ground in the building's middle; never above the town's relief.
double level_roof(const Town& town, const Box2& building, double storeys) {
  const double rise = std::min(storeys * kStorey_m, town.relief_m - town.ground_m);
  return ground_at(town, building.centre()) + rise;
}

double pitched_roof(const Town& town, const Box2& building, double storeys, Point p) {
  const bool along_x = building.width > building.depth;
  const double half = (along_x ? building.depth : building.width) / 2.0;
  const Point c = building.centre();
  const double from_ridge = std::abs(along_x ? p.y - c.y : p.x - c.x);
  const double top = town.height_m + town.relief_m;
  return std::min(top, level_roof(town, building, storeys) + kPitch * (half - from_ridge));
}

/// Streets lie on both sides of the line between blocks k - 1 and k, which is moved a little.
double street_line(std::int64_t k, double pitch, std::uint64_t seed) {
  return (static_cast<double>(k) + 0.24 * lattice_part(k, 0, seed)) * pitch;
}

struct Span {
  std::int64_t number;
  double from, to;
};

/// The block that a coordinate lies in, from street line to street line.
Span block_span(double at, double pitch, std::uint64_t seed) {
  std::int64_t k = floor_to_integer(at / pitch);
  if (at < street_line(k, pitch, seed)) --k;
  return {k, street_line(k, pitch, seed), street_line(k + 1, pitch, seed)};
}

double storeys_of(double bustle, double chance) {
  return 1.0 + std::floor(1.5 + 9.0 * bustle * (0.3 + chance * chance));
}

/// Houses on lots, back to back in two rows.
double house_height(const Town& town, const Box2& block, const Dice& dice, double bustle, Point p,
                    double ground) {
  const int across = std::max(1, static_cast<int>(block.width / (14.0 + 8.0 * dice(1))));
  const int deep = block.depth > 30.0 ? 2 : 1;
  const double lot_width = block.width / across, lot_depth = block.depth / deep;
  const int i = std::clamp(static_cast<int>((p.x - block.west) / lot_width), 0, across - 1);
  const int j = std::clamp(static_cast<int>((p.y - block.south) / lot_depth), 0, deep - 1);
  const auto lot = static_cast<std::uint64_t>(16 + 8 * (i + 1000 * j));
  const Box2 ground_plan{block.west + i * lot_width, block.south + j * lot_depth, lot_width,
                         lot_depth};
  // Gaps between houses and a garden behind them close as the quarter fills up.
  const double gap = (1.0 - bustle) * (1.0 + 2.5 * dice(lot));
  const double front = (1.0 - bustle) * 4.0 * dice(lot + 1);
  const double garden = lot_depth * (0.12 + 0.3 * (1.0 - bustle) * dice(lot + 2));
  const Box2 house = j == 0 ? ground_plan.shrunk(gap, front, gap, garden)
                            : ground_plan.shrunk(gap, garden, gap, front);
  if (house.inside(p) < 0.0 || dice(lot + 3) < 0.06) return ground;
  const double storeys = storeys_of(bustle, dice(lot + 4));
  const bool is_pitched = storeys <= 4.0 && dice(lot + 5) < 0.8 - 0.6 * bustle;
  return is_pitched ? pitched_roof(town, house, storeys, p) : level_roof(town, house, storeys);
}

/// A closed row of buildings, 13 m deep, around a court.
double court_height(const Town& town, const Box2& block, const Dice& dice, double bustle, Point p,
                    double ground) {
  return block.inside(p) > 13.0 ? ground : level_roof(town, block, storeys_of(bustle, dice(2)));
}

double tower_height(const Town& town, const Box2& block, const Dice& dice, double bustle, Point p) {
  const double tallest = (town.relief_m - town.ground_m) / kStorey_m;
  const double side = std::min(block.width, block.depth);
  const Box2 tower = block.shrunk((block.width - side) / 2 + 0.25 * side, 0.25 * block.depth,
                                  (block.width - side) / 2 + 0.25 * side, 0.25 * block.depth);
  if (tower.inside(p) < 0.0) return level_roof(town, block, 2.0);
  const double share = (0.35 + 0.65 * bustle) * (0.5 + 0.5 * dice(3));
  // A quarter of the height stands on a smaller plan.
  const bool is_top = tower.inside(p) > 0.1 * side;
  return level_roof(town, block, std::max(4.0, tallest * share * (is_top ? 1.0 : 0.75)));
}

double height_at(const Town& town, Point p) {
  const double ground = ground_at(town, p);
  const Span x = block_span(p.x, 1.4 * town.block_m, town.seed + 2);
  const Span y = block_span(p.y, town.block_m, town.seed + 3);
  const Box2 lots{x.from, y.from, x.to - x.from, y.to - y.from};
  const double half = town.street_m / 2.0;
  const Box2 block = lots.shrunk(half, half, half, half);
  if (block.inside(p) < 0.0) return ground;
  const Dice dice{x.number, y.number, town.seed + 4};
  const double bustle = bustle_at(town, block.centre());
  const double kind = dice(0);
  if (kind < 0.07) return ground;  // a park
  if (kind < 0.07 + 0.35 * bustle * bustle) return tower_height(town, block, dice, bustle, p);
  if (kind < 0.07 + 0.55 * bustle) return court_height(town, block, dice, bustle, p, ground);
  return house_height(town, block, dice, bustle, p, ground);
}

}  // namespace

RowFiller urban(const GeneratorValues& values, const GridShape& shape) {
  Town town{};
  town.height_m = values.number("height");
  town.relief_m = values.number("relief", 0.0, 1e6);
  town.ground_m = values.number("ground", 0.0, 1e6);
  if (town.ground_m > town.relief_m) values.refuse("ground", "at most the relief");
  town.block_m = values.number("block", 1.0, 1e6);
  town.street_m = values.number("street", 0.0, 1e6);
  if (town.street_m > 0.7 * town.block_m) values.refuse("street", "at most 0.7 of the block");
  const double turn_rad = radians(values.number("turn_deg", -90.0, 90.0));
  town.cosine = reproducible_cos(turn_rad);
  town.sine = reproducible_sin(turn_rad);
  town.seed = values.seed() * 0x9e3779b97f4a7c15ULL;
  return [town, shape](int j, std::span<float> row) {
    const double y = j * shape.dy_m;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double x = static_cast<double>(i) * shape.dx_m;
      row[i] = static_cast<float>(
          height_at(town, {x * town.cosine + y * town.sine, y * town.cosine - x * town.sine}));
    }
  };
}

}  // namespace plumb::terrain
