// What a frame costs as the terrain grows: a table from 513 x 513 samples to 16385 x 16385.
//
//   sizes_bench [LARGEST]   samples along the side of the largest terrain (16385)
#include <cstdio>

#include "audit/audit.h"
#include "audit/method.h"
#include "bench_support.h"
#include "reference/pyramid_caster.h"

namespace plumb::bench {
namespace {

struct Clock {
  double user = user_seconds();
  std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
  double lap_s() {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double>(now - wall).count();
    wall = now;
    return passed;
  }
};

double peak_megabytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void row(int size) {
  const std::string name = "generate:alpine?size=" + std::to_string(size) + "&spacing=10";
  const terrain::Heightfield field = terrain::load_terrain(name);
  const Camera camera = make_camera(terrain::preset_camera(field, "oblique", 1920, 1080, 50.0));
  Clock clock;
  const audit::HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  const double build_s = clock.lap_s();
  truth.caster.cast_frame(camera);
  const double truth_s = clock.lap_s();
  const audit::MethodTable table = audit::built_in_methods();
  const Tolerance tolerance{1.0, Unit::Pixel};
  const auto prepared =
      audit::prepare_method(audit::find_method(table, "restricted-quadtree"), field, {}, tolerance);
  const double prepare_s = clock.lap_s();
  const DrawnSurface surface = prepared->draw(camera, tolerance);
  const double draw_s = clock.lap_s();
  const audit::AuditResult result = audit::audit_surface(truth, surface, camera);
  const double audit_s = clock.lap_s();
  std::printf("%6d %12.0f %9.3f %9.3f %11.3f %8.3f %10d %9.3f %9.2f %8.0f %s\n", size,
              triangles_of(field), build_s, truth_s, prepare_s, draw_s,
              static_cast<int>(surface.cost.triangles), audit_s,
              audit_s / (1e-6 * camera.width_px * camera.height_px), peak_megabytes(),
              result.holds() ? "held" : "BROKEN");
  std::fflush(stdout);
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 16385;
  std::printf("wall seconds, all threads, 1920 x 1080, oblique, restricted-quadtree at 1 px\n");
  std::printf(
      "  size    triangles   build     truth     prepare     draw  drawn tri.     audit  s/Mpixel  "
      "peak MB verdict\n");
  for (int size = 513; size <= largest; size = 2 * size - 1) plumb::bench::row(size);
  return 0;
}
