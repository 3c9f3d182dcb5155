// Where stacks of material and their contours fail [Löffler, Müller & Schumann 2011].
#include <cmath>
#include <memory>
#include <utility>

#include "audit/stability/grounds.h"
#include "audit/stability/rough_ground.h"
#include "audit/stability/scene_lists.h"
#include "terrain/stacks/stack_field.h"
#include "terrain/terrain_source.h"

namespace plumb::audit::stability {
namespace {

using terrain::Layer;
using Layers = std::vector<Layer>;
using Terrain = std::function<terrain::Heightfield()>;

constexpr terrain::Material kRock = 1, kSand = 2;
constexpr Tolerance kPaperSize{160.0, Unit::Pixel};  // 10 px a cell

Terrain of(int side, int high, const std::function<Layers(int, int)>& layers) {
  return [=] { return stacks(side, side, high, layers); };
}

// From near by, so that the finest level is drawn.
Scene near_by(const std::string& name, const std::string& fails, Terrain terrain,
              const Expected& published, const Expected& conservative,
              const std::string& radius = "1") {
  Scene scene;
  scene.name = name;
  scene.methods = {"stacks"};
  scene.fails = fails;
  scene.terrain = std::move(terrain);
  scene.camera = look({-14, -18, 30}, {9, 9, 5}, 30.0);
  scene.parameters = {{"radius", radius}};
  scene.size = kPaperSize;
  scene.published = published;
  scene.conservative = conservative;
  return scene;
}

// From so far that the published variant draws a coarse level.
Scene from_afar(const std::string& name, const std::string& fails, Terrain terrain,
                const Expected& published, const Expected& conservative) {
  Scene scene = near_by(name, fails, std::move(terrain), published, conservative);
  scene.camera = look({-60, -90, 90}, {32, 32, 8}, 28.0);
  scene.parameters = {{"radius", "0"}};
  return scene;
}

const char* kLostAlike =
    "The truth here is what the finest voxels hold, so no claim is broken by what they lose: both "
    "variants lose it.";

Terrain plate(float start_m, float end_m) {
  return of(20, 16, [=](int, int) { return Layers{{0, 2, kRock}, {start_m, end_m, kRock}}; });
}

Layers cave_with_a_roof_of_a_metre(int i, int j) {
  const bool is_cave = i > 3 && i < 12 && j > 3 && j < 12;
  return is_cave ? Layers{{0, 4, kRock}, {11, 12, kRock}} : Layers{{0, 12, kRock}};
}

void add_voxels(std::vector<Scene>& scenes) {
  const auto lost = [&](const std::string& name, const std::string& fails, Terrain terrain,
                        double least_m, const std::string& radius) {
    scenes.push_back(near_by(name, fails, std::move(terrain), strays(Reading::TopError, least_m),
                             strays(Reading::TopError, least_m), radius));
    scenes.back().finding = kLostAlike;
  };
  lost("layer-thinner-than-a-voxel", "A plate of half a metre fills no voxel to more than half.",
       plate(8.0F, 8.5F), 6.4, "0");
  lost("wall-one-column-wide",
       "The filter leaves half of a wall one column wide, and half is outside.",
       of(20, 16,
          [](int i, int) {
            return Layers{{0, i == 10 ? 12.0F : 4.0F, kRock}};
          }),
       6.4, "1");
  lost("roof-thinner-than-the-filter",
       "Of a roof of one voxel the filter leaves a half: a cave is open to the sky.",
       of(16, 16, cave_with_a_roof_of_a_metre), 7.9, "1");
  lost("density-of-exactly-one-half", "Half of a voxel is outside: a plate of half a metre.",
       plate(8.25F, 8.75F), 6.7, "0");
  Scene slope = near_by(
      "coverage-of-a-slope",
      "Coverage against 1/2 is exact only where the top voxel is empty, half or "
      "full: elsewhere a slope is up to 3/2 - sqrt 2 of a voxel off.",
      [] { return ground(20, 20, 1.0, [](int i, int j) { return 4.0 + 0.3 * i + 0.2 * j; }); },
      strays(Reading::TopError, 0.05, 0.0859), strays(Reading::TopError, 0.05, 0.0859), "0");
  slope.finding =
      "The conservative variant claims of heights what the finest level reaches: here that is "
      "within the tolerance.";
  scenes.push_back(std::move(slope));
}

Layers two_tips(int i, int j) {
  if (i == 3 && j == 3) return {{0, 8, kRock}, {12, 14, kRock}};
  if (i == 4 && j == 4) return {{0, 4, kRock}, {8, 14, kRock}};
  return {{0, 4, kRock}, {12, 14, kRock}};
}

Layers back_to_back(int i, int j) {
  const bool is_cavity = (i + j) % 2 == 1 && i > 0 && j > 0 && i < 7 && j < 7;
  return is_cavity ? Layers{{0, 8, kRock}, {9, 14, kRock}} : Layers{{0, 14, kRock}};
}

void add_cells(std::vector<Scene>& scenes) {
  scenes.push_back(near_by("two-surfaces-in-one-cell",
                           "A stalagmite and a stalactite touch in one cell: one vertex for both "
                           "sheets.",
                           of(8, 16, two_tips), breaks(Reading::NonManifold, 1),
                           strays(Reading::NonManifold, 0, 0), "0"));
  scenes.push_back(near_by("masks-back-to-back",
                           "Two of the 36 masks with two curves on one face share that face: edges "
                           "of four triangles.",
                           of(8, 16, back_to_back), breaks(Reading::NonManifold, 20),
                           strays(Reading::NonManifold, 0, 0), "0"));
  for (Scene* scene : {&scenes[scenes.size() - 2], &scenes.back()})
    scene->camera = look({-7, -9, 12}, {3.5, 3.5, 8}, 40.0);
  scenes.push_back(near_by(
      "particles-and-minimisers-fold",
      "Vertices of neighbouring cells that seek sharp features pass each "
      "other.",
      [] { return terrain::load_terrain("generate:caves?size=65&spacing=8"); },
      breaks(Reading::Folded, 150), strays(Reading::Folded, 400), "0"));
  scenes.back().parameters["placement"] = "qef";
  scenes.back().camera = look({-200, -300, 420}, {256, 256, 100}, 50.0);
  scenes.back().finding =
      "Both fold, and nothing is claimed of that. The conservative variant draws four times the "
      "triangles here, since a pixel is finer than 160 of a node, and has fewer folds among them.";
}

void add_merging(std::vector<Scene>& scenes) {
  const auto rows_of = [](float high_m, float sliver_m) {
    return of(64, 32, [=](int, int j) {
      Layers layers;
      if (j % 2 == 0) layers.push_back({0, high_m, kRock});
      if (sliver_m > 0) layers.push_back({high_m, high_m + sliver_m, kRock});
      return layers;
    });
  };
  scenes.push_back(from_afar("tied-segments-only",
                             "Every second row is rock, the others are air: every segment below "
                             "the top is tied, the only vote is the air's above, and the next "
                             "level has no ground.",
                             rows_of(15, 0), breaks(Reading::Coverage, 1),
                             holds(Reading::NearestError, 1.0)));
  scenes.push_back(from_afar("vote-of-a-sliver",
                             "A millimetre of rock over such rows has a full vote: the next level "
                             "is rock without a gap.",
                             rows_of(15, 0.001F), breaks(Reading::NearestError, 20.0),
                             holds(Reading::NearestError, 1.0)));
  scenes.push_back(from_afar("checkerboard-of-materials",
                             "Two columns of each in every four: nothing dominates, and the first "
                             "material takes all.",
                             of(64, 32,
                                [](int i, int j) {
                                  return Layers{{0, 8, (i + j) % 2 == 0 ? kRock : kSand}};
                                }),
                             strays(Reading::ColourError, 0.1), strays(Reading::ColourError, 0.1)));
  scenes.back().finding =
      "Nothing is claimed of materials: by the shape alone a plain is right on every level, and "
      "the "
      "conservative variant draws a coarse one too.";
}

void add_sizes(std::vector<Scene>& scenes) {
  scenes.push_back(from_afar(
      "caves-that-vanish",
      "Caves, slabs and roofs that two of four columns share vanish one "
      "level up, and surfaces shift by half a voxel of each.",
      [] { return terrain::load_terrain("generate:caves?size=129"); },
      breaks(Reading::NearestError, 5.0), holds(Reading::NearestError, 1.0)));
  scenes.back().parameters = {{"radius", "1"}};
  scenes.back().camera = look({-30, -60, 120}, {64, 64, 50}, 50.0);
  scenes.push_back(from_afar("size-is-no-error",
                             "A node is split by its size on screen: a plain as eagerly as a "
                             "jagged one.",
                             of(128, 32,
                                [](int, int) {
                                  return Layers{{0, 16, kRock}};
                                }),
                             strays(Reading::Triangles, 14000),
                             strays(Reading::Triangles, 2, 8192)));
  scenes.back().camera = look({64, 63, 60}, {64, 64, 0}, 40.0);
  scenes.back().finding =
      "Two triangles would do. The conservative variant draws fewer, and still thousands: its "
      "bound "
      "on a plain is not zero.";
}

void add_levels(std::vector<Scene>& scenes) {
  const auto caves = [] { return terrain::load_terrain("generate:caves?size=97&spacing=2"); };
  Expected closed = sound();
  closed.reading = Reading::OpenEdges;
  closed.most = 0.0;
  Scene jump = near_by("levels-two-apart-after-a-jump",
                       "With a budget of 40 nodes a frame what is fine near the eye stands among "
                       "what was coarse: levels that differ by two have no stitch.",
                       caves, closed, closed);
  jump.parameters["budget"] = "40";
  jump.before = {look({20, 20, 500}, {60, 60, 60})};
  jump.camera = look({200, 190, 120}, {100, 100, 60}, 60.0);
  jump.finding =
      "The library's trees stay balanced at every step, so nothing opens. Trees that are not are "
      "tested by themselves (StackLevels.DifferByTwoWhenTheCameraJumps). What is drawn lags behind "
      "what the camera asks for, and so nothing is claimed but coverage, which a cave that is not "
      "there yet may break.";
  scenes.push_back(std::move(jump));
  Scene corner = near_by("three-levels-at-one-corner",
                         "Balance across faces alone lets three levels meet at a corner.", caves,
                         closed, strays(Reading::NonManifold, 0, 0));
  corner.camera = look({220, 210, 110}, {100, 100, 60}, 60.0);
  corner.finding =
      "The library balances across edges and corners too. Trees that are not are tested by "
      "themselves (StackLevels.ThreeAtOneCornerNeedBalanceAcrossCorners).";
  scenes.push_back(std::move(corner));
}

void add_extremes(std::vector<Scene>& scenes) {
  Expected nothing;
  nothing.verdict = Verdict::None;
  nothing.reading = Reading::Triangles;
  nothing.most = 0.0;
  scenes.push_back(near_by("stacks-of-air", "There is nothing to draw.",
                           of(20, 16, [](int, int) { return Layers{}; }), nothing, nothing));
  scenes.push_back(near_by("stacks-of-rock", "All is full to the top of the lattice.",
                           of(20, 16,
                              [](int, int) {
                                return Layers{{0, 16, kRock}};
                              }),
                           strays(Reading::TopError, 0.0, 0.0),
                           strays(Reading::TopError, 0.0, 0.0)));
  scenes.back().camera = look({-14, -18, 44}, {9, 9, 16}, 30.0);
}

}  // namespace

std::vector<Scene> stack_scenes() {
  std::vector<Scene> scenes;
  add_voxels(scenes);
  add_cells(scenes);
  add_merging(scenes);
  add_sizes(scenes);
  add_levels(scenes);
  add_extremes(scenes);
  return scenes;
}

}  // namespace plumb::audit::stability
