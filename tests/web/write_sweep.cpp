// write_sweep FILE: results of a made-up sweep of 5,000 runs, for the browser's test: four
// terrains, eight series, exact and infinitely wrong runs, a camera path, failed and skipped runs.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "support/sweep_lines.h"

namespace {

using plumb::testing::line_of;
using plumb::testing::MadeUpRun;

struct MethodOfTest {
  const char* name;
  const char* variant;
  double error, cost;  // of the tolerance; of the usual number of triangles
  bool slices;
};

constexpr MethodOfTest kMethods[]{
    {"full", "only", 0.0, 20.0, false},
    {"restricted-quadtree", "published", 1.2, 1.0, false},
    {"restricted-quadtree", "conservative", 0.8, 1.5, false},
    {"chunked", "conservative", 0.6, 2.4, false},
    {"tessellation", "published", 1.4, 1.2, false},
    {"tessellation", "conservative", 0.9, 2.0, false},
    {"slicing", "exact", 0.3, 3.0, true},
    {"hybrid-slicing", "conservative", 0.7, 1.8, true},
};

constexpr const char* kTerrains[][2]{
    {"hills", "smooth"}, {"alps", "alpine"}, {"town", "urban"}, {"grotto", "caves"}};
constexpr double kTolerances[]{0.25, 0.5, 1, 2, 4, 8};

// Frame 0 to 2 are views of their own, those behind them a path.
MadeUpRun run_of(int terrain, const MethodOfTest& method, double tolerance, int view) {
  const double wave = 1.0 + 0.35 * std::sin(0.5 * view + 2.0 * method.cost);
  MadeUpRun run;
  run.terrain = kTerrains[terrain][0];
  run.kind = kTerrains[terrain][1];
  run.method = method.name;
  run.variant = method.variant;
  run.tolerance = tolerance;
  run.camera = view < 3 ? (view == 0 ? "oblique" : view == 1 ? "valley" : "top") : "flight";
  run.frame = view < 3 ? 0 : view - 2;
  run.error_px = method.error * tolerance * wave;
  run.claimed_px = method.error == 0.0 ? 0.0 : tolerance;
  run.triangles = static_cast<int>(20000 * method.cost * (terrain + 1) * wave / tolerance);
  run.slices = method.slices ? 64 : 0;
  run.cpu_s = 2e-8 * run.triangles;
  run.shared = terrain == 1;
  if (view >= 3) run.popping_px = 0.3 * *run.error_px;
  run.command = "plumb audit 'generate:" + run.kind + "?size=257' --method " + method.name +
                " --tolerance " + std::to_string(tolerance) + "px --camera " + run.camera;
  return run;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: write_sweep FILE\n", stderr);
    return 2;
  }
  std::ofstream file(arguments[1], std::ios::binary);
  int number = 0;
  for (int terrain = 0; terrain < 4; ++terrain) {
    for (const MethodOfTest& method : kMethods) {
      for (const double tolerance : kTolerances) {
        for (int view = 0; view < 27; ++view) {
          MadeUpRun run = run_of(terrain, method, tolerance, view);
          ++number;
          if (number % 211 == 0) run.status = "failed";
          if (terrain == 3 && method.name == std::string("slicing")) run.status = "skipped";
          if (number % 97 == 0) run.error_px.reset();
          file << line_of(run);
        }
      }
    }
  }
  return file ? 0 : 1;
}
