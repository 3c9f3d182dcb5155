// Where hardware tessellation over a compressed quadtree fails [Yusov & Shevtsov 2011].
#include <cmath>
#include <map>
#include <utility>

#include "audit/stability/grounds.h"
#include "audit/stability/rough_ground.h"
#include "audit/stability/scene_lists.h"

namespace plumb::audit::stability {
namespace {

using Parameters = std::map<std::string, std::string>;

Parameters with(const std::string& error_m, const std::string& patch_cells,
                const std::string& block_cells = "8") {
  return {{"error", error_m}, {"patch_cells", patch_cells}, {"block_cells", block_cells}};
}

Scene patches(const std::string& name, const std::string& fails,
              std::function<terrain::Heightfield()> terrain, const LookAt& camera,
              Parameters parameters, const Tolerance& tolerance = {}, double least = 0.0) {
  Scene scene;
  scene.name = name;
  scene.methods = {"tessellation"};
  scene.fails = fails;
  scene.terrain = std::move(terrain);
  scene.camera = camera;
  scene.parameters = std::move(parameters);
  scene.tolerance = tolerance;
  scene.published = breaks(Reading::SampleError, least > 0.0 ? least : tolerance.value);
  scene.conservative = holds(Reading::SampleError, tolerance.value);
  return scene;
}

Tolerance px(double value) { return {value, Unit::Pixel}; }
Tolerance metres(double value) { return {value, Unit::Metre}; }

auto rough(int size, std::uint32_t seed, double relief_m = 100.0) {
  return [=] { return rough_ground(size, size, seed, relief_m); };
}

auto of(int columns, int rows, double spacing_m, const std::function<double(int, int)>& height_m) {
  return [=] { return ground(columns, rows, spacing_m, height_m); };
}

void add_views(std::vector<Scene>& scenes) {
  scenes.push_back(
      patches("spike-straight-down",
              "Seen from above, a vertical length is a point on the screen: the side's test "
              "passes, and the "
              "block's spike is dropped.",
              of(17, 17, 10.0, [](int i, int j) { return i == 2 && j == 2 ? 30.0 : 0.0; }),
              look({80, 40, 200}, {80, 40, 0}, 60.0), with("0.001", "16"), {}, 5.7));
  scenes.push_back(patches("edge-midpoint-behind-the-camera",
                           "One point stands for a whole side of a block; it lies behind the eye, "
                           "and the side reaches into the picture.",
                           rough(129, 3), look({330, 500, 130}, {330, 900, 60}, 60.0),
                           with("0.05", "64", "64"), px(2.0), 3.3));
  scenes.push_back(patches("block-across-the-near-plane",
                           "A block reaches across the near plane, where lengths on screen have no "
                           "end.",
                           rough(97, 4), look({200, 200, 120}, {700, 600, 40}, 60.0, 60.0),
                           with("0.05", "16"), px(0.5)));
  scenes.back().finding =
      "It is not the plane that breaks the claim: one at 0.5 m changes nothing, and with the "
      "edge's midpoint or the inner minimum mended the claim holds.";
}

void add_heights(std::vector<Scene>& scenes) {
  scenes.push_back(patches("delta-larger-than-the-relief",
                           "All heights are coded as one: the tolerance is out of reach, however "
                           "fine the mesh.",
                           rough(65, 5, 20.0), look({300, -200, 300}, {320, 320, 0}, 60.0),
                           with("500", "16")));
  scenes.back().conservative = strays(Reading::SampleError, 1.0, 4.1);
  scenes.back().finding =
      "The conservative variant says that the tolerance is out of reach, and claims what is in "
      "reach; the published one claims what was asked for.";
  scenes.push_back(patches(
      "heights-below-zero",
      "A quantiser that cuts digits off instead of rounding down, or has a dead zone about zero, "
      "is "
      "off by more than its bound below zero.",
      [] {
        return ground(97, 80, 10.0,
                      [](int i, int j) { return rough_height(6, i, j, 100.0) - 4000.0; });
      },
      look({100, -100, -3750}, {480, 400, -4000}, 60.0), with("0.3", "16")));
  scenes.back().published = Expected{Verdict::Broken, Reading::SampleError, 0.0, 1.0};
  scenes.back().finding =
      "Not shown: the quantiser is `floor`, as printed, and right below zero. What breaks is a "
      "patch's bound by its bilinear error, 8000 m higher up too.";
}

void add_losses(std::vector<Scene>& scenes) {
  scenes.push_back(
      patches("walls-that-decimation-loses", "Walls on odd columns are in no level but the finest.",
              of(65, 65, 10.0, [](int i, int) { return i % 16 == 9 ? 40.0 : 0.0; }),
              look({320, 320, 300}, {320, 320.1, 0}, 90.0), with("0.01", "8"), px(4.0)));
  scenes.back().published = breaks(Reading::SampleError, 5.0);
  scenes.push_back(patches("saddle-under-a-diagonal",
                           "All samples lie on the parent's triangles, but between them the "
                           "terrain's own diagonals fall "
                           "across: 4 m that no sample knows of.",
                           of(9, 10, 10.0, [](int i, int j) { return 4.0 * std::abs(i - 4 - j); }),
                           look({40, -90, 130}, {40, 45, 0}, 40.0), with("0.001", "8"),
                           metres(3.0)));
  scenes.back().published = scenes.back().conservative = holds(Reading::SurfaceError, 0.002);
  scenes.back().finding =
      "Not shown: the printed Err_int is of the bilinear patch, which is 4 m off the valley's "
      "floor, "
      "so the children are drawn. Taken at the samples of the triangles as drawn it would be zero; "
      "the conservative bound is taken where diagonals cross too. (The other way round: "
      "bilinear-patches-drawn-as-triangles.)";
  scenes.push_back(patches(
      "holes-of-no-data",
      "Heights that are not there have no error, and no outline at a coarser "
      "level.",
      [] { return rough_ground(97, 91, 7, 100.0, 0.05); },
      look({450, 100, 250}, {480, 500, 0}, 60.0), with("0.05", "16")));
  scenes.back().published = breaks(Reading::Coverage, 200);
  scenes.back().conservative = holds(Reading::Coverage, 0);
}

void add_joints(std::vector<Scene>& scenes) {
  const auto corner = [] {
    return ground(257, 257, 10.0, [](int i, int j) {
      return i < 40 && j < 40 ? rough_height(8, i, j, 60.0) : 30.0 + 0.0625 * i;
    });
  };
  scenes.push_back(patches("patches-two-levels-apart",
                           "Rough ground in one corner, a slope beside it: T-junctions along every "
                           "side between far levels.",
                           corner, look({60, 700, 150}, {390, 390, 30}, 60.0), with("0.01", "16")));
  scenes.back().published = strays(Reading::TJunctions, 100, 104);
  scenes.back().conservative = strays(Reading::TJunctions, 100);
  scenes.back().finding =
      "There are T-junctions in both, and levels three apart; skirts and walls hide them, and no "
      "pixel is lost: coverage holds.";
  scenes.push_back(patches("factor-of-64",
                           "Hardware cuts a side into 64 at most: a block has as many cells.",
                           rough(129, 9), look({600, -100, 300}, {640, 600, 0}, 60.0),
                           with("0.05", "128", "64"), px(2.0)));
  scenes.back().published = breaks(Reading::SampleError, 2.4);
  scenes.back().finding =
      "It is not the limit that breaks the claim: with the edge's midpoint or the inner minimum "
      "mended it holds, with factors of 64 at most.";
  scenes.push_back(patches("factor-beyond-64", "A block of 128 cells asks for a factor of 128.",
                           rough(129, 9), look({600, -100, 300}, {640, 600, 0}, 60.0),
                           with("0.05", "128", "128"), px(6.0)));
  scenes.back().published = scenes.back().conservative =
      refused("block_cells: expected a power of two from 8 to 64");
  scenes.back().finding =
      "Refused by both: with a factor of 64 at most such a block would never show all its samples.";
}

// The causes that the errata name, each where all others are mended, or where it is the only one.
void add_causes(std::vector<Scene>& scenes) {
  const LookAt low = look({480, 480, 160}, {480, 480, 0}, 90.0),
               within = look({480, 480, 120}, {480, 900, 60}, 80.0);
  const auto all_but = [](const std::string& cause) {
    Parameters parameters = with("0.05", "16");
    std::string mended;
    for (const char* each : {"edge-midpoint", "view-from-above", "not-monotone", "mixed-factors",
                             "inner-minimum", "distance-test", "bilinear-error"})
      if (each != cause) mended += (mended.empty() ? "" : ",") + std::string(each);
    parameters["mend"] = mended;
    return parameters;
  };
  scenes.push_back(patches("one-point-for-an-edge",
                           "The edge's test at its midpoint, all other causes mended.",
                           rough(97, 22), within, all_but("edge-midpoint"), px(1.0), 1.05));
  scenes.push_back(patches("distance-test",
                           "gamma Err / rho is no upper bound of the screen error, all other "
                           "causes mended.",
                           rough(97, 27), low, all_but("distance-test"), px(4.0), 4.1));
  Parameters chunks = with("0.05", "8");
  chunks["mend"] = "bilinear-error";
  scenes.push_back(patches("error-over-distance-of-chunks",
                           "A patch's error over its distance is no upper bound of what is seen of "
                           "it: patches alone, their errors as drawn.",
                           rough(97, 56), look({480, 480, 160}, {480, 480.1, 0}, 90.0), chunks,
                           px(3.0), 3.1));
  scenes.back().methods = {"chunked"};
  scenes.push_back(patches("inner-minimum",
                           "The most tolerant side of a block decides its inside, all other rules "
                           "as printed.",
                           rough(97, 11), within, with("0.05", "16"), px(3.0), 3.7));
  scenes.push_back(patches("mixed-factors",
                           "A block's error belongs to one factor, and its sides have others.",
                           rough(97, 8), within, with("0.05", "16"), px(2.0), 3.3));
}

// Over terrains of a few samples, a metre apart.
void add_small_causes(std::vector<Scene>& scenes) {
  scenes.push_back(patches(
      "thinning-that-is-not-monotone",
      "A factor of 1 passes where 2 does not; beside a finer side the tessellator draws the 2.",
      of(17, 17, 1.0,
         [](int i, int j) {
           const bool corner = i % 8 == 0 && j % 8 == 0, middle = i % 8 == 4 && j % 8 == 4;
           return i > 8 && j > 8 ? 90.0 * ((i + j) % 2) : corner ? 0.0 : middle ? 10.0 : -10.0;
         }),
      look({32, -70, 130}, {32, 32, 16}, 45.0), with("0.001", "16"), metres(12.0), 17.4));
  scenes.push_back(patches("bilinear-patches-drawn-as-triangles",
                           "z = xy/64 is bilinear: to the paper's error every level is exact.",
                           of(65, 65, 1.0, [](int i, int j) { return i * j / 64.0; }),
                           look({8, -100, 160}, {8, 8, 30}, 30.0), with("0.0001", "8"), metres(0.2),
                           0.249));
}

}  // namespace

std::vector<Scene> tessellation_scenes() {
  std::vector<Scene> scenes;
  add_views(scenes);
  add_heights(scenes);
  add_losses(scenes);
  add_joints(scenes);
  add_causes(scenes);
  add_small_causes(scenes);
  return scenes;
}

}  // namespace plumb::audit::stability
