// Where triangulations of restricted quadtrees over patches fail [Intel sample 2012; Pajarola 1998;
// Lindstrom et al. 1996].
#include <utility>

#include "audit/stability/grounds.h"
#include "audit/stability/printed_quadtree.h"
#include "audit/stability/rough_ground.h"
#include "audit/stability/scene_lists.h"

namespace plumb::audit::stability {
namespace {

constexpr Tolerance kMetre{1.0, Unit::Metre};

auto of(int columns, int rows, const std::function<double(int, int)>& height_m) {
  return [=] { return ground(columns, rows, 10.0, height_m); };
}

// In metres, over 320 x 320 m: the method's own variant beside the printed rules.
Scene patch(const std::string& name, const std::string& fails,
            std::function<terrain::Heightfield()> terrain, const PrintedRules& rules,
            const Expected& published, const Tolerance& threshold = kMetre) {
  Scene scene;
  scene.name = name;
  scene.methods = {"restricted-quadtree"};
  scene.fails = fails;
  scene.terrain = std::move(terrain);
  scene.camera = look({160, -120, 180}, {160, 160, 0}, 60.0);
  scene.tolerance = threshold;
  scene.as_printed = [rules](const terrain::Heightfield& field, const Tolerance& tolerance) {
    return printed_quadtree(field, tolerance, rules);
  };
  scene.published = published;
  scene.conservative = holds(Reading::SampleError, threshold.value);
  return scene;
}

double spike(int i, int j) { return i == 15 && j == 15 ? 30.0 : 0.0; }

void add_triangulations(std::vector<Scene>& scenes) {
  scenes.push_back(patch("spike-at-an-odd-vertex",
                         "One spike at a finest odd vertex forces a cascade of splits: it needs 8 "
                         "triangles, and the rest is there to stay free of cracks.",
                         of(33, 33, spike), {}, strays(Reading::Triangles, 52, 52)));
  scenes.back().finding =
      "No failure but a price: 50 triangles more than the plain without the spike, by the printed "
      "rules and by the method's own.";
  scenes.back().conservative = strays(Reading::Triangles, 52, 52);
  scenes.push_back(patch("spike-that-decimation-drops",
                         "A patch of every second sample has never seen the spike: its threshold "
                         "is one of its own samples.",
                         of(33, 33, spike), {.step = 2}, breaks(Reading::SampleError, 30.0)));
  scenes.push_back(patch("threshold-of-decimated-samples",
                         "\"Below the threshold\" holds against a patch's own samples alone; the "
                         "finest ones lie where they like.",
                         of(33, 33, [](int i, int j) { return rough_height(4, i, j, 60.0); }),
                         {.step = 4}, breaks(Reading::SampleError, 1.0)));
  scenes.push_back(patch(
      "plane-with-threshold-0",
      "An error below the threshold drops a vertex: with threshold 0 none is, not even on a plane.",
      of(33, 33, [](int i, int j) { return 2.0 * i + j; }), {},
      strays(Reading::Triangles, 2048, 2048), {0.0, Unit::Metre}));
  scenes.back().conservative = strays(Reading::Triangles, 2, 2);
  scenes.push_back(patch("checkerboard",
                         "Nothing can be dropped, and every triangle still writes its flag.",
                         of(33, 33, [](int i, int j) { return 20.0 * ((i + j) % 2); }), {},
                         strays(Reading::Triangles, 2048, 2048)));
  scenes.back().finding =
      "No failure: all 2 x 32 x 32 triangles are drawn. (Of flags, the encoded size tells.)";
  scenes.back().conservative = strays(Reading::Triangles, 2048, 2048);
  scenes.push_back(patch("algorithm-2-word-for-word",
                         "Line 5 tests the vertices that v depends on, which are decided later, in "
                         "place of those that "
                         "depend on v: triangles end amid their neighbours' sides.",
                         of(33, 33, [](int i, int j) { return rough_height(32, i, j, 60.0); }),
                         {.word_for_word = true}, breaks(Reading::TJunctions, 20),
                         {0.5, Unit::Metre}));
  scenes.back().conservative = strays(Reading::TJunctions, 0, 0);
}

void add_sizes(std::vector<Scene>& scenes) {
  scenes.push_back(patch("not-2-to-the-n-plus-1", "The tree has squares of 2^n cells alone.",
                         of(30, 21, [](int i, int j) { return rough_height(4, i, j, 60.0); }), {},
                         refused("2^n + 1 samples a side, not 30 x 21")));
  Scene cliff = patch(
      "cliff-along-a-patch-border",
      "Each patch chooses the vertices of its border alone: level on one side of it, 60 m down and "
      "rough on the other.",
      of(65, 65, [](int i, int j) { return i <= 32 ? 60.0 : rough_height(4, i, j, 20.0) - 20.0; }),
      {}, sound());
  cliff.methods = {"restricted-quadtree", "chunked", "tessellation"};
  cliff.as_printed = {};
  cliff.published.reset();
  cliff.camera = look({900, 330, 60}, {320, 330, 20}, 50.0);
  cliff.finding = "Not shown: skirts and walls close the border, and no pixel is lost.";
  cliff.tolerance = {2.0, Unit::Pixel};
  cliff.published = strays(Reading::Coverage, 0, 0);
  cliff.conservative = strays(Reading::Coverage, 0, 0);
  scenes.push_back(std::move(cliff));
  scenes.back().parameters = {{"patch_cells", "32"}};
}

void add_views(std::vector<Scene>& scenes) {
  const auto hills = [] { return rough_ground(129, 129, 3); };
  Scene jump = patch("camera-that-jumps",
                     "What was drawn for the last frame does not fit this one: too coarse near by, "
                     "levels far apart.",
                     hills, {}, sound());
  jump.methods = {"restricted-quadtree", "chunked"};
  jump.as_printed = {};
  jump.before = {look({100, 100, 400}, {300, 300, 0}), look({200, 160, 300}, {400, 400, 0})};
  jump.camera = look({1100, 1150, 160}, {700, 700, 30}, 60.0);
  jump.parameters = {{"patch_cells", "16"}};
  jump.tolerance = {2.0, Unit::Pixel};
  jump.published = Expected{{}, Reading::SampleError, 0.0, 2.0};
  jump.conservative = holds(Reading::SampleError, 2.0);
  scenes.push_back(std::move(jump));
  scenes.back().finding =
      "No failure between frames: in lock step a frame depends on its camera alone. What the "
      "published chunks break are patches' own bounds, as they do in any frame.";
}

}  // namespace

std::vector<Scene> quadtree_scenes() {
  std::vector<Scene> scenes;
  add_triangulations(scenes);
  add_sizes(scenes);
  add_views(scenes);
  return scenes;
}

}  // namespace plumb::audit::stability
