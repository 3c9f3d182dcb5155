#include "terrain/stacks/caves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "terrain/stacks/caves_density.h"

namespace plumb::terrain {
namespace {

constexpr double kRoomOverSoil = 0.08;  // parts of the relief
constexpr Material kRock = 1, kSandstone = 2, kLimestone = 3, kSoil = 4;

/// Turns ends into layers.
class Painter {
 public:
  Painter(const CavePlace& place, double low_m, double relief_m, std::vector<Layer>& layers)
      : place_(place), low_m_(low_m), relief_m_(relief_m), layers_(layers) {}

  /// The ground between two heights, its highest part soil.
  void add(double from, double to, double soil) const {
    add_rock(from, to - soil);
    put(to - soil, to, kSoil);
  }

 private:
  void add_rock(double from, double to) const {
    double h = from;
    if (h < place_.bedrock) h = put(h, std::min(to, place_.bedrock), kRock);
    const double turns = kCaveStrata * h + place_.dip;
    double turn = static_cast<double>(floor_to_integer(turns));
    // Each pair: soft, hard from kSoftPart, soft again from 1 - kSoftPart into the next pair.
    const double part = turns - turn;
    bool is_hard = part >= kSoftPart && part < 1.0 - kSoftPart;
    if (part >= 1.0 - kSoftPart) turn += 1.0;
    for (; h < to; is_hard = !is_hard) {
      const double end = is_hard ? turn + 1.0 - kSoftPart : turn + kSoftPart;
      if (is_hard) turn += 1.0;
      h = put(h, std::clamp((end - place_.dip) / kCaveStrata, h, to),
              is_hard ? kLimestone : kSandstone);
    }
  }
  double put(double from, double to, Material material) const {
    layers_.push_back({metres(from), metres(to), material});
    return to;
  }

  // Half of what remains of a pair beside its hard layer, where strata_wave() is below zero:
  // (1 - sqrt(1 - 4 / sqrt(32))) / 2.
  static constexpr double kSoftPart = 0.22940195;

  float metres(double h) const { return static_cast<float>(low_m_ + h * relief_m_); }

  const CavePlace& place_;
  double low_m_, relief_m_;
  std::vector<Layer>& layers_;
};

/// How much of the soil stays on ground of this slope, rise over run.
double soil_left(double slope) { return std::clamp(1.5 - 1.25 * slope, 0.0, 1.0); }

}  // namespace

Caves::Caves(const GeneratorValues& values, const GridShape& grid) {
  relief_m_ = values.number("relief", 1e-3, 1e7);
  feature_m_ = values.number("feature", 1e-3, 1e7);
  tunnels_ = values.number("caves", 0.0, 3.0);
  soil_m_ = values.number("soil", 0.0, 1e7);
  seed_ = values.seed() * 0x9e3779b97f4a7c15ULL;
  shape_.columns = grid.columns;
  shape_.rows = grid.rows;
  shape_.dx_m = grid.dx_m;
  shape_.dy_m = grid.dy_m;
  shape_.voxel_m = 0.5 * (grid.dx_m + grid.dy_m);
  shape_.low_m = static_cast<float>(values.number("height"));
  const double voxels = std::ceil(relief_m_ / shape_.voxel_m);
  if (voxels > 65536.0)
    values.refuse("relief", fmt::format("at most 65536 voxels of {} m", shape_.voxel_m));
  shape_.voxels = static_cast<int>(voxels);
  shape_.materials = {{"air", glm::dvec3(0.0)},
                      {"rock", glm::dvec3(0.21, 0.19, 0.18)},
                      {"sandstone", glm::dvec3(0.50, 0.27, 0.13)},
                      {"limestone", glm::dvec3(0.60, 0.54, 0.42)},
                      {"soil", glm::dvec3(0.17, 0.20, 0.07)}};
  if (!(shape_.low_m < shape_.highest_m()))
    values.refuse("height", "one at which floats tell voxels apart");
}

double Caves::soil_at(double x, double y, double ground) const {
  const auto rise_to = [&](double east_m, double north_m) {
    const double there = cave_ground_at(x + east_m / feature_m_, y + north_m / feature_m_, seed_);
    return (there - ground) * relief_m_ / (east_m + north_m);
  };
  const double east = rise_to(shape_.dx_m, 0.0), north = rise_to(0.0, shape_.dy_m);
  return soil_m_ / relief_m_ * soil_left(std::sqrt(east * east + north * north));
}

void Caves::fill_row(int j, const GeneratedVoids& voids, StackWriter& row) const {
  const double y = j * shape_.dy_m / feature_m_;
  CaveColumn column;
  std::vector<double> ends;
  std::vector<Layer> layers;
  for (int i = 0; i < shape_.columns; ++i) {
    if (voids.at(i, j)) {
      row.add_hole();
      continue;
    }
    const double x = i * shape_.dx_m / feature_m_;
    const CavePlace place = place_among_caves(x, y, tunnels_, seed_);
    column.stand_at(place, seed_);
    column.find_ends(0.25 * shape_.voxel_m / relief_m_, ends);
    const double soil = soil_at(x, y, place.ground);
    const Painter painter(place, shape_.low_m, relief_m_, layers);
    layers.clear();
    for (std::size_t k = 0; k < ends.size(); k += 2) {
      const double from = k == 0 ? 0.0 : ends[k - 1], to = ends[k];
      const double room = k + 1 < ends.size() ? ends[k + 1] - to : 1.0;
      painter.add(from, to, to - from > 2.0 * soil && room > kRoomOverSoil ? soil : 0.0);
    }
    row.add(layers);
  }
}

bool Caves::is_solid(int i, int j, double height_m) const {
  const double x = i * shape_.dx_m / feature_m_, y = j * shape_.dy_m / feature_m_;
  CaveColumn column;
  column.stand_at(place_among_caves(x, y, tunnels_, seed_), seed_);
  return column.is_solid((height_m - static_cast<double>(shape_.low_m)) / relief_m_);
}

}  // namespace plumb::terrain
