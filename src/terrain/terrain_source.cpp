#include "terrain/terrain_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <new>

#include "core/check.h"
#include "terrain/gdal_reader.h"
#include "terrain/generators.h"
#include "terrain/image_reader.h"
#include "terrain/memory_check.h"
#include "terrain/raw_reader.h"
#include "terrain/stacks/stack_file.h"
#include "terrain/stacks/stack_source.h"
#include "terrain/void_fill.h"

namespace plumb::terrain {
namespace {

std::string extension_of(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// What can be said of a file without opening it. GDAL also knows names that are no file.
void check_file(const std::string& file, bool must_be_file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  const bool is_connection = file.find(':') != std::string::npos || file.starts_with("/vsi");
  if (!std::filesystem::exists(status)) {
    if (!must_be_file && is_connection) return;
    input_error("{}: there is no such file", file.empty() ? "''" : file);
  }
  if (std::filesystem::is_directory(status)) {
    if (must_be_file) input_error("{}: a folder, expected a file", file);
    return;
  }
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(file, ignored) == 0) {
    input_error("{}: the file is empty", file);
  }
}

// Every option but top_surface speaks of grids of heights.
void require_none_of_heights(const std::string& argument, const ReadOptions& options) {
  ReadOptions nothing_else;
  nothing_else.top_surface = options.top_surface;
  nothing_else.require_spacing = options.require_spacing;
  if (!(options == nothing_else))
    input_error("{}: a terrain of stacks is read as it is: only its top surface can be asked for",
                argument);
}

Heightfield with_stacks(StackField stacks, const ReadOptions& options) {
  Heightfield field = top_surface(stacks);
  if (options.top_surface) return field;
  field.provenance = stacks.provenance;
  field.stacks = std::make_shared<const StackField>(std::move(stacks));
  return field;
}

Heightfield read_file(const std::string& file, const ReadOptions& options) {
  const std::string extension = extension_of(file);
  const bool is_raw = extension == ".r16" || extension == ".r32";
  const bool is_image = extension == ".png" || extension == ".exr";
  check_file(file, is_raw || is_image);
  if (options.raw_size && !is_raw) {
    input_error("{}: --raw is the size of .r16 and .r32 files", file);
  }
  if (options.origin && (is_raw || is_image)) {
    input_error("{}: --origin is for .hgt files whose name does not state it", file);
  }
  Heightfield field = is_raw     ? read_raw(file, options)
                      : is_image ? read_image(file, options)
                                 : read_with_gdal(file, options);
  field.provenance.source = file;
  return field;
}

Heightfield cut(const Heightfield& whole, const Window& window) {
  Heightfield part;
  part.dx_m = whole.dx_m;
  part.dy_m = whole.dy_m;
  part.provenance = whole.provenance;
  part.provenance.window_x = window.x;
  part.provenance.window_y = window.y;
  const int south = whole.rows() - window.y - window.height;
  part.origin_m = whole.origin_m + glm::dvec2(window.x * whole.dx_m, south * whole.dy_m);
  Grid<float> heights_m(window.width, window.height);
  part.provenance.voids_declared = 0;
  for (int j = 0; j < window.height; ++j) {
    for (int i = 0; i < window.width; ++i) {
      heights_m(i, j) = whole.heights_m(window.x + i, south + j);
      part.provenance.voids_declared += std::isnan(heights_m(i, j)) ? 1 : 0;
    }
  }
  part.heights_m = std::move(heights_m);
  return part;
}

/// A generated terrain under the options that make sense for one.
Heightfield read_generated(const std::string& argument, const ReadOptions& options) {
  const auto refuse = [&](const char* option) {
    input_error("{}: {} is for files, not for a generated terrain", argument, option);
  };
  if (options.decode != Decode::Unspecified) refuse("--decode");
  if (options.band != 1) refuse("--band");
  if (options.no_data) refuse("--nodata");
  if (!options.crs.empty()) refuse("--crs");
  if (options.raw_size) refuse("--raw");
  if (options.origin) refuse("--origin (its own parameter is origin=X,Y)");
  if (options.spacing_x_m) refuse("--spacing (its own parameter is spacing=DX,DY)");
  if (options.height_scale != 1.0) refuse("--height-scale (its own parameter is relief)");
  if (options.height_offset_m != 0.0) refuse("--height-offset (its own parameter is height)");
  Heightfield field = generate(argument);
  if (!options.window) return field;
  const Window window = window_in(options, argument, field.columns(), field.rows());
  require_memory(argument, window.width, window.height, sizeof(float));
  return cut(field, window);
}

void apply_policy(Heightfield& field, const std::string& name, const ReadOptions& options) {
  if (options.no_data_policy != NoDataPolicy::Fill) return;
  require_memory(name, field.columns(), field.rows(), sizeof(int));
  if (bounds(field).empty()) {
    input_error("{}: every sample is void, there is nothing to fill from", name);
  }
  const std::int64_t filled = fill_voids(field);
  if (filled > 0) {
    field.provenance.assumptions.push_back(fmt::format(
        "{} void samples were filled with the height of the nearest sample that has one", filled));
  }
}

}  // namespace

Heightfield load_terrain(const std::string& argument, const ReadOptions& options) {
  check(options);
  try {
    const bool is_file_of_stacks = !is_generator(argument) && is_stack_file(argument);
    if (is_stack_generator(argument) || is_file_of_stacks) {
      require_none_of_heights(argument, options);
      return with_stacks(is_file_of_stacks ? read_stacks(argument) : generate_stacks(argument),
                         options);
    }
    if (options.top_surface && !is_generator(argument))
      input_error("{}: --surface is for terrains of stacks", argument);
    Heightfield field =
        is_generator(argument) ? read_generated(argument, options) : read_file(argument, options);
    apply_policy(field, argument, options);
    return field;
  } catch (const std::bad_alloc&) {
    input_error("{}: there is not enough memory for it", argument);
  }
}

}  // namespace plumb::terrain
