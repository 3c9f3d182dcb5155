#include "audit/soundness/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "audit/soundness/draw_parts.h"
#include "core/check.h"
#include "core/number_text.h"
#include "terrain/terrain_source.h"

namespace plumb::audit::soundness {
namespace {

constexpr const char* kConservative = "conservative";

bool keeps(const Method& method) {
  return std::find(method.variants.begin(), method.variants.end(), kConservative) !=
         method.variants.end();
}

// Simple methods cost little to draw again and have little to go wrong.
double weight_of(const Method& method) {
  if (!keeps(method)) return 0.0;
  if (method.name == "full") return 1.0;
  if (method.name == "restricted-quadtree" || method.name == "tessellation") return 3.0;
  return 2.0;
}

const Method& draw_method(RandomNumbers& random, const MethodTable& table,
                          const std::string& only) {
  std::vector<double> weights;
  for (const Method& method : table) weights.push_back(weight_of(method));
  const std::size_t drawn = random.weighted(weights);
  if (only.empty()) return table[drawn];
  const Method& method = find_method(table, only);
  if (!keeps(method)) input_error("method {} has no variant conservative, which promises", only);
  return method;
}

std::int64_t voids_of(const terrain::Heightfield& field) {
  std::int64_t voids = 0;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) voids += field.is_void(i, j);
  }
  return voids;
}

void describe_terrain(const terrain::Heightfield& field, Traits& traits) {
  traits.filled = field.provenance.voids_declared > 0 && voids_of(field) == 0;
  traits.columns = field.columns();
  traits.rows = field.rows();
  traits.not_square_cells = field.dx_m != field.dy_m;
  traits.far_origin = std::max(std::abs(field.origin_m.x), std::abs(field.origin_m.y)) > 1e5;
  traits.void_part =
      static_cast<double>(voids_of(field)) / (static_cast<double>(field.columns()) * field.rows());
  const Box box = bounds(field);
  const double length = std::max(field.columns() * field.dx_m, field.rows() * field.dy_m);
  traits.relief_part = box.empty() ? 0.0 : (box.high.z - box.low.z) / length;
}

}  // namespace

const char* name_of(Placement placement) {
  constexpr const char* kNames[] = {"preset",   "orbit",       "near-ground", "at-sample",
                                    "inside",   "underground", "grazing",     "straight-down",
                                    "far-away", "away"};
  return kNames[static_cast<int>(placement)];
}

double rounded(double value, int digits) {
  return parse_number(fmt::format("{:.{}g}", value, digits)).value();
}

Case draw_case(const MethodTable& table, std::uint64_t seed, std::int64_t index,
               const std::string& only) {
  Case drawn;
  drawn.seed = seed;
  drawn.index = index;
  RandomNumbers random(seed, static_cast<std::uint64_t>(index));
  const Method& method = draw_method(random, table, only);
  drawn.scene.method = method.name;
  // A method of stacks draws terrains of heights too.
  const bool of_stacks = method.full_detail != nullptr && random.chance(0.5);
  draw_terrain(random, of_stacks, drawn.scene, drawn.traits);
  terrain::Heightfield field = terrain::load_terrain(drawn.scene.terrain, drawn.scene.read);
  if (random.chance(0.15) && field.stacks == nullptr && !bounds(field).empty()) {
    drawn.scene.read.no_data_policy = terrain::NoDataPolicy::Fill;
    field = terrain::load_terrain(drawn.scene.terrain, drawn.scene.read);
  }
  describe_terrain(field, drawn.traits);
  draw_camera(random, field, drawn.scene, drawn.traits);
  draw_choice(random, method, field, drawn.scene);
  return drawn;
}

}  // namespace plumb::audit::soundness
