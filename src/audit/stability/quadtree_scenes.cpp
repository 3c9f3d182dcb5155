// Where triangulations of restricted quadtrees fail [Intel sample 2012; Pajarola 1998; Lindstrom et
// al. 1996].
#include "audit/stability/grounds.h"
#include "audit/stability/rough_ground.h"
#include "audit/stability/scene_lists.h"

namespace plumb::audit::stability {
namespace {

Scene quadtree(const std::string& name, const std::string& fails,
               std::function<terrain::Heightfield()> terrain, const LookAt& camera,
               const Tolerance& tolerance = {}) {
  Scene scene;
  scene.name = name;
  scene.methods = {"restricted-quadtree"};
  scene.fails = fails;
  scene.terrain = std::move(terrain);
  scene.camera = camera;
  scene.tolerance = tolerance;
  scene.conservative = holds(Reading::SampleError, tolerance.value);
  return scene;
}

auto of(int columns, int rows, double spacing_m, const std::function<double(int, int)>& height_m) {
  return [=] { return ground(columns, rows, spacing_m, height_m); };
}

}  // namespace

std::vector<Scene> quadtree_scenes() {
  std::vector<Scene> scenes;
  const LookAt over = look({160, -120, 180}, {160, 160, 0}, 60.0);
  scenes.push_back(quadtree(
      "spike-at-an-odd-vertex", "One spike at a finest odd vertex forces a cascade of splits.",
      of(33, 33, 10.0, [](int i, int j) { return i == 15 && j == 15 ? 30.0 : 0.0; }), over));
  scenes.back().conservative = strays(Reading::Triangles, 8, 100);
  return scenes;
}

}  // namespace plumb::audit::stability
