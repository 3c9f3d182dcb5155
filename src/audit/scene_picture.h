// A scene, drawn.
#pragma once

#include <functional>
#include <memory>
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
  std::shared_ptr<const terrain::Heightfield> field;
  Camera camera;
  DrawnSurface surface;  // without a mesh where the truth was drawn; cost.fragments is filled in
  HitImage hits;
  image::AovImage picture;  // draw_picture or draw_truth_picture; its header holds `scene`.
                            // The truth of a terrain of stacks is drawn as a mesh is
  SceneTimes times;         // prepare_s is that of the drawer, the same for all its pictures
};

/// Called with what is done next, for people who wait.
using StepListener = std::function<void(const std::string&)>;

/// Draws one scene's terrain, by a method of the table or by rays, for as many cameras as wanted:
/// what a method makes of the terrain is made once.
///
///   (1) Drawing the `scene` of a result gives the same picture, bit for bit, header included.
///   (2) Same bits on any number of threads and whatever was drawn before, `times` apart.
class SceneDrawer {
 public:
  /// field  the terrain, read as scene.read says
  /// Keeps a reference to the table. Throws InputError for a method, a diagonal, a variant, a
  /// parameter or a drape that is not there.
  SceneDrawer(terrain::Heightfield field, Scene scene, const MethodTable& table,
              std::string program_version);
  ~SceneDrawer();

  /// Prepares the method when it is called first. Throws InputError for a camera that is none, a
  /// variant, parameter or unit of tolerance that is not there, and for what does not fit into
  /// memory.
  DrawnScene draw(const CameraDescription& camera, const StepListener& on_step = {});

 private:
  struct Painter;
  void prepare();

  std::shared_ptr<const terrain::Heightfield> field_;
  Scene scene_;
  const MethodTable& table_;
  const Method* method_;  // null where rays draw without one
  terrain::Diagonal diagonal_;
  std::string program_version_;
  std::unique_ptr<const image::ColourImage> drape_;  // null where the scene has none
  std::unique_ptr<const Painter> painter_;
  double prepare_s_ = 0.0;
};

/// Reads the terrain and draws the scene from its own camera. Throws InputError as SceneDrawer
/// does, and for a terrain that cannot be read.
DrawnScene draw_scene(const Scene& scene, const MethodTable& table,
                      const std::string& program_version, const StepListener& on_step = {});

}  // namespace plumb::audit
