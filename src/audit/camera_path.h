// A way through a terrain: a list of cameras, written down one by one or between keys.
#pragma once

#include <string>
#include <vector>

#include "audit/camera_file.h"

namespace plumb::audit {

/// The cameras that a description means, in their order: the frames of a preset that is a path
/// (terrain/path_presets.h) unless one of them is chosen; else the camera itself.
std::vector<CameraDescription> frames_of(const CameraDescription& description);

/// The cameras of a file, in their order: those that a camera file means; one for each [[camera]]
/// of a list;
/// or, for a fly-over,
///
///   [path]
///   frames = 120          # 1 to 100000, the first and the last key's among them
///   width = 1280          # and height, near, far, up, fov_y_deg: of all frames
///   [[key]]
///   eye = [x, y, z]       # two keys or more; eye and target run through them on a curve
///   target = [x, y, z]
///
///   (1) Frames stand at equal steps of the curve's parameter; where a step falls on a key, eye and
///       target are the key's, to the bit.
///   (2) Between two keys alone, the way is straight.
/// The curve is a Catmull-Rom spline with its end points doubled: it passes through every key, with
/// a direction that does not jump. Throws InputError as read_camera_file does.
std::vector<CameraDescription> read_camera_path(const std::string& path);

/// The same from the text of such a file; `name` stands for it in messages.
std::vector<CameraDescription> parse_camera_path(const std::string& text, const std::string& name);

}  // namespace plumb::audit
