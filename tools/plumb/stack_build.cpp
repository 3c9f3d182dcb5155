#include "stack_build.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "core/atomic_file.h"
#include "core/check.h"
#include "stack_info.h"
#include "terrain/mesh_file.h"
#include "terrain/stacks/stack_file.h"
#include "terrain/stacks/stack_import_layers.h"
#include "terrain/stacks/stack_import_mesh.h"
#include "terrain/stacks/stack_import_voxels.h"

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;

void only_with(bool given, const char* option, bool with, const char* other) {
  if (given && !with) input_error("{} is for {} alone", option, other);
}

void check_options(const TerrainOptions& terrain, const StackBuildOptions& options) {
  const int sources = (terrain.terrain.empty() ? 0 : 1) + (options.layers.empty() ? 0 : 1) +
                      (options.voxels.empty() ? 0 : 1) + (options.mesh.empty() ? 0 : 1);
  if (sources != 1)
    input_error(
        "--method stacks needs one of TERRAIN, --layer NAME=FILE (from the bottom up), --voxels "
        "and --mesh, got {} of them",
        sources);
  only_with(!options.voxel_grid.empty(), "--voxel-grid", !options.voxels.empty(), "--voxels");
  only_with(options.low_m.has_value(), "--low", !options.voxels.empty(), "--voxels");
  only_with(!options.up.empty(), "--up", !options.mesh.empty(), "--mesh");
  only_with(options.subtract, "--subtract", !options.mesh.empty(), "--mesh");
  only_with(options.margin_m.has_value(), "--margin", !options.mesh.empty(), "--mesh");
  for (const auto& [value, name] :
       {std::pair{options.voxel_m, "--voxel-height"}, {options.margin_m, "--margin"}}) {
    if (value && (!(*value >= 0.0) || !std::isfinite(*value)))
      input_error("{} {}: expected metres, 0 or more", name, *value);
  }
  TerrainOptions with_spacing;
  with_spacing.spacing = terrain.spacing;
  if (!(options.voxels.empty() && options.mesh.empty()) && !(terrain == with_spacing))
    input_error("{}: of the options for terrains --spacing alone is for voxels and meshes",
                options.voxels.empty() ? options.mesh : options.voxels);
  if (!(options.voxels.empty() && options.mesh.empty()) && terrain.spacing.empty())
    input_error("{}: --spacing is required: metres between stacks",
                options.voxels.empty() ? options.mesh : options.voxels);
}

terrain::StackField layer_stacks(const TerrainOptions& terrain, const StackBuildOptions& options) {
  std::vector<terrain::MaterialSurface> surfaces;
  for (const std::string& layer : options.layers) {
    const std::size_t equals = layer.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == layer.size())
      input_error("--layer '{}': expected NAME=FILE, such as rock=bedrock.tif", layer);
    TerrainOptions of = terrain;
    of.terrain = layer.substr(equals + 1);
    surfaces.push_back({layer.substr(0, equals), load(of)});
  }
  return terrain::stacks_of_layers(surfaces, options.voxel_m.value_or(0.0)).field;
}

std::array<int, 3> sizes_of(const std::string& text) {
  std::array<int, 3> sizes{};
  const char *at = text.data(), *const end = at + text.size();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [next, error] = std::from_chars(at, end, sizes[k]);
    const bool ends_well = k < 2 ? next != end && *next == 'x' : next == end;
    if (error != std::errc() || !ends_well || sizes[k] < 1)
      input_error("--voxel-grid '{}': expected EASTxNORTHxUP, such as 512x512x256", text);
    at = next + 1;
  }
  return sizes;
}

terrain::StackField voxel_stacks(const TerrainOptions& terrain, const StackBuildOptions& options) {
  if (options.voxel_grid.empty())
    input_error("{}: bare voxels state no size; give one with --voxel-grid EASTxNORTHxUP",
                options.voxels);
  const std::array<int, 3> sizes = sizes_of(options.voxel_grid);
  const terrain::Spacing spacing = terrain::parse_spacing(terrain.spacing);
  terrain::VoxelGridShape shape;
  shape.columns = sizes[0];
  shape.rows = sizes[1];
  shape.voxels = sizes[2];
  shape.dx_m = spacing.x_m;
  shape.dy_m = spacing.y_m;
  shape.voxel_m = options.voxel_m.value_or(0.5 * (spacing.x_m + spacing.y_m));
  shape.low_m = static_cast<float>(options.low_m.value_or(0.0));
  return terrain::read_voxels(options.voxels, shape);
}

