#include "terrain/stacks/stack_field.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/hash.h"

namespace plumb::terrain {
namespace {

// The highest float that lies in the field.
float highest(const StackField& field) {
  const double high_m = field.high_m();
  const auto rounded = static_cast<float>(high_m);
  return double{rounded} <= high_m
             ? rounded
             : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}

}  // namespace

Material StackView::at(float height_m) const {
  const auto above = std::upper_bound(end_m.begin(), end_m.end(), height_m);
  return above == end_m.end() ? kAir : material[static_cast<std::size_t>(above - end_m.begin())];
}

StackView StackField::stack(int i, int j) const {
  const std::size_t at = index(i, j);
  const std::size_t first = first_layer[at], count = first_layer[at + 1] - first;
  return {low_m, std::span(end_m).subspan(first, count), std::span(material).subspan(first, count)};
}

std::size_t StackField::bytes() const {
  return first_layer.size() * sizeof(std::uint32_t) + end_m.size() * sizeof(float) +
         material.size() * sizeof(Material) + holes.size();
}

StackWriter::StackWriter(StackField& field) : field_(field) {
  field.first_layer.assign(1, 0);
  field.first_layer.reserve(field.size() + 1);
  field.end_m.clear();
  field.material.clear();
  field.holes.clear();
}

void StackWriter::next() {
  require(field_.first_layer.size() <= field_.size(), "a field of {} stacks takes no more of them",
          field_.size());
  require(field_.end_m.size() < std::numeric_limits<std::uint32_t>::max(),
          "a field has at most 2^32 - 1 layers");
  field_.first_layer.push_back(static_cast<std::uint32_t>(field_.end_m.size()));
}

void StackWriter::add(std::span<const Layer> layers) {
  const std::size_t first = field_.end_m.size();
  const float high_m = highest(field_);
  const auto put = [&](float end_m, Material material) {
    if (field_.end_m.size() > first && field_.material.back() == material) {
      field_.end_m.back() = end_m;
    } else {
      field_.end_m.push_back(end_m);
      field_.material.push_back(material);
    }
  };
  float reached_m = field_.low_m, before_m = -std::numeric_limits<float>::infinity();
  for (const Layer& layer : layers) {
    require(std::isfinite(layer.start_m) && std::isfinite(layer.end_m) &&
                layer.start_m <= layer.end_m && layer.start_m >= before_m,
            "layers must be finite and follow one another, got {} to {} m above {} m",
            layer.start_m, layer.end_m, before_m);
    require(layer.material < field_.materials.size(), "material {} is not one of {}",
            layer.material, field_.materials.size());
    before_m = layer.end_m;
    const float start_m = std::max(layer.start_m, reached_m), end_m = std::min(layer.end_m, high_m);
    if (layer.material == kAir || !(end_m > start_m)) continue;
    if (start_m > reached_m) put(start_m, kAir);
    put(end_m, layer.material);
    reached_m = end_m;
  }
  next();
}

void StackWriter::add_hole() {
  if (field_.holes.empty()) field_.holes.assign(field_.size(), 0);
  next();
  field_.holes[field_.first_layer.size() - 2] = 1;
}

std::vector<Layer> layers_of(const StackField& field, int i, int j) {
  const StackView stack = field.stack(i, j);
  std::vector<Layer> layers;
  for (std::size_t k = 0; k < stack.size(); ++k)
    layers.push_back({stack.start_m(k), stack.end_m[k], stack.material[k]});
  const float high_m = highest(field);
  const float reached_m = layers.empty() ? field.low_m : layers.back().end_m;
  if (reached_m < high_m) layers.push_back({reached_m, high_m, kAir});
  return layers;
}

StackField stacks_of(const Heightfield& heights, double voxel_m) {
  const Box box = bounds(heights);
  if (box.empty()) input_error("a terrain without a height has no stacks");
  StackField field;
  field.columns = heights.columns();
  field.rows = heights.rows();
  field.dx_m = heights.dx_m;
  field.dy_m = heights.dy_m;
  field.voxel_m = voxel_m > 0.0 ? voxel_m : 0.5 * (heights.dx_m + heights.dy_m);
  field.origin_m = heights.origin_m;
  field.low_m = static_cast<float>((std::floor(box.low.z / field.voxel_m) - 1.0) * field.voxel_m);
  const double voxels =
      std::floor((box.high.z - static_cast<double>(field.low_m)) / field.voxel_m) + 1.0;
  if (!(voxels < 2147483647.0))
    input_error("voxels of {} m are too low for a relief of {} m", field.voxel_m,
                box.high.z - box.low.z);
  field.voxels = static_cast<int>(voxels);
  field.materials = {{"air", glm::dvec3(0.0)}, {"rock", glm::dvec3(0.42, 0.38, 0.33)}};
  field.provenance = heights.provenance;
  StackWriter writer(field);
  std::vector<float> buffer;
  for (int j = 0; j < field.rows; ++j) {
    for (const float height : heights.heights_m.row(j, buffer)) {
      if (std::isnan(height)) {
        writer.add_hole();
      } else {
        const Layer layer{field.low_m, height, 1};
        writer.add({&layer, 1});
      }
    }
  }
  return field;
}

Heightfield top_surface(const StackField& field) {
  Heightfield top;
  Grid<float> heights(field.columns, field.rows);
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      const StackView stack = field.stack(i, j);
      heights(i, j) = field.is_hole(i, j) ? std::numeric_limits<float>::quiet_NaN()
                      : stack.size() == 0 ? field.low_m
                                          : stack.end_m.back();
    }
  }
  top.heights_m = HeightGrid(std::move(heights));
  top.dx_m = field.dx_m;
  top.dy_m = field.dy_m;
  top.origin_m = field.origin_m;
  top.provenance = field.provenance;
  top.provenance.assumptions.push_back(
      "of stacks of material their top surface: what lies below overhangs is left out");
  return top;
}

