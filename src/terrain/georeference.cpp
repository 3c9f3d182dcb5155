#include "terrain/georeference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/reproducible_math.h"

namespace plumb::terrain {
namespace {

constexpr double kMercatorRadius_m = 6378137.0;
// Without a stated unit, so small a spacing among coordinates that could be angles is one in
// degrees.
constexpr double kLargestUnstatedDegrees = 0.01;

struct Extent {
  double step_x, step_y;  // between columns and rows, in the file's units, > 0
  double west, south;     // of the first column's and southernmost row's samples
  double centre_x, centre_y;
  double width, height;  // between the outermost samples
};

void check_transform(const std::array<double, 6>& t, const Window& w, const std::string& file) {
  for (const double value : t) {
    if (!std::isfinite(value)) input_error("{}: its geotransform is not finite", file);
  }
  // A shear that moves no sample by a thousandth of a spacing is a rounding, not a rotation.
  const double across = std::abs(t[2]) * w.height, along = std::abs(t[4]) * w.width;
  if (across > 1e-3 * std::abs(t[1]) || along > 1e-3 * std::abs(t[5])) {
    input_error(
        "{}: its rows and columns do not run east and north (rotated geotransform); "
        "gdalwarp writes a copy that does",
        file);
  }
  if (t[1] <= 0.0 || t[5] == 0.0) {
    input_error(
        "{}: its geotransform has a spacing of {} x {}, expected columns that run east; "
        "gdalwarp writes such a copy",
        file, t[1], t[5]);
  }
}

Extent extent_of(const std::array<double, 6>& t, const Window& w) {
  Extent e{};
  e.step_x = t[1];
  e.step_y = std::abs(t[5]);
  e.width = (w.width - 1) * e.step_x;
  e.height = (w.height - 1) * e.step_y;
  e.west = t[0] + (w.x + 0.5) * t[1];
  e.south = t[3] + (t[5] < 0.0 ? w.y + w.height - 0.5 : w.y + 0.5) * t[5];
  e.centre_x = e.west + 0.5 * e.width;
  e.centre_y = e.south + 0.5 * e.height;
  return e;
}

void say_if_wide(Placement& placement, const Window& window) {
  const double degree_m = 111320.0;
  if ((window.width - 1) * placement.dx_m > degree_m * (1.0 + 1e-6) ||
      (window.height - 1) * placement.dy_m > degree_m * (1.0 + 1e-6)) {
    placement.assumptions.push_back(
        "the terrain spans more than a degree and the earth was taken as flat");
  }
}

void place_projected(Placement& p, const Extent& e, const FileGeoreference& g) {
  const double unit = g.metres_per_unit;
  p.dx_m = e.step_x * unit;
  p.dy_m = e.step_y * unit;
  p.origin_m = {e.west * unit, e.south * unit};
  if (unit != 1.0) {
    p.assumptions.push_back(
        fmt::format("horizontal units of {} m, as the file states them, were made metres", unit));
  }
}

void place_mercator(Placement& p, const Extent& e, const FileGeoreference& g) {
  place_projected(p, e, g);
  // With y = R * arsinh(tan(latitude)): cos = 1 / cosh(y / R), tan = sinh(y / R).
  const double grown = reproducible_exp(e.centre_y * g.metres_per_unit / kMercatorRadius_m);
  const double cosine = 2.0 / (grown + 1.0 / grown);
  p.dx_m *= cosine;
  p.dy_m *= cosine;
  p.origin_m *= cosine;
  p.is_local = true;
  p.assumptions.push_back(
      fmt::format("Mercator lengths were scaled by {:.6f}, the cosine of the centre's latitude "
                  "({:.4f} degrees)",
                  cosine, degrees(reproducible_atan((grown - 1.0 / grown) / 2.0))));
}

void place_geographic(Placement& p, const Extent& e, const FileGeoreference& g,
                      const std::string& file) {
  const double latitude = e.centre_y * g.degrees_per_unit;
  if (std::abs(latitude) > 90.0) {
    input_error("{}: its centre has a latitude of {} degrees, expected -90 to 90", file, latitude);
  }
  const MetresPerDegree m = metres_per_degree(latitude, g.semi_major_m, g.inverse_flattening);
  p.dx_m = e.step_x * g.degrees_per_unit * m.east;
  p.dy_m = e.step_y * g.degrees_per_unit * m.north;
  p.is_local = true;
  if (!(p.dx_m > 0.0)) input_error("{}: it is centred on a pole; --crs reprojects it", file);
  p.assumptions.push_back(fmt::format(
      "degrees were made metres on a plane that touches the earth at the centre (latitude {:.4f}): "
      "{:.1f} m east, {:.1f} m north per degree",
      latitude, m.east, m.north));
  const double span = std::max(e.width, e.height) * g.degrees_per_unit;
  if (span > 1.0 + 1e-6) {
    p.assumptions.push_back(
        fmt::format("the terrain spans {:.2f} degrees and the earth was taken as flat", span));
  }
}

bool looks_like_degrees(const Extent& e) {
  return e.step_x <= kLargestUnstatedDegrees && e.step_y <= kLargestUnstatedDegrees &&
         std::abs(e.centre_y) <= 90.0 && std::abs(e.centre_x) <= 360.0;
}

/// The frame of a file that names none, and the line that says so.
Frame assumed_frame(const Extent& e, Placement& p) {
  if (looks_like_degrees(e)) {
    p.assumptions.push_back(
        fmt::format("the file names no coordinate system: its spacing of {} was taken as degrees, "
                    "--spacing says otherwise",
                    e.step_x));
    return Frame::Geographic;
  }
  p.assumptions.push_back(
      "the file names no coordinate system: its coordinates were taken as metres");
  return Frame::Projected;
}

}  // namespace

MetresPerDegree metres_per_degree(double latitude_deg, double semi_major_m,
                                  double inverse_flattening) {
  const double flattening = inverse_flattening > 0.0 ? 1.0 / inverse_flattening : 0.0;
  const double e2 = flattening * (2.0 - flattening);
  const double sine = reproducible_sin(radians(latitude_deg));
  const double cosine =
      std::abs(latitude_deg) == 90.0 ? 0.0 : reproducible_cos(radians(latitude_deg));
  const double w2 = 1.0 - e2 * sine * sine, w = std::sqrt(w2);
  const double prime_vertical = semi_major_m / w;
  const double meridian = semi_major_m * (1.0 - e2) / (w2 * w);
  return {radians(prime_vertical * cosine), radians(meridian)};
}

Placement place(const FileGeoreference& g, const Window& window, const ReadOptions& options,
                const std::string& file) {
  Placement p;
  if (g.has_transform) {
    check_transform(g.transform, window, file);
    p.rows_run_south = g.transform[5] < 0.0;
  }
  if (options.spacing_x_m) {
    p.dx_m = *options.spacing_x_m;
    p.dy_m = options.spacing_y_m.value_or(p.dx_m);
    p.is_local = true;
    p.assumptions.push_back(
        fmt::format("the spacing of {} x {} m is the user's, not the file's", p.dx_m, p.dy_m));
    say_if_wide(p, window);
    return p;
  }
  if (!g.has_transform) {
    if (options.require_spacing) {
      input_error(
          "{}: it states no spacing of its samples; give one with --spacing DX[,DY] in "
          "metres",
          file);
    }
    p.is_local = true;
    p.assumptions.push_back("the file states no spacing: 1 m was assumed");
    return p;
  }
  const Extent e = extent_of(g.transform, window);
  const Frame frame = g.frame == Frame::Unstated ? assumed_frame(e, p) : g.frame;
  if (frame == Frame::Geographic) {
    place_geographic(p, e, g, file);
    return p;
  }
  if (frame == Frame::Mercator) {
    place_mercator(p, e, g);
  } else {
    place_projected(p, e, g);
  }
  say_if_wide(p, window);
  return p;
}

void settle(Heightfield& field, const Placement& placement) {
  field.dx_m = placement.dx_m;
  field.dy_m = placement.dy_m;
  field.origin_m = placement.origin_m;
  field.provenance.is_local = placement.is_local;
  auto& lines = field.provenance.assumptions;
  lines.insert(lines.begin(), placement.assumptions.begin(), placement.assumptions.end());
}

double metres_in_unit(const std::string& unit) {
  std::string name;
  for (const char c : unit) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalpha(byte) != 0) name += static_cast<char>(std::tolower(byte));
  }
  static const std::pair<const char*, double> kUnits[] = {{"m", 1.0},
                                                          {"metre", 1.0},
                                                          {"metres", 1.0},
                                                          {"meter", 1.0},
                                                          {"meters", 1.0},
                                                          {"ft", 0.3048},
                                                          {"foot", 0.3048},
                                                          {"feet", 0.3048},
                                                          {"ftintl", 0.3048},
                                                          {"internationalfoot", 0.3048},
                                                          {"footinternational", 0.3048},
                                                          {"usft", 1200.0 / 3937.0},
                                                          {"ftus", 1200.0 / 3937.0},
                                                          {"ussurveyfoot", 1200.0 / 3937.0},
                                                          {"ussurveyfeet", 1200.0 / 3937.0},
                                                          {"footus", 1200.0 / 3937.0},
                                                          {"footussurvey", 1200.0 / 3937.0},
                                                          {"cm", 0.01},
                                                          {"centimetre", 0.01},
                                                          {"centimeter", 0.01},
                                                          {"dm", 0.1},
                                                          {"decimetre", 0.1},
                                                          {"decimeter", 0.1},
                                                          {"mm", 0.001},
                                                          {"millimetre", 0.001},
                                                          {"millimeter", 0.001},
                                                          {"km", 1000.0},
                                                          {"kilometre", 1000.0},
                                                          {"kilometer", 1000.0},
                                                          {"fathom", 1.8288},
                                                          {"yard", 0.9144},
                                                          {"yd", 0.9144}};
  if (unit.empty()) return 1.0;
  for (const auto& entry : kUnits) {
    if (name == entry.first) return entry.second;
  }
  return 0.0;
}

}  // namespace plumb::terrain
