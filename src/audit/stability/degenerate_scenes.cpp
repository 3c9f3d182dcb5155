// Input that is hardly any, for every method: refused in one clear line, or drawn with claims that
// hold; never a crash, never a figure that is no number.
#include <cmath>
#include <limits>
#include <utility>

#include "audit/method.h"
#include "audit/stability/grounds.h"
#include "audit/stability/rough_ground.h"
#include "audit/stability/scene_lists.h"
#include "terrain/terrain_source.h"

namespace plumb::audit::stability {
namespace {

constexpr int kSize = 33;  // 320 m a side

double hills(int i, int j) { return rough_height(5, i, j, 60.0); }

std::vector<std::string> every_method() {
  std::vector<std::string> names;
  for (const Method& method : built_in_methods()) names.push_back(method.name);
  return names;
}

Scene degenerate(const std::string& name, const std::string& what,
                 std::function<terrain::Heightfield()> terrain,
                 const LookAt& camera = look({160, -120, 180}, {160, 160, 0}, 60.0)) {
  Scene scene;
  scene.name = name;
  scene.methods = every_method();
  scene.fails = what;
  scene.terrain = std::move(terrain);
  scene.camera = camera;
  scene.size = Tolerance{160.0, Unit::Pixel};
  scene.is_degenerate = true;
  scene.published = sound();
  scene.conservative = holds(Reading::Coverage, 0.0);
  return scene;
}

// Nothing of the terrain can be judged, and nothing is drawn.
Expected without_a_verdict() {
  Expected expected = strays(Reading::Coverage, 0.0, 0.0);
  expected.verdict = Verdict::None;
  return expected;
}

void expect_everywhere(Scene& scene, const Expected& expected) {
  scene.published = scene.conservative = expected;
}

// Heights as stacks move by a part of a voxel, here 10 m.
void find_of_stacks(Scene& scene) {
  scene.finding =
      "As stacks the ground is up to a voxel, 10 m, off its heights: for an eye as near that is "
      "more than the tolerance. As published nothing says so; the conservative variant does, "
      "claims what it reaches, and keeps it.";
}

void refuse_as_patches(Scene& scene, const std::string& why) {
  for (const char* method : {"tessellation", "chunked"}) scene.otherwise[method] = refused(why);
}

auto of(int columns, int rows, const std::function<double(int, int)>& height_m) {
  return [=] { return ground(columns, rows, 10.0, height_m); };
}

void add_sizes(std::vector<Scene>& scenes) {
  scenes.push_back(degenerate("one-sample", "A terrain of one sample has no triangle.",
                              of(1, 1, [](int, int) { return 5.0; }),
                              look({-20, -20, 30}, {0, 0, 5})));
  expect_everywhere(scenes.back(), without_a_verdict());
  refuse_as_patches(scenes.back(), "patches need 2 x 2 samples, the terrain has 1 x 1");
  scenes.push_back(degenerate("one-row", "A terrain of one row has no area.", of(kSize, 1, hills)));
  expect_everywhere(scenes.back(), without_a_verdict());
  refuse_as_patches(scenes.back(), "patches need 2 x 2 samples, the terrain has 33 x 1");
  scenes.push_back(degenerate("window-of-no-area", "A window of no columns is no terrain.", [] {
    terrain::ReadOptions options;
    options.window = terrain::Window{3, 3, 0, 5};
    return terrain::load_terrain("generate:alpine?size=33", options);
  }));
  expect_everywhere(scenes.back(), refused("window 3,3,0,5 is empty"));
}

void add_heights(std::vector<Scene>& scenes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  scenes.push_back(degenerate("all-equal", "A plain has no relief to divide by.",
                              of(kSize, kSize, [](int, int) { return 7.0; })));
  scenes.push_back(degenerate("all-void", "Nothing is known anywhere.",
                              of(kSize, kSize, [nan](int, int) { return nan; })));
  expect_everywhere(scenes.back(), without_a_verdict());
  scenes.back().otherwise["stacks"] = refused("a terrain without a height has no stacks");
  scenes.push_back(degenerate(
      "every-third-sample-void", "No triangle is whole but a few.",
      of(kSize, kSize, [nan](int i, int j) { return (i + j) % 3 == 0 ? nan : hills(i, j); })));
  scenes.push_back(
      degenerate("heights-of-1e30", "Differences of heights are beyond a float.",
                 of(kSize, kSize, [](int i, int j) { return (i + j) % 2 == 0 ? 1e30 : -1e30; })));
  expect_everywhere(scenes.back(), refused("must be finite and within 1e30 m of the eye"));
  scenes.back().otherwise["stacks"] = refused("too low for a relief of");
  scenes.push_back(degenerate("subnormal-heights", "Heights are below the least normal float.",
                              of(kSize, kSize, [](int i, int j) { return 1e-40 * hills(i, j); })));
  scenes.push_back(
      degenerate("infinite-height", "One sample is infinite.", of(kSize, kSize, [](int i, int j) {
                   return i == 5 && j == 6 ? std::numeric_limits<double>::infinity() : hills(i, j);
                 })));
  expect_everywhere(scenes.back(), refused("a height must be finite or NaN"));
  scenes.push_back(degenerate(
      "coordinates-of-1e9", "The terrain lies a million kilometres from zero.",
      [] {
        terrain::Heightfield field = ground(kSize, kSize, 10.0, hills);
        field.origin_m = {1e9, 1e9};
        return field;
      },
      look({1e9 + 160, 1e9 - 120, 180}, {1e9 + 160, 1e9 + 160, 0}, 60.0)));
}

void add_cameras(std::vector<Scene>& scenes) {
  const auto terrain = of(kSize, kSize, hills);
  const auto view = [&](const std::string& name, const std::string& what, const LookAt& camera) {
    scenes.push_back(degenerate(name, what, terrain, camera));
  };
  const double here_m = static_cast<float>(hills(16, 16));
  view("camera-in-the-rock", "The eye is a metre below the surface.",
       look({160, 160, here_m - 1.0}, {260, 160, here_m - 1.0}));
  find_of_stacks(scenes.back());
  for (const char* method : {"slicing", "hybrid-slicing"})
    scenes.back().otherwise[method] = without_a_verdict();
  view("camera-under-the-ground", "All of the terrain is above the eye.",
       look({160, 160, -300}, {160, 170, 0}));
  view("camera-on-a-vertex", "The eye is a vertex of the mesh.",
       look({160, 160, here_m}, {260, 200, here_m}, 50.0, 0.01));
  find_of_stacks(scenes.back());
  LookAt along = look({160, 170, 0}, {160, 180, 0}, 50.0, 0.01);
  along.eye_m.z = static_cast<float>(hills(16, 17));
  along.target_m.z = static_cast<float>(hills(16, 18));
  view("camera-along-an-edge", "The eye looks from a vertex straight along an edge.", along);
  find_of_stacks(scenes.back());
}

}  // namespace

std::vector<Scene> degenerate_scenes() {
  std::vector<Scene> scenes;
  add_sizes(scenes);
  add_heights(scenes);
  add_cameras(scenes);
  return scenes;
}

}  // namespace plumb::audit::stability