std::uint64_t checksum(const StackField& field) {
  Checksum sum;
  sum.add(field.columns).add(field.rows).add(field.voxels);
  sum.add(field.dx_m).add(field.dy_m).add(field.voxel_m);
  sum.add(field.origin_m.x).add(field.origin_m.y).add(field.low_m);
  sum.add(std::span(field.first_layer)).add(std::span(field.end_m)).add(std::span(field.material));
  sum.add(std::span(field.holes));
  for (const MaterialInfo& info : field.materials)
    sum.add(std::string_view(info.name)).add(info.colour.x).add(info.colour.y).add(info.colour.z);
  return sum.value();
}

namespace {

void require_stack(const StackField& field, int i, int j) {
  const StackView stack = field.stack(i, j);
  for (std::size_t k = 0; k < stack.size(); ++k) {
    require(stack.end_m[k] > stack.start_m(k) && stack.material[k] < field.materials.size() &&
                (k == 0 || stack.material[k] != stack.material[k - 1]),
            "layer {} of stack ({}, {}) must rise above the one below and be of another material",
            k, i, j);
  }
  require(stack.size() == 0 ||
              (stack.material.back() != kAir &&
               static_cast<double>(stack.end_m.back()) <= field.high_m() && !field.is_hole(i, j)),
          "stack ({}, {}) must end in a material within the field, and not be a hole", i, j);
}

}  // namespace

void require_valid(const StackField& field) {
  require(field.columns >= 1 && field.rows >= 1 && field.voxels >= 1,
          "a field must have stacks and voxels, got {} x {} x {}", field.columns, field.rows,
          field.voxels);
  for (const double spacing : {field.dx_m, field.dy_m, field.voxel_m})
    require(std::isfinite(spacing) && spacing > 0.0, "spacings must be above zero, got {} m",
            spacing);
  require(std::isfinite(field.low_m) && std::isfinite(field.high_m()) &&
              std::isfinite(field.origin_m.x) && std::isfinite(field.origin_m.y),
          "heights and origin must be finite, got {} m", field.low_m);
  require(!field.materials.empty() && field.materials.size() <= 256,
          "a field must have 1 to 256 materials, got {}", field.materials.size());
  require(field.first_layer.size() == field.size() + 1 && field.first_layer.front() == 0 &&
              field.first_layer.back() == field.end_m.size() &&
              field.end_m.size() == field.material.size() &&
              std::is_sorted(field.first_layer.begin(), field.first_layer.end()) &&
              (field.holes.empty() || field.holes.size() == field.size()),
          "a field's arrays must fit its {} stacks", field.size());
  for (int j = 0; j < field.rows; ++j)
    for (int i = 0; i < field.columns; ++i) require_stack(field, i, j);
}

}  // namespace plumb::terrain