terrain::StackField mesh_stacks(const TerrainOptions& terrain, const StackBuildOptions& options) {
  const terrain::Spacing spacing = terrain::parse_spacing(terrain.spacing);
  if (spacing.x_m != spacing.y_m)
    input_error("--spacing '{}': stacks of a mesh stand as far apart to the east as to the north",
                terrain.spacing);
  terrain::MeshReadOptions read;
  read.up_axis = options.up == "y" ? terrain::UpAxis::Y : terrain::UpAxis::Z;
  const terrain::MeshFile file = terrain::read_mesh(options.mesh, read);
  terrain::MeshStackOptions stacks;
  stacks.spacing_m = spacing.x_m;
  stacks.voxel_m = options.voxel_m.value_or(0.0);
  stacks.subtract = options.subtract;
  stacks.below_m = stacks.above_m = stacks.beside_m = options.margin_m.value_or(0.0);
  terrain::StackField field = terrain::stacks_of_mesh(file.mesh, options.mesh, stacks).field;
  auto& assumptions = field.provenance.assumptions;
  assumptions.insert(assumptions.begin(), file.assumptions.begin(), file.assumptions.end());
  return field;
}

terrain::StackField stacks(const TerrainOptions& terrain, const StackBuildOptions& options) {
  if (!options.layers.empty()) return layer_stacks(terrain, options);
  if (!options.voxels.empty()) return voxel_stacks(terrain, options);
  if (!options.mesh.empty()) return mesh_stacks(terrain, options);
  const terrain::Heightfield field = load(terrain);
  if (field.stacks == nullptr) return terrain::stacks_of(field, options.voxel_m.value_or(0.0));
  if (options.voxel_m)
    input_error("--voxel-height: {} is a terrain of stacks and has its own, {} m", terrain.terrain,
                field.stacks->voxel_m);
  return *field.stacks;
}

void refuse_own_source(const StackBuildOptions& options, const std::string& output) {
  std::vector<std::string> sources{options.voxels, options.mesh};
  for (const std::string& layer : options.layers)
    sources.push_back(layer.substr(std::min(layer.size(), layer.find('=') + 1)));
  for (const std::string& source : sources) {
    std::error_code ignored;
    if (!source.empty() && fs::equivalent(output, source, ignored))
      input_error("-o '{}' is the terrain itself", output);
  }
}

}  // namespace

void add_stack_build_options(Options& options, StackBuildOptions& stacks) {
  options.group("Stacks");
  options.texts(stacks.layers, "--layer", "NAME=FILE",
                "A material and its surface; several, from the bottom up (air is a gap)");
  options.text(stacks.voxels, "--voxels", "FILE", "Bare bytes, materials of voxels, 0 is air");
  options.text(stacks.voxel_grid, "--voxel-grid", "XxYxZ", "Their numbers east, north and up");
  options.number(stacks.low_m, "--low", "M", "Where the lowest voxel begins (0)");
  options.text(stacks.mesh, "--mesh", "FILE", "A closed triangle mesh");
  options.choice(stacks.up, "--up", {"z", "y"}, "The mesh's upward axis (z)");
  options.flag(stacks.subtract, "--subtract", "The mesh is a void in rock");
  options.number(stacks.margin_m, "--margin", "M", "Metres around the mesh (0)");
  options.number(stacks.voxel_m, "--voxel-height", "M",
                 "Metres that a voxel is high (the spacing's mean)");
}

std::string build_stacks(const TerrainOptions& terrain, const StackBuildOptions& options,
                         const std::string& output, bool json, const Invocation& invocation,
                         Progress& progress) {
  check_options(terrain, options);
  refuse_own_source(options, output);
  const TemporarySibling is_writable(output);  // before the work, not after it
  progress.step("reading the terrain");
  const terrain::StackField field = stacks(terrain, options);
  progress.step("coding its stacks");
  const Bytes bytes = terrain::stack_file_bytes(field);
  progress.step("decoding and comparing every one");
  if (checksum(terrain::stacks_of_bytes(bytes, output)) != checksum(field))
    input_error("cannot write '{}': its stacks did not come back as they are", output);
  write_file_atomically(output, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const auto size = static_cast<std::int64_t>(bytes.size());
  const StackFileSize file{output, size};
  return json ? stacks_json(field, file, invocation) : stacks_text(field, file);
}

}  // namespace plumb::tool
