#include "terrain/stacks/stack_import_voxels.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/check.h"
#include "core/memory.h"
#include "terrain/stacks/stack_import.h"

namespace plumb::terrain {
namespace {

bool is_positive(double number) { return number > 0.0 && std::isfinite(number); }

// In double, exact up to 2^53 and never beyond: sizes have 31 bits each.
double bytes_of(const VoxelGridShape& shape) {
  return static_cast<double>(shape.columns) * shape.rows * shape.voxels;
}

void check(const VoxelGridShape& shape, double bytes, const std::string& name) {
  if (shape.columns < 1 || shape.rows < 1 || shape.voxels < 1 || bytes_of(shape) != bytes)
    input_error("{}: {} x {} x {} voxels of a byte are {:.0f} bytes, there are {:.0f}", name,
                shape.columns, shape.rows, shape.voxels, bytes_of(shape), bytes);
  if (!is_positive(shape.dx_m) || !is_positive(shape.dy_m) || !is_positive(shape.voxel_m) ||
      !std::isfinite(shape.low_m) || !std::isfinite(shape.origin_m.x) ||
      !std::isfinite(shape.origin_m.y))
    input_error("{}: spacings must be above zero and the place finite, got {} x {} x {} m", name,
                shape.dx_m, shape.dy_m, shape.voxel_m);
  const double low_m = static_cast<double>(shape.low_m);
  const double high_m = low_m + shape.voxels * shape.voxel_m;
  const auto largest = static_cast<float>(std::max(std::abs(low_m), std::abs(high_m)));
  const double step_m = double{largest} - double{std::nextafter(largest, 0.0F)};
  if (!(step_m <= shape.voxel_m) || !std::isfinite(largest))
    input_error(
        "{}: voxels of {} m at heights of {} to {} m are lower than single precision tells "
        "apart, {} m",
        name, shape.voxel_m, low_m, high_m, step_m);
}

void name_materials(std::span<const std::uint8_t> indices, const VoxelGridShape& shape,
                    StackField& field) {
  const std::size_t most = *std::max_element(indices.begin(), indices.end());
  field.materials.push_back(material_named("air", 0));
  for (std::size_t k = 1; k <= std::max(most, std::min<std::size_t>(shape.materials.size(), 255));
       ++k) {
    const std::string name =
        k <= shape.materials.size() ? shape.materials[k - 1] : fmt::format("material{}", k);
    field.materials.push_back(material_named(name, k));
  }
}

StackField stacks_of(std::span<const std::uint8_t> indices, const VoxelGridShape& shape,
                     const std::string& name) {
  check(shape, static_cast<double>(indices.size()), name);
  StackField field;
  field.columns = shape.columns;
  field.rows = shape.rows;
  field.voxels = shape.voxels;
  field.dx_m = shape.dx_m;
  field.dy_m = shape.dy_m;
  field.voxel_m = shape.voxel_m;
  field.origin_m = shape.origin_m;
  field.low_m = shape.low_m;
  name_materials(indices, shape, field);
  field.provenance.source = name;
  field.provenance.format = "voxels";
  field.provenance.file_columns = shape.columns;
  field.provenance.file_rows = shape.rows;
  const auto height_m = [&](int voxel) {
    return static_cast<float>(static_cast<double>(shape.low_m) + voxel * shape.voxel_m);
  };
  StackWriter writer(field);
  std::vector<Layer> layers;
  const std::size_t stacks = field.size();
  for (std::size_t at = 0; at < stacks; ++at) {
    layers.clear();
    for (int v = 0, first = 0; v < shape.voxels; first = v) {
      const std::uint8_t material = indices[at + stacks * static_cast<std::size_t>(first)];
      while (v < shape.voxels && indices[at + stacks * static_cast<std::size_t>(v)] == material)
        ++v;
      layers.push_back({height_m(first), height_m(v), material});
    }
    writer.add(layers);
  }
  return field;
}

}  // namespace

StackField stacks_of_voxels(std::span<const std::uint8_t> indices, const VoxelGridShape& shape) {
  return stacks_of(indices, shape, "voxels");
}

StackField read_voxels(const std::string& path, const VoxelGridShape& shape) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) input_error("cannot read '{}': {}", path, error.message());
  check(shape, static_cast<double>(size), path);
  require_memory(static_cast<std::int64_t>(size), "the voxels of '" + path + "'");
  std::vector<std::uint8_t> indices(size);
  std::ifstream file(path, std::ios::binary);
  if (!file) input_error("cannot read '{}': {}", path, std::strerror(errno));
  if (!file.read(reinterpret_cast<char*>(indices.data()), static_cast<std::streamsize>(size)))
    input_error("cannot read '{}': it ends before byte {}", path, size);
  return stacks_of(indices, shape, path);
}

}  // namespace plumb::terrain
