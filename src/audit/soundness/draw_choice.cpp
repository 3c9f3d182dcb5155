// What is asked of a method: its parameters, in the ranges that its documentation states.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "audit/soundness/draw_parts.h"

namespace plumb::audit::soundness {
namespace {

using Parameters = std::map<std::string, std::string>;

std::string power(RandomNumbers& random, int least, int most) {
  return std::to_string(1 << random.integer(least, most));
}

std::string number(double value) { return fmt::format("{}", rounded(value, 4)); }

double largest_height_m(const terrain::Heightfield& field) {
  const Box box = bounds(field);
  return box.empty() ? 0.0 : std::max(std::abs(box.low.z), std::abs(box.high.z));
}

void draw_quadtree(RandomNumbers& random, const terrain::Heightfield&, Parameters& to) {
  if (random.chance(0.4)) to["patch_cells"] = power(random, 1, 7);
}

// Coded heights may be off by no less than single precision rounds them, and by 2^-30 of them.
void draw_tessellation(RandomNumbers& random, const terrain::Heightfield& field, Parameters& to) {
  int patch = 7;
  if (random.chance(0.6)) {
    patch = random.integer(3, 8);
    to["patch_cells"] = std::to_string(1 << patch);
  }
  if (random.chance(0.5)) to["block_cells"] = power(random, 3, std::min(6, patch));
  if (random.chance(0.25)) to["format_version"] = random.chance(0.7) ? "1" : "2";
  const double spacing = std::min(field.dx_m, field.dy_m);
  if (random.chance(0.5)) {
    const double least = std::max(1e-6 * largest_height_m(field), 1e-6);
    to["error"] = number(std::max(least, spacing * random.log_uniform(1e-4, 1.0)));
  }
}

// Heights that are not looked up triangulated claim nothing, and are left out.
void draw_slicing(RandomNumbers& random, const terrain::Heightfield&, Parameters& to) {
  if (random.chance(0.5)) to["leaf_cells"] = std::to_string(2 * random.integer(1, 16));
  if (random.chance(0.3)) to["descend"] = number(random.log_uniform(0.1, 4.0));
  if (random.chance(0.3)) to["cut"] = "optimum";
  if (random.chance(0.3)) to["renderer"] = "quads";
  if (random.chance(0.1)) to["antialias"] = number(random.uniform(0.0, 4.0));
  if (random.chance(0.1)) to["fog"] = number(random.log_uniform(0.1, 100.0));
}

void draw_stacks(RandomNumbers& random, const terrain::Heightfield&, Parameters& to) {
  if (random.chance(0.6)) to["placement"] = random.one_of<std::string>({"mean", "qef", "particle"});
  if (random.chance(0.4)) to["filter"] = random.one_of<std::string>({"gauss", "box"});
  if (random.chance(0.4)) to["radius"] = std::to_string(random.integer(0, 4));
}

using Drawer = void (*)(RandomNumbers&, const terrain::Heightfield&, Parameters&);

const std::map<std::string, Drawer>& drawers() {
  static const std::map<std::string, Drawer> table{{"restricted-quadtree", draw_quadtree},
                                                   {"tessellation", draw_tessellation},
                                                   {"chunked", draw_tessellation},
                                                   {"stacks", draw_stacks},
                                                   {"slicing", draw_slicing},
                                                   {"hybrid-slicing", draw_slicing}};
  return table;
}

Tolerance draw_tolerance(RandomNumbers& random, const Method& method,
                         const terrain::Heightfield& field) {
  const auto& units = method.tolerance_units;
  const bool takes_metres = std::find(units.begin(), units.end(), Unit::Metre) != units.end();
  const bool takes_pixels = std::find(units.begin(), units.end(), Unit::Pixel) != units.end();
  const double spacing = std::min(field.dx_m, field.dy_m);
  if (takes_metres && (!takes_pixels || random.chance(0.25)))
    return {rounded(spacing * random.log_uniform(1e-3, 10.0), 4), Unit::Metre};
  return {rounded(random.log_uniform(0.1, 64.0), 4), Unit::Pixel};
}

}  // namespace

void draw_choice(RandomNumbers& random, const Method& method, const terrain::Heightfield& field,
                 Scene& scene) {
  scene.choice.variant = "conservative";
  const auto drawer = drawers().find(method.name);
  if (drawer != drawers().end()) drawer->second(random, field, scene.choice.parameters);
  scene.tolerance = draw_tolerance(random, method, field);
}

}  // namespace plumb::audit::soundness
