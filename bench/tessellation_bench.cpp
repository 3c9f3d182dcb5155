// The paper's figures in kind: what a terrain's file costs and how fast it is coded, and triangles,
// fragments and measured error of four methods along a flight. The terrain is bench_terrain()'s, as
// PLUMB_BENCH_TERRAIN names it.
//
//   tessellation_bench [VIEWS]          the codec, and averages at five tolerances over VIEWS views
//                                       of the flight (20; 0: the codec alone)
//   tessellation_bench VIEWS CHART.svg  in their place, each view at two pixels, as a chart
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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

// A method as the registry names it.
struct Way {
  const char *name, *variant;
};

// What was drawn of one view, or of several: sums and largest ones.
struct Drawn {
  double triangles = 0.0, fragments = 0.0, draw_s = 0.0;
  double sample_px = 0.0, pixel_px = 0.0;
  std::int64_t defects = 0;

  double worst_px() const { return std::max(sample_px, pixel_px); }
  void add(const Drawn& other) {
    triangles += other.triangles;
    fragments += other.fragments;
    draw_s += other.draw_s;
    sample_px = std::max(sample_px, other.sample_px);
    pixel_px = std::max(pixel_px, other.pixel_px);
    defects += other.defects;
  }
};

std::unique_ptr<audit::PreparedMethod> prepared_way(const terrain::Heightfield& field,
                                                    const Way& way) {
  audit::MethodChoice choice;
  choice.variant = way.variant;
  return audit::prepare_method(audit::find_method(audit::built_in_methods(), way.name), field,
                               choice, {1.0, Unit::Pixel});
}

Drawn drawn_of(const audit::HeightfieldTruth& truth, const audit::PreparedMethod& prepared,
               const Camera& camera, double tolerance_px) {
  Drawn drawn;
  Stopwatch watch;
  const DrawnSurface surface = prepared.draw(camera, {tolerance_px, Unit::Pixel});
  drawn.draw_s = watch.lap_s();
  audit::AuditOptions options;
  options.nearest = false;
  options.band.pixels = tolerance_px;
  const audit::AuditResult result = audit::audit_surface(truth, surface, camera, options);
  drawn.triangles = static_cast<double>(surface.cost.triangles);
  drawn.fragments = static_cast<double>(result.cost.fragments);
  drawn.sample_px = result.samples.pixels.max;
  drawn.pixel_px = result.vertical.max;
  drawn.defects = result.coverage.defect_count();
  return drawn;
}

void averages(const audit::HeightfieldTruth& truth, const Way& way, int views) {
  const auto prepared = prepared_way(truth.field(), way);
  for (const double tolerance : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    Drawn sum;
    for (int frame = 0; frame < views; ++frame)
      sum.add(drawn_of(truth, *prepared, view_of(truth.field(), frame, views), tolerance));
    std::printf(
        "%-20s %-13s %5g px  %10.0f triangles %10.0f fragments  %.3f px samples %.3f px "
        "pixels  %lld defects  %.3f s\n",
        way.name, way.variant, tolerance, sum.triangles / views, sum.fragments / views,
        sum.sample_px, sum.pixel_px, static_cast<long long>(sum.defects), sum.draw_s / views);
    std::fflush(stdout);
  }
}

void all_averages(const terrain::Heightfield& field, int views) {
  averages({field, terrain::Diagonal::Alternating}, {"restricted-quadtree", "conservative"}, views);
  const audit::HeightfieldTruth truth(field, terrain::Diagonal::Blocks8);
  for (const char* variant : {"conservative", "published"})
    for (const char* name : {"tessellation", "chunked"}) averages(truth, {name, variant}, views);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

// One above the other: what a view costs and how wrong it is. The tolerance is the paper's.
struct FlightChart {
  static constexpr double kTolerancePx = 2.0;

  std::array<report::ScatterChart, 3> panels;

  explicit FlightChart(int views) {
    for (report::ScatterChart& panel : panels)
      panel.x_axis = panel.y_axis = report::AxisKind::Linear;
    panels[0].title =
        fmt::format("{} views along a flight at {:g} px, 1920 × 1200", views, kTolerancePx);
    panels[0].y_axis = report::AxisKind::Log10;
    panels[0].y_label = "triangles, thousands";
    panels[1].y_label = "fragments, millions";
    panels[2].y_label = "largest error, px";
    panels[2].x_label = "view";
    panels[2].limit = kTolerancePx;
    panels[2].limit_label = "tolerance";
  }

  // An error without end has no place on an axis: its series passes over the view.
  void add(int view, const Drawn& drawn) {
    const std::array<double, 3> values{1e-3 * drawn.triangles, 1e-6 * drawn.fragments,
                                       drawn.worst_px()};
    for (std::size_t k = 0; k < panels.size(); ++k) {
      report::ChartSeries& series = panels[k].series.back();
      if (std::isfinite(values[k]))
        series.points.push_back({1.0 * view, values[k],
                                 fmt::format("view {}, {}: {:.4g}", view, series.name, values[k])});
    }
  }
};

void along_flight(const audit::HeightfieldTruth& truth, const Way& way, int views,
                  FlightChart& chart) {
  const auto prepared = prepared_way(truth.field(), way);
  std::string label = way.name;
  if (label != "restricted-quadtree") label += fmt::format(", {}", way.variant);
  for (report::ScatterChart& panel : chart.panels) panel.series.push_back({label, {}, true});
  std::vector<double> triangles, fragments, worst_px;
  std::int64_t defects = 0;
  for (int frame = 0; frame < views; ++frame) {
    const Drawn drawn =
        drawn_of(truth, *prepared, view_of(truth.field(), frame, views), FlightChart::kTolerancePx);
    chart.add(frame + 1, drawn);
    triangles.push_back(drawn.triangles);
    fragments.push_back(drawn.fragments);
    worst_px.push_back(drawn.worst_px());
    defects += drawn.defects;
    std::printf("%-26s view %2d %9.0f triangles %9.0f fragments %.3f px\n", label.c_str(),
                frame + 1, drawn.triangles, drawn.fragments, drawn.worst_px());
    std::fflush(stdout);
  }
  std::printf(
      "%-26s medians %9.0f triangles %9.0f fragments %.3f px, the worst %.3f px, %lld defects\n",
      label.c_str(), median(triangles), median(fragments), median(worst_px),
      *std::max_element(worst_px.begin(), worst_px.end()), static_cast<long long>(defects));
}

std::string flight_svg(const terrain::Heightfield& field, int views) {
  FlightChart chart(views);
  along_flight({field, terrain::Diagonal::Alternating}, {"restricted-quadtree", "conservative"},
               views, chart);
  const audit::HeightfieldTruth truth(field, terrain::Diagonal::Blocks8);
  for (const Way& way : {Way{"tessellation", "conservative"}, Way{"tessellation", "published"},
                         Way{"chunked", "conservative"}})
    along_flight(truth, way, views, chart);
  return report::svg_of_panels(chart.panels);
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  using namespace plumb;
  const int views = argc > 1 ? std::atoi(argv[1]) : 20;
  const terrain::Heightfield& field = bench::bench_terrain();
  if (argc > 2 && views > 0) {
    write_file_atomically(argv[2], bench::flight_svg(field, views));
    return 0;
  }
  bench::codec(field);
  if (views > 0) bench::all_averages(field, views);
}
