#include "terrain/stacks/stack_import_layers.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "terrain/stacks/stack_import.h"

namespace plumb::terrain {
namespace {

constexpr double kSamePlace = 1e-6;  // of a cell

std::string name_of(const MaterialSurface& surface) {
  const std::string& source = surface.top.provenance.source;
  return source.empty() ? fmt::format("layer '{}'", surface.material)
                        : fmt::format("layer '{}' ({})", surface.material, source);
}

void require_same_grid(const MaterialSurface& first, const MaterialSurface& other) {
  const Heightfield &a = first.top, &b = other.top;
  const std::string names = name_of(other) + " and " + name_of(first);
  if (a.columns() != b.columns() || a.rows() != b.rows())
    input_error("{} must have one size, got {} x {} and {} x {} samples", names, b.columns(),
                b.rows(), a.columns(), a.rows());
  const double off_x = std::abs(b.dx_m - a.dx_m) * a.columns() / a.dx_m,
               off_y = std::abs(b.dy_m - a.dy_m) * a.rows() / a.dy_m;
  if (!(std::max(off_x, off_y) <= kSamePlace))
    input_error("{} must have one spacing, got {:.10g} x {:.10g} and {:.10g} x {:.10g} m", names,
                b.dx_m, b.dy_m, a.dx_m, a.dy_m);
  const glm::dvec2 shift = b.origin_m - a.origin_m;
  if (!(std::abs(shift.x) <= kSamePlace * a.dx_m && std::abs(shift.y) <= kSamePlace * a.dy_m))
    input_error("{} must have one origin, the first lies {:.10g} m east and {:.10g} m north", names,
                shift.x, shift.y);
  const std::string system = system_of_coordinates(a.provenance),
                    others = system_of_coordinates(b.provenance);
  if (!system.empty() && !others.empty() && system != others)
    input_error("{} must have one coordinate system, got {} and {}", names, others, system);
}

void check(std::span<const MaterialSurface> surfaces) {
  if (surfaces.empty()) input_error("stacks of layers need a layer");
  for (const MaterialSurface& surface : surfaces) {
    if (bounds(surface.top).empty()) input_error("{} has no height", name_of(surface));
    require_same_grid(surfaces.front(), surface);
  }
  if (surfaces.back().material == "air")
    input_error(
        "{} is the topmost, and above the topmost is air: layers are given from the bottom "
        "up",
        name_of(surfaces.back()));
}

// The layers of one stack; false if a surface is void there.
bool layers_at(std::span<const MaterialSurface> surfaces, std::span<const Material> materials,
               int i, int j, LayeredStacks& result, std::vector<Layer>& layers) {
  layers.clear();
  for (const MaterialSurface& surface : surfaces) {
    if (surface.top.is_void(i, j)) return false;
  }
  float reached_m = result.field.low_m;
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const float end_m = surfaces[k].top.heights_m(i, j);
    if (end_m > reached_m) {
      layers.push_back({reached_m, end_m, materials[k]});
      reached_m = end_m;
    } else {
      ++result.pinched[k];
      result.deepest_pinch_m[k] =
          std::max(result.deepest_pinch_m[k], double{reached_m} - double{end_m});
    }
  }
  return true;
}

void say(std::span<const MaterialSurface> surfaces, LayeredStacks& result) {
  Provenance& p = result.field.provenance;
  p = surfaces.front().top.provenance;
  p.source.clear();
  p.format = "layers";
  for (const MaterialSurface& surface : surfaces) {
    p.source +=
        (p.source.empty() ? "" : " + ") + surface.material + "=" + surface.top.provenance.source;
    for (const std::string& line : surface.top.provenance.assumptions) {
      if (std::find(p.assumptions.begin(), p.assumptions.end(), line) == p.assumptions.end())
        p.assumptions.push_back(line);
    }
  }
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (result.pinched[k] > 0)
      p.assumptions.push_back(fmt::format(
          "layer '{}' has no thickness at {} of {} stacks, where its surface lies on the one "
          "before or "
          "up to {:.6g} m below",
          surfaces[k].material, result.pinched[k], result.field.size(), result.deepest_pinch_m[k]));
  }
  if (result.holes > 0)
    p.assumptions.push_back(
        fmt::format("{} of {} stacks are holes: a layer's surface is void there", result.holes,
                    result.field.size()));
}

}  // namespace

LayeredStacks stacks_of_layers(std::span<const MaterialSurface> surfaces, double voxel_m) {
  check(surfaces);
  LayeredStacks result;
  result.pinched.assign(surfaces.size(), 0);
  result.deepest_pinch_m.assign(surfaces.size(), 0.0);
  StackField& field = result.field;
  const Heightfield& grid = surfaces.front().top;
  field.columns = grid.columns();
  field.rows = grid.rows();
  field.dx_m = grid.dx_m;
  field.dy_m = grid.dy_m;
  field.origin_m = grid.origin_m;
  Box box;
  std::vector<Material> materials;
  for (const MaterialSurface& surface : surfaces) {
    const Box of = bounds(surface.top);
    box.add(of.low);
    box.add(of.high);
    materials.push_back(add_material(field, surface.material));
  }
  reach(field, box.low.z, box.high.z, voxel_m);
  StackWriter writer(field);
  std::vector<Layer> layers;
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      if (layers_at(surfaces, materials, i, j, result, layers)) {
        writer.add(layers);
      } else {
        ++result.holes;
        writer.add_hole();
      }
    }
  }
  say(surfaces, result);
  return result;
}

}  // namespace plumb::terrain
