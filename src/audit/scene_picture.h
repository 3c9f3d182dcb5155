// A scene, drawn.
#pragma once

#include <functional>
#include <string>

#include "audit/method.h"
#include "audit/scene.h"
#include "core/camera.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"
#include "image/aov_image.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

struct SceneTimes {
  double read_s = 0.0, prepare_s = 0.0, draw_s = 0.0, picture_s = 0.0;
};

struct DrawnScene {
  Scene scene;  // as it was drawn: every default by name, the camera in numbers
  terrain::Heightfield field;
  Camera camera;
  DrawnSurface surface;  // without a mesh where the truth was drawn; cost.fragments is filled in
  HitImage hits;
  image::AovImage picture;  // draw_picture or draw_truth_picture; its header holds `scene`
  SceneTimes times;
};

/// Called with what is done next, for people who wait.
using StepListener = std::function<void(const std::string&)>;

/// Reads the terrain, draws the scene by a method of the table, or by rays, and makes its picture.
///
///   (1) Drawing the `scene` of the result gives the same picture, bit for bit, header included.
///   (2) Same bits on any number of threads, `times` apart.
/// Throws InputError for a terrain that cannot be read, a camera that is none, a method, variant,
/// parameter or unit of tolerance that is not there, and for what does not fit into memory.
DrawnScene draw_scene(const Scene& scene, const MethodTable& table,
                      const std::string& program_version, const StepListener& on_step = {});

/// The same on a terrain that has been read as scene.read says; its time is left out.
DrawnScene draw_scene_on(terrain::Heightfield field, const Scene& scene, const MethodTable& table,
                         const std::string& program_version, const StepListener& on_step = {});

}  // namespace plumb::audit
