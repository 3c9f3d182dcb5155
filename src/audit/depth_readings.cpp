#include "audit/depth_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "audit/plan_fit.h"
#include "audit/turned_cameras.h"

namespace plumb::audit {
namespace {

using Readings = std::vector<DepthReading>;

std::string rows_text(bool from_bottom) {
  return from_bottom ? "its rows run from the bottom up (--depth-y up)"
                     : "its rows run from the top down (--depth-y down)";
}

// Rows and columns either way, and every convention: one change or two.
void add_numbers(const DepthReading& stated, Readings& readings) {
  constexpr std::array kAll{DepthConvention::Linear, DepthConvention::Distance,
                            DepthConvention::Window, DepthConvention::Ndc,
                            DepthConvention::ReverseZ};
  for (int flips = 0; flips < 4; ++flips) {
    for (const DepthConvention convention : kAll) {
      const bool other = convention != stated.meaning.convention;
      if (flips == 0 && !other) continue;
      DepthReading r = stated;
      r.meaning.convention = convention;
      std::string turned;
      if (flips & 1) r.meaning.rows_from_bottom = !r.meaning.rows_from_bottom;
      if (flips & 2) r.meaning.columns_from_right = !r.meaning.columns_from_right;
      if (flips == 1) turned = rows_text(r.meaning.rows_from_bottom);
      if (flips == 2) turned = "its columns run from right to left";
      if (flips == 3) turned = "it is turned by half a turn, rows and columns both";
      r.text =
          other ? (turned.empty() ? "" : turned + ", and ") + convention_text(convention) : turned;
      r.plainness = flips > 0 && other ? Plainness::TwoMistakes : Plainness::OneMistake;
      readings.push_back(std::move(r));
    }
  }
}

void add_camera(const DepthReading& stated, const Camera& camera, std::string text,
                Readings& readings) {
  DepthReading r = stated;
  r.camera = r.seen_by = camera;
  r.text = std::move(text);
  readings.push_back(std::move(r));
}

void add_lenses(const DepthReading& stated, Readings& readings) {
  const Camera& c = stated.camera;
  const double aspect = static_cast<double>(c.width_px) / c.height_px;
  if (std::abs(aspect - 1.0) > 0.01) {
    for (const bool across : {true, false}) {
      Camera camera = c;
      camera.gamma_h *= across ? aspect : 1.0 / aspect;
      camera.gamma_v *= across ? aspect : 1.0 / aspect;
      add_camera(stated, camera,
                 across
                     ? "its field of view, given as the vertical one, was taken for the "
                       "horizontal one"
                     : "its field of view is the vertical one of a horizontal one that was given",
                 readings);
    }
  }
  for (int b = -2; b <= 2; ++b) {
    for (int a = -2; a <= 2; ++a) {
      if (a == 0 && b == 0) continue;
      Camera camera = c;
      camera.centre_px += 0.5 * glm::dvec2(a, b);
      add_camera(
          stated, camera,
          fmt::format("it is shifted by ({:g}, {:g}) px, to the right and down", 0.5 * a, 0.5 * b),
          readings);
      readings.back().is_slight = true;
    }
  }
}

// The picture of a terrain that is mirrored or turned about its middle is that of the terrain
// through a camera mirrored or turned.
void add_turned_terrains(const DepthReading& stated, const terrain::Heightfield& field,
                         Readings& readings) {
  const auto add = [&](const Turn& turn, const char* text) {
    add_camera(stated, turned_about_middle(field, turn, stated.camera), text, readings);
  };
  add({.mirror_y = true}, "the terrain that was drawn has north and south exchanged");
  add({.mirror_x = true}, "the terrain that was drawn has east and west exchanged");
  add({.mirror_x = true, .mirror_y = true}, "the terrain that was drawn is turned by half a turn");
  add({.exchange = true}, "the terrain that was drawn has its rows and columns exchanged");
  add({.mirror_y = true, .exchange = true},
      "the terrain that was drawn is turned by a quarter of a turn clockwise");
  add({.mirror_x = true, .exchange = true},
      "the terrain that was drawn is turned by a quarter of a turn counter-clockwise");
}

void add_places(const DepthReading& stated, const terrain::Heightfield& field, Readings& readings) {
  const auto add = [&](const glm::dvec3& by, std::string text) {
    Camera camera = stated.camera;
    camera.eye_m += by;
    add_camera(stated, camera, std::move(text), readings);
  };
  for (int b = -1; b <= 1; ++b) {
    for (int a = -1; a <= 1; ++a) {
      const glm::dvec3 by{0.5 * a * field.dx_m, 0.5 * b * field.dy_m, 0.0};
      if (a == 0 && b == 0) continue;
      add(by, fmt::format("the terrain that was drawn lies half a sample off, by ({:g}, {:g}) m: "
                          "samples stand at points, not in the middle of pixels",
                          0.0 - by.x, 0.0 - by.y));
      readings.back().is_slight = true;
    }
  }
  const glm::dvec3 origin = field.world_origin_m();
  if (origin == glm::dvec3(0.0)) return;
  add(origin,
      fmt::format("its camera's place is relative to the terrain's origin ({:.10g}, {:.10g})",
                  origin.x, origin.y));
  add(-origin, fmt::format("its camera's place has the terrain's origin ({:.10g}, {:.10g}) added "
                           "once too often",
                           origin.x, origin.y));
}

}  // namespace

std::string convention_text(DepthConvention convention) {
  const char* what = "";
  switch (convention) {
    case DepthConvention::Linear:
      what = "its numbers are view depths";
      break;
    case DepthConvention::Distance:
      what = "its numbers are distances along the ray";
      break;
    case DepthConvention::Window:
      what = "its numbers are window depths, 0 near and 1 far";
      break;
    case DepthConvention::Ndc:
      what = "its numbers are OpenGL's normalised depths, -1 near and 1 far";
      break;
    case DepthConvention::ReverseZ:
      what = "its numbers are reversed window depths, 1 near and 0 far";
      break;
  }
  return fmt::format("{} (--depth-convention {})", what, name_of(convention));
}

std::string unit_text(double metres_per_unit) {
  constexpr std::array<std::pair<double, const char*>, 7> kUnits{{{1.0, "metres"},
                                                                  {0.3048, "feet"},
                                                                  {0.9144, "yards"},
                                                                  {0.01, "centimetres"},
                                                                  {0.001, "millimetres"},
                                                                  {1000.0, "kilometres"},
                                                                  {1609.344, "miles"}}};
  for (const auto& [size, name] : kUnits) {
    if (std::abs(metres_per_unit / size - 1.0) < 1e-3) return name;
  }
  return fmt::format("{:.6g} m", metres_per_unit);
}

namespace {

struct InverseLine {
  double a = 0.0, b = 0.0;  // 1/w = a + b d
};

std::optional<InverseLine> fitted_line(const std::vector<StoredDepth>& stored) {
  InverseLine line;
  double keep_below = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3; ++round) {
    std::array<double, 5> sums{};
    for (const auto& [d, w] : stored) {
      if (std::abs(1.0 - w * (line.a + line.b * d)) > keep_below) continue;
      sums[0] += w * w;
      sums[1] += w * w * d;
      sums[2] += w * w * d * d;
      sums[3] += w;
      sums[4] += w * d;
    }
    const double all = sums[0] * sums[2] - sums[1] * sums[1];
    if (!(all > 0.0)) return std::nullopt;
    line = {(sums[3] * sums[2] - sums[4] * sums[1]) / all,
            (sums[0] * sums[4] - sums[1] * sums[3]) / all};
    std::vector<double> left;
    for (const auto& [d, w] : stored) left.push_back(std::abs(1.0 - w * (line.a + line.b * d)));
    keep_below = middle_of(std::move(left));
  }
  return line;
}

std::string size_text(double metres) {
  return std::isinf(metres) ? "infinity" : fmt::format("{:.4g} m", metres);
}

}  // namespace

