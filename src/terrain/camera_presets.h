// Views that suit any terrain.
#pragma once

#include <string>
#include <vector>

#include "core/camera.h"
#include "terrain/heightfield.h"

namespace plumb::terrain {

struct PresetHelp {
  std::string name;
  std::string meaning;
};

/// Every preset, in the order in which help lists them.
const std::vector<PresetHelp>& preset_help();

/// A good view of a terrain, in world coordinates.
///
///   oblique  from above a border or a corner across the terrain, the sky in the upper part
///   top      from straight above, north up, all samples that are not void in the picture
///   grazing  2 m (a tenth of a spacing, if that is more) above the ground where the view is far
///   valley   from a low between high ground, along it
///
/// width_px, height_px and fov_y_deg are those of the picture that is to be made: how much fits in
/// depends on them. near_m is a tenth of the eye's height above the ground (top: above the highest
/// sample), at least 0.01; far_m is infinite.
///
///   (1) The same terrain and picture give the same camera, on any number of threads.
///   (2) The eye stands above the ground, and never over a void (top excepted), if there is a
///       cell to stand on; without any it looks down at a sample from beside and above.
///   (3) The ray through the picture's middle meets the ground, if there is a cell.
///   (4) Moving the terrain's origin moves eye and target with it.
/// Throws InputError that lists the known names for an unknown one, std::invalid_argument for a
/// picture that make_camera would refuse.
LookAt preset_camera(const Heightfield& field, const std::string& name, int width_px, int height_px,
                     double fov_y_deg);

}  // namespace plumb::terrain
