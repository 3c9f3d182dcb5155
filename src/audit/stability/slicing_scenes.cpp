// Where slicing fails [Röttger & Ertl 2001].
#include <cmath>

#include "audit/stability/grounds.h"
#include "audit/stability/rough_ground.h"
#include "audit/stability/scene_lists.h"

namespace plumb::audit::stability {
namespace {

constexpr int kSize = 129;
constexpr double kSpacing_m = 10.0, kMiddle_m = 640.0;

std::function<terrain::Heightfield()> of(const std::function<double(int, int)>& height_m) {
  return [=] { return ground(kSize, kSize, kSpacing_m, height_m); };
}

double hills(int i, int j) { return rough_height(5, i, j, 120.0); }

double towers(int i, int j) { return i % 8 == 4 && j % 8 == 4 ? 60.0 : 0.01 * i; }

double peaks(int i, int j) { return i % 4 == 0 && j % 4 == 0 ? 60.0 : 0.0; }

Scene slices(const std::string& name, const std::string& fails,
             std::function<terrain::Heightfield()> terrain, const LookAt& camera,
             double least_px = 1.0) {
  Scene scene;
  scene.name = name;
  scene.methods = {"slicing"};
  scene.fails = fails;
  scene.terrain = std::move(terrain);
  scene.camera = camera;
  scene.published = breaks(Reading::PixelError, least_px);
  scene.conservative = holds(Reading::PixelError, 1.0);
  return scene;
}

void not_shown(Scene& scene, const char* why) {
  scene.published = holds(Reading::PixelError, 1.0);
  scene.finding = why;
}

const char* kDescends =
    "By the article's own rule a box that meets the near plane or a side of the frustum is "
    "descended "
    "from, and as a leaf drawn as polygons: no box that holds the eye or crosses the plane is "
    "sliced.";

// Along the borders of boxes and of the picture.
void add_views(std::vector<Scene>& scenes) {
  scenes.push_back(
      slices("box-around-the-camera",
             "No distance to a box is one where the eye stands in it: spacing goes by its corners.",
             of(hills), look({643, 645, 105}, {743, 705, 105})));
  not_shown(scenes.back(), kDescends);
  scenes.push_back(slices("near-plane-crossing",
                          "Boxes reach across the near plane, where lengths on screen have no end.",
                          of(hills), look({100, 100, 180}, {700, 700, 40}, 60.0, 150.0)));
  not_shown(scenes.back(), kDescends);
  scenes.push_back(slices(
      "grazing-over-a-plain",
      "Hardly any height makes hardly any slices: seen along themselves, there are holes between "
      "the bundles.",
      of([](int i, int j) { return rough_height(6, i, j, 0.05); }),
      look({kMiddle_m, 30, 12}, {kMiddle_m, 1200, 0}, 30.0)));
  not_shown(
      scenes.back(),
      "The article's own border, a pixel wide, closes them here, at many times the fragments; "
      "without it (grazing-without-borders) they are there.");
  scenes.push_back(slices("switch-at-45-degrees",
                          "Bundles across two axes stand side by side, spaced by different rules.",
                          of(hills), look({kMiddle_m, -300, 900}, {kMiddle_m, 600, 0}, 40.0)));
  scenes.back().published = breaks(Reading::Coverage, 30);
  scenes.back().conservative = holds(Reading::Coverage, 0);
  scenes.push_back(slices("wide-field-of-view",
                          "Towards the picture's corners a length spans up to 1/cos^2 of the angle "
                          "more than distance says.",
                          of(hills), look({kMiddle_m, 200, 260}, {kMiddle_m, 700, 0}, 110.0), 1.8));
  scenes.push_back(slices(
      "above-a-large-box",
      "The least distance over a box's eight corners is no lower bound: its top face is nearer.",
      [] { return ground(65, 65, kSpacing_m, hills); }, look({320, 320, 450}, {320, 321, 0}, 90.0),
      1.5));
  scenes.back().parameters = {{"leaf_cells", "64"}};
}

void add_grounds(std::vector<Scene>& scenes) {
  scenes.push_back(slices("vertical-walls",
                          "A ray runs through solid ground between two planes, and what it meets "
                          "lies deep within the wall.",
                          of([](int i, int j) { return (i / 9 + j / 11) % 2 != 0 ? 80.0 : 0.0; }),
                          look({-200, -300, 400}, {700, 700, 0}), 9));
  scenes.push_back(slices("tower-thinner-than-the-spacing",
                          "All of a tower has room between two planes.", of(towers),
                          look({-600, -500, 320}, {700, 700, 0}, 40.0), 5));
  scenes.push_back(slices("wall-thinner-than-the-spacing",
                          "All of a wall has room between two planes.",
                          of([](int i, int j) { return i % 16 == 9 ? 70.0 : 0.01 * j; }),
                          look({kMiddle_m, -700, 340}, {kMiddle_m + 60, 700, 0}, 40.0), 2.5));
  scenes.push_back(slices("slice-at-a-plateaus-height",
                          "A plane passes through a whole plateau, and rounding puts it on either "
                          "side.",
                          of([](int i, int j) { return 16.0 * ((i / 12 + j / 10) % 5); }),
                          look({-200, 400, 500}, {700, 700, 0}), 9));
  scenes.push_back(slices(
      "bundles-of-different-spacing",
      "Neighbouring bundles have different numbers of planes, and none of one "
      "lies in one of the other.",
      of([](int i, int j) { return (i / 16) % 2 != 0 ? rough_height(7, i, j, 90.0) : 20.0; }),
      look({-150, -250, 350}, {700, 700, 20}), 2.8));
  scenes.push_back(slices("leaves-a-box-inside-the-ground",
                          "A ray leaves a box inside the ground without having met a plane, and "
                          "nothing closes the box.",
                          of([](int i, int j) { return 60.0 - 12.0 * (i % 8) + 0.2 * j; }),
                          look({-300, 200, 260}, {700, 700, 0}, 45.0), 7));
}

void add_look_ups(std::vector<Scene>& scenes) {
  scenes.push_back(slices("mip-mapped-heights",
                          "Averages keep no bound: peaks a sample wide are "
                          "lower the farther away they are.",
                          of(peaks), look({kMiddle_m, -9000, 900}, {kMiddle_m, kMiddle_m, 0}, 10.0),
                          1.8));
  scenes.back().parameters = {{"heights", "mip-mapped"}};
  scenes.back().conservative = strays(Reading::PixelError, 1.0);
  scenes.push_back(slices("eight-bits-of-alpha",
                          "A terrain 2000 m high is cut into 255 steps of 7.8 m, whatever the "
                          "number of slices.",
                          of([](int i, int j) { return rough_height(5, i, j, 2000.0); }),
                          look({kMiddle_m, -900, 2200}, {kMiddle_m, kMiddle_m, 800}, 50.0), 18));
  scenes.back().parameters = {{"heights", "eight-bit"}};
  scenes.back().conservative = strays(Reading::PixelError, 1.0);
  scenes.push_back(slices("grazing-without-borders",
                          "Without its border of a pixel a bundle ends where its box does, and "
                          "rays pass between two of them.",
                          of([](int i, int j) { return rough_height(6, i, j, 0.05); }),
                          look({kMiddle_m, 30, 12}, {kMiddle_m, 1200, 0}, 30.0)));
  scenes.back().parameters = {{"borders", "off"}};
  scenes.back().published = breaks(Reading::Coverage, 400);
  scenes.back().conservative = holds(Reading::Coverage, 0);
}

}  // namespace

std::vector<Scene> slicing_scenes() {
  std::vector<Scene> scenes;
  add_views(scenes);
  add_grounds(scenes);
  add_look_ups(scenes);
  return scenes;
}

}  // namespace plumb::audit::stability
