// Ways of a camera that suit any terrain.
#pragma once

#include <string>
#include <vector>

#include "terrain/camera_presets.h"

namespace plumb::terrain {

/// Frames of a path whose number nobody says.
inline constexpr int kPathFrames = 60;

/// Every path, in the order in which help lists them.
const std::vector<PresetHelp>& path_preset_help();

/// False for a preset that is one camera, and for an unknown name.
bool is_path_preset(const std::string& name);

/// One camera of a path over a terrain, in world coordinates.
///
///   flyover  begins at the `oblique` view and flies level and straight ahead, in equal steps over
///            half of the ground before it, looking the same way all along
///   zoom     begins at the `oblique` view and nears its target on the line of sight until half of
///            the distance is left, in each frame by the same factor
///
/// frame   1..frames
/// frames  1..100000; of one alone the first is meant
/// width_px, height_px and fov_y_deg are those of preset_camera, and near_m is chosen as there.
///
///   (1) The same terrain, picture and number give the same camera, on any number of threads.
///   (2) The eye never comes below the ground.
///   (3) The ends of a path do not depend on how many frames lie between them.
/// Throws InputError that lists the known names for an unknown one, std::invalid_argument for
/// numbers out of range and a picture that make_camera would refuse.
LookAt path_preset_camera(const Heightfield& field, const std::string& name, int frame, int frames,
                          int width_px, int height_px, double fov_y_deg);

}  // namespace plumb::terrain
