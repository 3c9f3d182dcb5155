#include "terrain/stacks/stack_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace plumb::terrain {

MaterialInfo material_named(const std::string& name, std::size_t number) {
  static const std::array<MaterialInfo, 8> kKnown{{{"air", {0.0, 0.0, 0.0}},
                                                   {"rock", {0.42, 0.38, 0.33}},
                                                   {"soil", {0.30, 0.20, 0.11}},
                                                   {"sand", {0.70, 0.58, 0.36}},
                                                   {"clay", {0.52, 0.30, 0.20}},
                                                   {"ice", {0.75, 0.85, 0.95}},
                                                   {"water", {0.10, 0.25, 0.40}},
                                                   {"concrete", {0.55, 0.55, 0.53}}}};
  for (const MaterialInfo& known : kKnown) {
    if (known.name == name) return known;
  }
  const auto channel = [&](std::size_t step) {  // steps that have no factor in common with 16
    return 0.1 + 0.05 * static_cast<double>(number * step % 16);
  };
  return {name, {channel(3), channel(7), channel(11)}};
}

Material add_material(StackField& field, const std::string& name) {
  if (name.empty()) input_error("a layer without a material's name");
  if (field.materials.empty()) field.materials.push_back(material_named("air", 0));
  if (name == "air") return kAir;
  const auto found = std::find_if(field.materials.begin() + 1, field.materials.end(),
                                  [&](const MaterialInfo& info) { return info.name == name; });
  const auto number = static_cast<std::size_t>(found - field.materials.begin());
  if (number > 255) input_error("material '{}' is the 257th, a field has at most 256", name);
  if (found == field.materials.end()) field.materials.push_back(material_named(name, number));
  return static_cast<Material>(number);
}

void reach(StackField& field, double low_m, double high_m, double voxel_m) {
  field.voxel_m = voxel_m > 0.0 ? voxel_m : 0.5 * (field.dx_m + field.dy_m);
  field.low_m = static_cast<float>((std::floor(low_m / field.voxel_m) - 1.0) * field.voxel_m);
  const double from_m = static_cast<double>(field.low_m);
  const double voxels = std::floor((high_m - from_m) / field.voxel_m) + 1.0;
  const double largest_m = std::max(std::abs(from_m), std::abs(high_m));
  if (!(from_m < low_m) || !(voxels < 2147483647.0) ||
      !(largest_m <= double{std::numeric_limits<float>::max()}))
    input_error("voxels of {} m are too low for heights of {} to {} m", field.voxel_m, low_m,
                high_m);
  field.voxels = static_cast<int>(voxels);
}

}  // namespace plumb::terrain
