#include "terrain/dunes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/reproducible_math.h"
#include "terrain/gradient_noise.h"

namespace plumb::terrain {
namespace {

constexpr double kWindward = 0.17632698070846498;  // tan 10 degrees, on average
constexpr double kRepose = 0.62486935190932752;    // tan 32 degrees
constexpr double kKnots = 32.0;                    // of a crest, per wavelength
// A crest's place is bend * (kSway * noise + kAhead * (1 - its height)) away from a whole number.
constexpr double kSway = 0.6, kAhead = 0.5;

// Lengths and heights below are in wavelengths.
struct Dunes {
  double height_m, wavelength_m;
  double tallest, bend;
  double downwind_x, downwind_y;  // unit vector
  std::uint64_t seed;
};

/// A point of a crest: how far downwind, and how high.
struct Knot {
  double downwind = 0.0, height = 0.0;
};

Knot knot_at(const Dunes& d, std::int64_t crest, std::int64_t index) {
  const double across = static_cast<double>(index) / kKnots, row = static_cast<double>(crest);
  // Neighbouring crests are alike: less than half a step of noise lies between them.
  const double level =
      std::clamp(0.66 + 0.9 * gradient_noise(across / 2.2, 0.43 * row + 0.2, d.seed), 0.0, 1.0);
  const double tall = level * level * (3.0 - 2.0 * level);  // without a kink at either end
  const double sway = gradient_noise(across / 2.6, 0.37 * row + 0.6, d.seed ^ 0x5bd1e995u);
  return {row + d.bend * (kSway * sway + kAhead * (1.0 - tall)), d.tallest * tall};
}

/// Remembers the knots near the samples of one row.
class Crests {
 public:
  explicit Crests(const Dunes& dunes) : dunes_(dunes), known_(kSlots) {}

  const Knot& knot(std::int64_t crest, std::int64_t index) {
    const auto slot = (static_cast<std::uint64_t>(index) + 97u * static_cast<std::uint64_t>(crest));
    Slot& known = known_[slot % kSlots];
    if (!known.is_full || known.crest != crest || known.index != index) {
      known = {true, crest, index, knot_at(dunes_, crest, index)};
    }
    return known.knot;
  }

 private:
  static constexpr std::size_t kSlots = 1024;
  struct Slot {
    bool is_full = false;
    std::int64_t crest = 0, index = 0;
    Knot knot;
  };
  const Dunes& dunes_;
  std::vector<Slot> known_;
};

/// Height at a point (downwind, across) of the cones whose tips run from knot a at (a.downwind, 0)
/// to knot b one step across. With the slope m of the tips' line and the point's place along and
/// beside it, the highest cone's tip lies m * beside / sqrt(kRepose^2 - m^2) past the foot of the
/// perpendicular.
double cones_of_segment(const Knot& a, const Knot& b, double downwind, double across) {
  constexpr double kStep = 1.0 / kKnots;
  const double run = b.downwind - a.downwind;
  const double length = std::sqrt(run * run + kStep * kStep);
  const double along = ((downwind - a.downwind) * run + across * kStep) / length;
  const double beside = std::abs((downwind - a.downwind) * kStep - across * run) / length;
  const double slope = (b.height - a.height) / length;
  const double rest = kRepose * kRepose - slope * slope;
  // A line steeper than the cones has its highest at one end.
  const double past = rest > 0.0 ? slope * beside / std::sqrt(rest) : (slope > 0.0 ? 1e9 : -1e9);
  const double tip = std::clamp(along + past, 0.0, length);
  const double away = tip - along;
  return a.height + slope * tip - kRepose * std::sqrt(away * away + beside * beside);
}

double slip_face(const Dunes& d, Crests& crests, std::int64_t crest, double downwind,
                 double across) {
  const double reach = d.tallest / kRepose;
  const std::int64_t first = floor_to_integer((across - reach) * kKnots);
  const std::int64_t last = floor_to_integer((across + reach) * kKnots);
  double highest = 0.0;
  for (std::int64_t n = first; n <= last; ++n) {
    const Knot a = crests.knot(crest, n), b = crests.knot(crest, n + 1);
    highest = std::max(highest,
                       cones_of_segment(a, b, downwind, across - static_cast<double>(n) / kKnots));
  }
  return highest;
}

/// An S from `height` at the crest down to level ground, as wide as a slope of kWindward would be.
double windward_side(double height, double upwind) {
  if (height <= 0.0) return 0.0;
  const double x = std::min(1.0, upwind * kWindward / height);
  return height * (1.0 - x) * (1.0 - x) * (1.0 + 2.0 * x);
}

double sand_at(const Dunes& d, Crests& crests, double downwind, double across) {
  const std::int64_t n = floor_to_integer(across * kKnots);
  const double part = across * kKnots - static_cast<double>(n);
  const auto first = floor_to_integer(downwind - d.tallest / kRepose - (kSway + kAhead) * d.bend);
  const auto last = floor_to_integer(downwind + d.tallest / kWindward + kSway * d.bend);
  double highest = 0.0;
  for (std::int64_t crest = first; crest <= last; ++crest) {
    const Knot a = crests.knot(crest, n), b = crests.knot(crest, n + 1);
    const double brink = a.downwind + part * (b.downwind - a.downwind);
    const double height = a.height + part * (b.height - a.height);
    highest = std::max(highest, downwind < brink ? windward_side(height, brink - downwind)
                                                 : slip_face(d, crests, crest, downwind, across));
  }
  return highest;
}

}  // namespace

RowFiller dunes(const GeneratorValues& values, const GridShape& shape) {
  Dunes d{};
  d.height_m = values.number("height");
  d.wavelength_m = values.number("wavelength", 1.0, 1e6);
  const double relief_m = values.number("relief", 0.0, 1e6);
  if (relief_m > d.wavelength_m / 7.0) {
    values.refuse("relief", "at most a seventh of the wavelength, so that dunes have room to rise");
  }
  d.tallest = relief_m / d.wavelength_m;
  d.bend = values.number("bend", 0.0, 1.0);
  const double from_rad = radians(values.number("wind_deg", 0.0, 360.0));
  d.downwind_x = -reproducible_sin(from_rad);
  d.downwind_y = -reproducible_cos(from_rad);
  d.seed = values.seed() * 0x9e3779b97f4a7c15ULL;
  return [d, shape](int j, std::span<float> row) {
    Crests crests(d);
    const double y = j * shape.dy_m / d.wavelength_m;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double x = static_cast<double>(i) * shape.dx_m / d.wavelength_m;
      const double sand = sand_at(d, crests, x * d.downwind_x + y * d.downwind_y,
                                  y * d.downwind_x - x * d.downwind_y);
      row[i] = static_cast<float>(d.height_m + sand * d.wavelength_m);
    }
  };
}

}  // namespace plumb::terrain
