#include "common_options.h"

#include <cmath>
#include <filesystem>
#include <string_view>

#include "audit/camera_path.h"
#include "core/check.h"
#include "core/number_text.h"
#include "terrain/camera_presets.h"
#include "terrain/path_presets.h"
#include "terrain/terrain_source.h"

namespace plumb::tool {

void add_terrain_options(Options& options, TerrainOptions& terrain, bool with_diagonal,
                         bool needs_terrain) {
  const char* const help = "An elevation file, or a generator: 'generate:alpine?size=2049&seed=7'";
  needs_terrain ? options.argument(terrain.terrain, "TERRAIN", help)
                : options.optional_argument(terrain.terrain, "TERRAIN", help);
  options.group("Terrain");
  options.text(terrain.window, "--window", "X,Y,W,H",
               "Only this part, in the file's columns and rows from its top left");
  options.text(terrain.spacing, "--spacing", "DX[,DY]",
               "Metres between samples, in place of what the file says");
  options.integer(terrain.band, "--band", "N", "Band of the file (1)", 1, 65535);
  options.choice(terrain.decode, "--decode", {"grey", "terrain-rgb", "terrarium"},
                 "What the channels of an image mean");
  options.number(terrain.height_scale, "--height-scale", "FACTOR", "Metres per stored unit (1)");
  options.number(terrain.height_offset_m, "--height-offset", "M",
                 "Metres added to every height (0)");
  options.number(terrain.no_data, "--nodata", "V", "A stored value that means: no height here");
  options.choice(terrain.no_data_policy, "--no-data", {"hole", "fill"},
                 "What stands where there is no height (hole)");
  options.text(terrain.origin, "--origin", "LON,LAT",
               "Degrees of the south-west sample of an .hgt file whose name does not state it");
  options.text(terrain.crs, "--crs", "EPSG:N", "Reproject into this system first");
  options.text(terrain.raw_size, "--raw", "WxH", "Size of a .r16 or .r32 file");
  options.choice(terrain.byte_order, "--byte-order", {"little", "big"},
                 "Byte order of a .r16 or .r32 file (little)");
  options.choice(terrain.surface, "--surface", {"stacks", "top"},
                 "Of a terrain of stacks: all of it, or the heights of its top surface (stacks)");
  if (with_diagonal) {
    options.choice(terrain.diagonal, "--diagonal", {"alternating", "fixed", "blocks:8"},
                   "Which diagonal cuts a cell of the full-detail surface (alternating)");
  }
}

terrain::ReadOptions read_options(const TerrainOptions& options) {
  terrain::ReadOptions read;
  if (!options.window.empty()) read.window = terrain::parse_window(options.window);
  if (!options.spacing.empty()) {
    const terrain::Spacing spacing = terrain::parse_spacing(options.spacing);
    read.spacing_x_m = spacing.x_m;
    read.spacing_y_m = spacing.y_m;
  }
  read.band = options.band;
  if (!options.decode.empty()) read.decode = terrain::parse_decode(options.decode);
  read.height_scale = options.height_scale;
  read.height_offset_m = options.height_offset_m;
  read.no_data = options.no_data;
  if (!options.no_data_policy.empty())
    read.no_data_policy = terrain::parse_no_data_policy(options.no_data_policy);
  if (!options.origin.empty()) read.origin = terrain::parse_origin(options.origin);
  read.crs = options.crs;
  if (!options.raw_size.empty()) read.raw_size = terrain::parse_raw_size(options.raw_size);
  read.top_surface = !options.surface.empty() && terrain::parse_surface(options.surface);
  if (!options.byte_order.empty()) read.byte_order = terrain::parse_byte_order(options.byte_order);
  return read;
}

terrain::Heightfield load(const TerrainOptions& options, bool require_spacing) {
  terrain::ReadOptions read = read_options(options);
  read.require_spacing = require_spacing;
  return terrain::load_terrain(options.terrain, read);
}

void add_camera_options(Options& options, CameraOptions& camera) {
  std::string presets;
  for (const terrain::PresetHelp& preset : terrain::preset_help())
    presets += (presets.empty() ? "" : ", ") + preset.name;
  for (const terrain::PresetHelp& path : terrain::path_preset_help()) presets += ", " + path.name;
  options.group("Camera");
  options.text(camera.camera, "--camera", "CAMERA",
               "A preset (" + presets +
                   "), a TOML file (a camera, or a path of them), such a camera as an inline table "
                   "'{ ... }', or the numbers ex,ey,ez,tx,ty,tz[,fov] (oblique)");
  options.text(camera.size, "--size", "WxH", "Size of the image in pixels (1920x1080)");
  options.number(camera.fov_y_deg, "--fov", "DEG", "Vertical field of view (50)");
  options.number(camera.tilt_deg, "--tilt", "DEG",
                 "Tilt the terrain, its north side up, as a displacement map (0; 90 stands)");
  options.integer(camera.frame, "--frame", "K", "This camera of a path alone, from 1", 1, 100000);
  options.integer(camera.frames, "--frames", "N",
                  fmt::format("How many frames flyover and zoom have ({})", terrain::kPathFrames),
                  1, 100000);
}

namespace {

std::vector<audit::CameraDescription> cameras_meant(const std::string& text, int frames) {
  if (frames > 0 && !terrain::is_path_preset(text))
    input_error("--frames {}: it goes with the paths flyover and zoom, not with '{}'", frames,
                text);
  std::error_code ignored;
  if (text.starts_with("{")) return {audit::parse_inline_camera(text)};
  if (text.ends_with(".toml") || std::filesystem::is_regular_file(text, ignored))
    return audit::read_camera_path(text);
  if (const auto numbers = audit::parse_camera_numbers(text)) return {*numbers};
  audit::CameraDescription camera;
  camera.preset = text;
  if (frames > 0) camera.frames = frames;
  return audit::frames_of(camera);
}

}  // namespace

std::vector<audit::CameraDescription> camera_frames(const CameraOptions& options) {
  std::vector<audit::CameraDescription> frames = cameras_meant(options.camera, options.frames);
  if (options.frame > static_cast<int>(frames.size()))
    input_error("--frame {}: '{}' has {} camera{}", options.frame, options.camera, frames.size(),
                frames.size() == 1 ? "" : "s");
  if (options.frame > 0) frames = {frames[static_cast<std::size_t>(options.frame) - 1]};
  for (audit::CameraDescription& camera : frames) {
    if (!options.size.empty()) {
      const ImageSize size = parse_size(options.size);
      camera.width_px = size.width_px;
      camera.height_px = size.height_px;
    }
    if (options.fov_y_deg) camera.fov_y_deg = options.fov_y_deg;
    if (options.tilt_deg) camera.tilt_deg = options.tilt_deg;
  }
  return frames;
}

audit::CameraDescription camera_description(const CameraOptions& options) {
  const std::vector<audit::CameraDescription> frames = camera_frames(options);
  if (frames.size() != 1)
    input_error("'{}' is a path of {} cameras: choose one with --frame", options.camera,
                frames.size());
  return frames.front();
}

std::string frame_name(std::size_t frame) { return fmt::format("frame_{:04}", frame); }

audit::PlacedCamera placed_camera(const CameraOptions& options, const terrain::Heightfield& field) {
  return audit::place_camera(camera_description(options), field);
}

void add_threads_option(Options& options, int& threads) {
  options.integer(threads, "--threads", "N", "Threads to use (all)", 1, 65536);
}

void add_json_option(Options& options, bool& json) {
  options.flag(json, "--json", "Print one JSON object in place of the table");
}

void add_output_option(Options& options, std::string& output, const std::string& help) {
  options.text(output, "-o,--output", "PATH", help);
}

void add_drape_option(Options& options, std::string& drape) {
  options.text(drape, "--drape", "PICTURE",
               "Lay this picture over the whole terrain, its top side in the north, in place of "
               "height colours");
}

ImageSize parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos) {
    const auto width = parse_integer(std::string_view(text).substr(0, cross));
    const auto height = parse_integer(std::string_view(text).substr(cross + 1));
    if (width && height && *width >= 1 && *width <= 65536 && *height >= 1 && *height <= 65536)
      return {static_cast<int>(*width), static_cast<int>(*height)};
  }
  input_error("size '{}': expected WIDTHxHEIGHT in pixels, each from 1 to 65536", text);
}

glm::dvec3 parse_point(const std::string& text, const std::string& option) {
  glm::dvec3 point{0.0};
  std::size_t begin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t end = axis < 2 ? text.find(',', begin) : text.size();
    const auto value = end == std::string::npos
                           ? std::nullopt
                           : parse_number(std::string_view(text).substr(begin, end - begin));
    if (!value || !std::isfinite(*value))
      input_error("{} '{}': expected three numbers, X,Y,Z", option, text);
    point[axis] = *value;
    begin = end + 1;
  }
  return point;
}

}  // namespace plumb::tool
