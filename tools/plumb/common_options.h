// Options that several subcommands share, with one wording.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "audit/camera_file.h"
#include "core/camera.h"
#include "options.h"
#include "terrain/heightfield.h"
#include "terrain/read_options.h"

namespace plumb::tool {

/// The terrain, and how it is to be read.
struct TerrainOptions {
  std::string terrain;
  std::string window, spacing, decode, origin, crs, raw_size, byte_order, no_data_policy, surface;
  int band = 1;
  double height_scale = 1.0;
  double height_offset_m = 0.0;
  std::optional<double> no_data;
  std::string diagonal = "alternating";

  friend bool operator==(const TerrainOptions&, const TerrainOptions&) = default;
};

/// Declares TERRAIN and the options that speak of it; `with_diagonal` where the command cuts cells
/// into triangles, `needs_terrain` where TERRAIN must be given.
void add_terrain_options(Options& options, TerrainOptions& terrain, bool with_diagonal = true,
                         bool needs_terrain = true);
/// Throws InputError for what cannot be read.
terrain::ReadOptions read_options(const TerrainOptions& options);
/// Reads the terrain. Throws InputError; with `require_spacing`, for a terrain without spacing too.
terrain::Heightfield load(const TerrainOptions& options, bool require_spacing = true);

struct CameraOptions {
  std::string camera = "oblique";
  std::string size;  // "WxH"; empty: the camera file's, or 1920x1080
  std::optional<double> fov_y_deg;
  std::optional<double> tilt_deg = std::nullopt;
  int frame = 0;   // of a path, from 1; 0: not said
  int frames = 0;  // of a preset that is a path; 0: not said

  friend bool operator==(const CameraOptions&, const CameraOptions&) = default;
};

void add_camera_options(Options& options, CameraOptions& camera);
/// Every camera that the options mean, as far as they say it: one, or those of a path. --size and
/// --fov go before what a camera file says, --frame chooses one of a path. Throws InputError.
std::vector<audit::CameraDescription> camera_frames(const CameraOptions& options);
/// The one camera that the options mean; a path without --frame is an error. As far as the options
/// say it: --size and --fov go before what a camera file says. Throws InputError.
audit::CameraDescription camera_description(const CameraOptions& options);
/// The camera meant for this terrain: --size and --fov go before what a camera file says. Throws
/// InputError.
audit::PlacedCamera placed_camera(const CameraOptions& options, const terrain::Heightfield& field);

/// "frame_0001", for the file names of a path's frames, from 1.
std::string frame_name(std::size_t frame);

/// --threads: 0 leaves the choice to the machine.
void add_threads_option(Options& options, int& threads);
/// --json: one JSON object on standard output in place of the table.
void add_json_option(Options& options, bool& json);
/// -o, --output.
void add_output_option(Options& options, std::string& output, const std::string& help);

/// --drape.
void add_drape_option(Options& options, std::string& drape);

/// "1920x1080". Throws InputError unless both are whole numbers from 1 to 65536.
struct ImageSize {
  int width_px = 0, height_px = 0;
};
ImageSize parse_size(const std::string& text);

/// "X,Y,Z", three finite numbers. Throws InputError that names the option.
glm::dvec3 parse_point(const std::string& text, const std::string& option);

}  // namespace plumb::tool
