// The paper's figures in kind: what a terrain's file costs and how fast it is coded, and triangles,
// fragments and measured error of four methods along a flight. The terrain is bench_terrain()'s, as
// PLUMB_BENCH_TERRAIN names it.
//
//   tessellation_bench [VIEWS [CHART.svg]]   views of the flight (20); 0: the codec alone
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "audit/audit.h"
#include "audit/method.h"
#include "bench_support.h"
#include "core/atomic_file.h"
#include "core/reproducible_math.h"
#include "core/stopwatch.h"
#include "mesh/patch_quadtree/patch_decoder.h"
#include "mesh/tessellation/tessellation.h"
#include "report/scatter_chart.h"

namespace plumb::bench {
namespace {

// Once over the terrain, from its south to its north, the camera looking ahead and down.
Camera view_of(const terrain::Heightfield& field, int frame, int frames) {
  const Box box = terrain::bounds(field);
  const glm::dvec3 extent = box.high - box.low;
  const double way = (frame + 0.5) / frames;
  LookAt look;
  look.eye_m = field.world_origin_m() + box.low +
               glm::dvec3(0.5 * extent.x, 0.7 * way * extent.y, 1.3 * extent.z);
  look.target_m = look.eye_m + glm::dvec3(0.0, 0.3 * extent.y, -0.8 * extent.z);
  look.width_px = 1920;
  look.height_px = 1200;
  return make_camera(look);
}

void codec(const terrain::Heightfield& field) {
  const ThreadLimit one(1);
  const auto samples = static_cast<double>(field.heights_m.size());
  const double error_m = 0.1 * field.dx_m;
  for (const std::uint32_t version : {1u, 2u}) {
    mesh::tessellation::Parameters parameters;
    parameters.error_m = error_m;
    parameters.format_version = version;
    double start = user_seconds();
    const auto prepared = mesh::tessellation::prepare(field, parameters);
    const double built_s = user_seconds() - start;
    start = user_seconds();
    const Grid<float> heights = prepared.decoder->level_heights(0);
    const double decoded_s = user_seconds() - start;
    double worst_s = 0.0;
    const auto& layout = prepared.header().layout;
    for (std::int64_t k = layout.first_of_level(0); k < layout.patch_count(); k += 17) {
      start = user_seconds();
      const Grid<float> patch = prepared.decoder->heights(layout.place(k));
      worst_s = std::max(worst_s, user_seconds() - start);
      benchmark::DoNotOptimize(patch.values().data());
    }
    const double bits = 8.0 * static_cast<double>(prepared.container->file_bytes()) / samples;
    std::printf(
        "version %u within %g m: %.3f bits a sample with bounds, %.1f to 1 of 16 bits; one core: "
        "built at %.2f megasamples/s, decoded at %.1f, a patch alone at most %.2f ms\n",
        version, error_m, bits, 16.0 / bits, 1e-6 * samples / built_s, 1e-6 * samples / decoded_s,
        1e3 * worst_s);
  }
}

struct Drawn {
  double triangles = 0.0, fragments = 0.0, draw_s = 0.0;
  double sample_px = 0.0, pixel_px = 0.0;
  std::int64_t over = 0, defects = 0;
};

void along_flight(const audit::HeightfieldTruth& truth, const char* name, const char* variant,
                  int views, report::ScatterChart& chart) {
  const audit::Method& method = audit::find_method(audit::built_in_methods(), name);
  const terrain::Heightfield& field = truth.field();
  audit::MethodChoice choice;
  choice.variant = variant;
  const auto prepared = audit::prepare_method(method, field, choice, {1.0, Unit::Pixel});
  for (const double tolerance : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    Drawn sum;
    for (int frame = 0; frame < views; ++frame) {
      const Camera camera = view_of(field, frame, views);
      Stopwatch watch;
      const DrawnSurface surface = prepared->draw(camera, {tolerance, Unit::Pixel});
      sum.draw_s += watch.lap_s();
      audit::AuditOptions options;
      options.nearest = false;
      options.band.pixels = tolerance;
      const audit::AuditResult result = audit::audit_surface(truth, surface, camera, options);
      sum.triangles += static_cast<double>(surface.cost.triangles);
      sum.fragments += static_cast<double>(result.cost.fragments);
      sum.sample_px = std::max(sum.sample_px, result.samples.pixels.max);
      sum.pixel_px = std::max(sum.pixel_px, result.vertical.max);
      sum.defects += result.coverage.defect_count();
    }
    std::printf(
        "%-20s %-13s %5g px  %10.0f triangles %10.0f fragments  %.3f px samples %.3f px "
        "pixels  %lld defects  %.3f s\n",
        name, variant, tolerance, sum.triangles / views, sum.fragments / views, sum.sample_px,
        sum.pixel_px, static_cast<long long>(sum.defects), sum.draw_s / views);
    chart.points.push_back({sum.triangles / views, sum.sample_px,
                            fmt::format("{} {} at {} px", name, variant, tolerance)});
  }
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  using namespace plumb;
  const int views = argc > 1 ? std::atoi(argv[1]) : 20;
  const terrain::Heightfield& field = bench::bench_terrain();
  bench::codec(field);
  if (views <= 0) return 0;
  report::ScatterChart chart;
  chart.title = fmt::format("Five tolerances, {} views at 1920 x 1200", views);
  chart.x_label = "triangles a frame";
  chart.y_label = "largest sample error in view, px";
  for (const terrain::Diagonal diagonal :
       {terrain::Diagonal::Alternating, terrain::Diagonal::Blocks8}) {
    const audit::HeightfieldTruth truth(field, diagonal);
    const bool tessellated = diagonal == terrain::Diagonal::Blocks8;
    if (!tessellated)
      bench::along_flight(truth, "restricted-quadtree", "conservative", views, chart);
    if (!tessellated) continue;
    for (const char* variant : {"conservative", "published"})
      for (const char* name : {"tessellation", "chunked"})
        bench::along_flight(truth, name, variant, views, chart);
  }
  if (argc > 2) write_file_atomically(argv[2], report::to_svg(chart));
}
