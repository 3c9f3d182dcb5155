#include "audit/stability/failure_scene.h"

#include <iterator>
#include <utility>

#include "audit/stability/scene_lists.h"
#include "core/check.h"

namespace plumb::audit::stability {

const char* name_of(Reading reading) {
  switch (reading) {
    case Reading::PixelError:
      return "pixel-error";
    case Reading::SampleError:
      return "sample-error";
    case Reading::SurfaceError:
      return "surface-error";
    case Reading::NearestError:
      return "nearest-error";
    case Reading::Coverage:
      return "coverage";
    case Reading::OpenEdges:
      return "open-edges";
    case Reading::TJunctions:
      return "t-junctions";
    case Reading::NonManifold:
      return "non-manifold";
    case Reading::Folded:
      return "folded";
    case Reading::LevelJump:
      return "level-jump";
    case Reading::Triangles:
      return "triangles";
    case Reading::TopError:
      return "top-error";
    case Reading::ColourError:
      return "colour-error";
  }
  return "";
}

Unit unit_of(Reading reading, Unit asked) {
  switch (reading) {
    case Reading::PixelError:
    case Reading::NearestError:
      return Unit::Pixel;
    case Reading::SampleError:
    case Reading::SurfaceError:
      return asked;
    case Reading::TopError:
      return Unit::Metre;
    default:
      return Unit::Count;
  }
}

Expected holds(Reading reading, double most) { return {Verdict::Held, reading, 0.0, most}; }

Expected breaks(Reading reading, double least) { return {Verdict::Broken, reading, least}; }

Expected strays(Reading reading, double least, double most) {
  return {Verdict::Held, reading, least, most};
}

Expected refused(const std::string& text) {
  Expected expected;
  expected.refusal = text;
  return expected;
}

Expected sound() { return {}; }

const std::vector<Scene>& failure_scenes() {
  static const std::vector<Scene> kScenes = [] {
    std::vector<Scene> all;
    for (std::vector<Scene> part : {slicing_scenes(), tessellation_scenes(), quadtree_scenes(),
                                    stack_scenes(), degenerate_scenes()})
      all.insert(all.end(), std::make_move_iterator(part.begin()),
                 std::make_move_iterator(part.end()));
    return all;
  }();
  return kScenes;
}

const Scene& find_scene(const std::string& name) {
  std::string known;
  for (const Scene& scene : failure_scenes()) {
    if (scene.name == name) return scene;
    known += (known.empty() ? "" : ", ") + scene.name;
  }
  input_error("scene '{}': expected one of {}", name, known);
}

}  // namespace plumb::audit::stability
