// Cameras as people write them down: in a TOML file, or as numbers.
#pragma once

#include <glm/vec3.hpp>

#include <optional>
#include <string>

#include "audit/toml_document.h"
#include "core/camera.h"
#include "core/engine_camera.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// A camera, as far as it was written down.
struct CameraDescription {
  std::string preset = "";                   // a preset's name, or empty
  std::optional<int> frame = std::nullopt;   // of a preset that is a path: which one, from 1,
  std::optional<int> frames = std::nullopt;  // and of how many; terrain::kPathFrames if not said
  std::optional<glm::dvec3> eye_m = std::nullopt;  // world coordinates, as of the terrain's file
  std::optional<glm::dvec3> target_m = std::nullopt;
  std::optional<glm::dvec3> up = std::nullopt;
  std::optional<double> fov_y_deg = std::nullopt;
  std::optional<int> width_px = std::nullopt;
  std::optional<int> height_px = std::nullopt;
  std::optional<double> near_m = std::nullopt;
  std::optional<double> far_m = std::nullopt;
  std::optional<double> tilt_deg = std::nullopt;      // of the terrain: see turned_for_tilt
  std::optional<EngineCamera> engine = std::nullopt;  // its matrices, in place of all above but
                                                      // size, near and far

  friend bool operator==(const CameraDescription&, const CameraDescription&) = default;
};

/// Reads a TOML file with the keys eye, target, up (each [x, y, z]), fov_y_deg, width, height,
/// near, far, tilt_deg; or preset = "NAME" in place of eye, target and up, with frame and frames
/// where that is a path; or, as an engine has
/// them, view and projection (each sixteen numbers) with layout = "column-major" | "row-major",
/// vectors = "column" | "row", clip = "opengl" | "d3d" | "vulkan", reverse_z, world_axes = "x,y,z"
/// (those that point east, north and up), metres_per_unit, origin = [x, y, z]. All but eye and
/// target, or view and projection, may be left out. Throws InputError, one line with the file and
/// the place in it, for anything else: an unknown key is an error that names the known ones.
CameraDescription read_camera_file(const std::string& path);

/// The same from the text of such a file; `name` stands for it in messages.
CameraDescription parse_camera_toml(const std::string& text, const std::string& name);

/// The same from a table of a larger file, [camera] of a scene.
CameraDescription camera_in(const TomlTable& table, const std::string& name);

/// The same from an inline table, "{ eye = [1, 2, 3], target = [4, 5, 6] }", as the command line
/// takes it.
CameraDescription parse_inline_camera(const std::string& text);

/// Six or seven numbers: "ex,ey,ez,tx,ty,tz[,fov_y_deg]". Nothing if the text does not look like a
/// list of numbers (is a name); throws InputError if it does and is not six or seven of them.
std::optional<CameraDescription> parse_camera_numbers(const std::string& text);

/// The camera that a description means for this terrain: what it leaves open has LookAt's values,
/// or the preset's. Throws InputError for an unknown preset, and for values that are no camera (eye
/// on target, a field of view outside (0, 180), a size outside 1..65536, near <= 0, far <= near, a
/// tilt outside -180..180).
LookAt resolve_camera(const CameraDescription& description, const terrain::Heightfield& field);

/// The camera that sees the level terrain as `camera` would see it tilted by `tilt_deg` about the
/// line from west to east through the middle of its box, the north side up: 0 lies, 90 stands like
/// a wall. What is seen of a tilted displacement map is what the camera, turned the other way, sees
/// of a terrain, so that every measure and bound means the same.
LookAt turned_for_tilt(LookAt camera, double tilt_deg, const terrain::Heightfield& field);

/// A camera, and every value of it as a camera file has it: reading that gives the same camera.
struct PlacedCamera {
  Camera camera;
  CameraDescription description;
};

/// As resolve_camera, and from an engine's matrices as well, whose errors name the property that
/// fails.
PlacedCamera place_camera(const CameraDescription& description, const terrain::Heightfield& field);

}  // namespace plumb::audit
