#include "terrain/stacks/stack_field.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/hash.h"

namespace plumb::terrain {
namespace {

float rounded_down(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) <= value
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

float StackField::highest_m() const { return rounded_down(high_m()); }

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

void StackWriter::require_room() const {
  require(field_.first_layer.size() <= field_.size(), "a field of {} stacks takes no more of them",
          field_.size());
}

void StackWriter::next() {
  field_.first_layer.push_back(static_cast<std::uint32_t>(field_.end_m.size()));
}

// `first` is the first layer of the stack that is being written.
void StackWriter::put(std::size_t first, float end_m, Material material) {
  if (field_.end_m.size() > first && field_.material.back() == material) {
    field_.end_m.back() = end_m;
  } else {
    field_.end_m.push_back(end_m);
    field_.material.push_back(material);
  }
}

void StackWriter::add(std::span<const Layer> layers) {
  require_room();
  float before_m = -std::numeric_limits<float>::infinity();
  for (const Layer& layer : layers) {
    require(std::isfinite(layer.start_m) && std::isfinite(layer.end_m) &&
                layer.start_m <= layer.end_m && layer.start_m >= before_m,
            "layers must be finite and follow one another, got {} to {} m above {} m",
            layer.start_m, layer.end_m, before_m);
    require(layer.material < field_.materials.size(), "material {} is not one of {}",
            layer.material, field_.materials.size());
    before_m = layer.end_m;
  }
  const std::size_t first = field_.end_m.size();
  // Each layer may have air below it.
  require(first + 2 * layers.size() <= std::numeric_limits<std::uint32_t>::max(),
          "a field must have at most 2^32 - 1 layers");
  const float highest_m = field_.highest_m();
  float reached_m = field_.low_m;
  for (const Layer& layer : layers) {
    const float start_m = std::max(layer.start_m, reached_m);
    const float end_m = std::min(layer.end_m, highest_m);
    if (layer.material == kAir || !(end_m > start_m)) continue;
    if (start_m > reached_m) put(first, start_m, kAir);
    put(first, end_m, layer.material);
    reached_m = end_m;
  }
  next();
}

void StackWriter::add_hole() {
  require_room();
  if (field_.holes.empty()) field_.holes.assign(field_.size(), 0);
  next();
  field_.holes[field_.first_layer.size() - 2] = 1;
}

std::vector<Layer> layers_of(const StackField& field, int i, int j) {
  const StackView stack = field.stack(i, j);
  std::vector<Layer> layers;
  for (std::size_t k = 0; k < stack.size(); ++k)
    layers.push_back({stack.start_m(k), stack.end_m[k], stack.material[k]});
  const float high_m = field.highest_m();
  const float reached_m = layers.empty() ? field.low_m : layers.back().end_m;
  if (reached_m < high_m) layers.push_back({reached_m, high_m, kAir});
  return layers;
}

namespace {

// A whole multiple of voxel_m, at least voxel_m below lowest_m, as a float.
float low_for(double lowest_m, double voxel_m) {
  double low_m = (std::floor(lowest_m / voxel_m) - 1.0) * voxel_m;
  if (lowest_m - low_m < voxel_m) low_m -= voxel_m;  // the quotient was rounded up
  return rounded_down(low_m);
}

int voxels_up_to(double highest_m, const StackField& field) {
  const double voxels = std::floor((highest_m - field.low_m) / field.voxel_m) + 1.0;
  if (!(voxels < 2147483647.0))
    input_error("voxels of {} m are too low for a relief of {} m", field.voxel_m,
                highest_m - field.low_m);
  return static_cast<int>(voxels);
}

}  // namespace

StackField stacks_of(const Heightfield& heights, double voxel_m) {
  require(voxel_m >= 0.0 && std::isfinite(voxel_m), "voxel_m must be >= 0, got {}", voxel_m);
  const Box box = bounds(heights);
  if (box.empty()) input_error("a terrain without a height has no stacks");
  StackField field;
  field.columns = heights.columns();
  field.rows = heights.rows();
  field.dx_m = heights.dx_m;
  field.dy_m = heights.dy_m;
  field.voxel_m = voxel_m > 0.0 ? voxel_m : 0.5 * (heights.dx_m + heights.dy_m);
  field.origin_m = heights.origin_m;
  field.low_m = low_for(box.low.z, field.voxel_m);
  field.voxels = voxels_up_to(box.high.z, field);
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
  require(field.low_m < field.highest_m(), "voxels of {} m up from {} m must reach the next float",
          field.voxel_m, field.low_m);
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