std::optional<DepthReading> reading_of_planes(const DepthReading& given,
                                              const std::vector<StoredDepth>& stored,
                                              const DepthMeaning& stated) {
  std::vector<StoredDepth> inner;  // neither cleared nor at an end
  for (const StoredDepth& s : stored) {
    if (s.number > -1.0 && s.number < 1.0 && s.number != 0.0) inner.push_back(s);
  }
  const auto line = fitted_line(inner);
  if (!line) return std::nullopt;
  const bool is_ndc =
      std::any_of(inner.begin(), inner.end(), [](const StoredDepth& s) { return s.number < 0.0; });
  const bool reversed = line->b > 0.0;
  const double near_end = is_ndc     ? line->a - line->b
                          : reversed ? line->a + line->b
                                     : line->a,
               far_end = is_ndc || !reversed ? line->a + line->b : line->a;
  if (!(near_end > 0.0) || (is_ndc && reversed)) return std::nullopt;
  DepthReading reading = given;
  reading.plainness = Plainness::Fitted;
  reading.meaning.convention = is_ndc     ? DepthConvention::Ndc
                               : reversed ? DepthConvention::ReverseZ
                                          : DepthConvention::Window;
  Camera& camera = reading.camera;
  camera.near_m = 1.0 / near_end;
  // A far plane is known no better than the fit.
  camera.far_m =
      far_end > 1e-6 * near_end ? 1.0 / far_end : std::numeric_limits<double>::infinity();
  if (!(camera.far_m > camera.near_m)) return std::nullopt;
  reading.seen_by = camera;
  if (reading.meaning.rows_from_bottom != stated.rows_from_bottom)
    reading.text = rows_text(reading.meaning.rows_from_bottom) + ", and ";
  else
    reading.text.clear();
  if (reading.meaning.convention != stated.convention)
    reading.text += convention_text(reading.meaning.convention) + ", and ";
  reading.text +=
      fmt::format("its near plane lies at {} and its far one at {} (the camera says {} and {})",
                  size_text(camera.near_m), size_text(camera.far_m), size_text(given.camera.near_m),
                  size_text(given.camera.far_m));
  return reading;
}

std::vector<DepthReading> other_readings(const DepthReading& stated,
                                         const terrain::Heightfield& field) {
  Readings readings;
  add_numbers(stated, readings);
  add_lenses(stated, readings);
  add_turned_terrains(stated, field, readings);
  add_places(stated, field, readings);
  return readings;
}

}  // namespace plumb::audit
