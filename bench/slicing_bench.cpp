// The article's figures in kind: triangles and slices over window sizes, the speed-up over brute
// force by the cost model, the heuristic beside the optimum, and the ray-slicer beside the caster
// of the truth. The terrain is bench_terrain()'s, as PLUMB_BENCH_TERRAIN names it.
//
//   slicing_bench [VIEWS [CHART.svg]]   views that each row is averaged over (50); 0: only beside
//                                       the caster
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "bench_support.h"
#include "core/atomic_file.h"
#include "core/reproducible_math.h"
#include "core/screen_error.h"
#include "core/stopwatch.h"
#include "reference/pyramid_caster.h"
#include "report/scatter_chart.h"
#include "slicing/hybrid_frame.h"
#include "slicing/ray_slicer.h"

namespace plumb::bench {
namespace {

using slicing::CutOptions;
using slicing::SlicingCut;
using slicing::Variant;

// A circle around the terrain's middle, which the camera looks at; shares of the terrain's extent.
struct Flight {
  const char* name;
  double radius, above_middle, fov_y_deg;
};
constexpr Flight kWide{"wide flight, 50 degrees", 0.4, 0.6, 50.0};
constexpr Flight kNear{"near flight, 45 degrees", 0.25, 0.4, 45.0};

Camera view_of(const Flight& flight, const terrain::Heightfield& field, int frame, int frames,
               int width, int height) {
  const Box box = terrain::bounds(field);
  const glm::dvec3 middle = field.world_origin_m() + 0.5 * (box.low + box.high),
                   extent = box.high - box.low;
  const double turn = 2.0 * kPi * frame / frames;
  LookAt look;
  look.eye_m = middle + glm::dvec3(flight.radius * extent.x * reproducible_cos(turn),
                                   flight.radius * extent.y * reproducible_sin(turn),
                                   flight.above_middle * extent.z);
  look.fov_y_deg = flight.fov_y_deg;
  look.target_m = middle - glm::dvec3(0.0, 0.0, 0.5 * extent.z);
  look.width_px = width;
  look.height_px = height;
  return make_camera(look);
}

struct Sums {
  double triangles = 0.0, slices = 0.0, cost_s = 0.0, all_s = 0.0, in_view_s = 0.0;
  double ratio_to_optimum = 0.0, worst_to_optimum = 0.0;
};

double triangles_of(const slicing::SlicingTree& tree, const SlicingCut& cut) {
  double triangles = 0.0;
  for (const std::uint32_t index : cut.polygons) {
    const slicing::SlicingNode& node = tree.node(index);
    triangles += 2.0 * (node.i1 - node.i0) * (node.j1 - node.j0);
  }
  return triangles;
}

// Every node as polygons: all of them, and those in view.
struct BruteForce {
  double all_s = 0.0, in_view_s = 0.0;
};
BruteForce brute_force(const slicing::SlicingTree& tree, const Camera& camera,
                       const slicing::CostProfile& profile) {
  BruteForce brute;
  for (std::uint32_t k = slicing::SlicingTree::first_of(tree.levels() - 1); k < tree.count(); ++k) {
    const slicing::SlicingNode& node = tree.node(k);
    if (node.empty()) continue;
    slicing::BoxView view = view_of_box(node.box, camera, Variant::Conservative);
    view.distance_m = std::max(view.distance_m, camera.near_m);
    const bool seen = may_be_in_view(camera, node.box);
    if (!seen) view.most_px = 0.0;
    const double cost_s = cost_of_polygons_s(node, view, camera, profile);
    brute.all_s += cost_s;
    if (seen) brute.in_view_s += cost_s;
  }
  return brute;
}

// Points for slices over triangles go to `chart`.
void table(const slicing::SlicingTree& tree, Variant variant, const Flight& flight, int views,
           report::ScatterChart& chart) {
  std::printf("\n%s, GeForce2 MX, %s: averages of %d views\n",
              variant == Variant::Published ? "published" : "conservative", flight.name, views);
  std::printf(
      "    window   triangles    slices  frames/s  all nodes  in view  speed-up over in view  "
      "optimum x  worst\n");
  const int windows[][2] = {{400, 300}, {512, 384}, {640, 480}, {800, 600}, {1024, 768}};
  for (const auto& [width, height] : windows) {
    Sums sums;
    for (int frame = 0; frame < views; ++frame) {
      const Camera camera = relative_to(view_of(flight, tree.field(), frame, views, width, height),
                                        tree.field().world_origin_m());
      CutOptions options;
      options.variant = variant;
      const SlicingCut cut = cut_tree(tree, camera, options);
      const double ratio = cut.cost_s / optimal_cut(tree, camera, options).cost_s;
      sums.triangles += triangles_of(tree, cut);
      sums.slices += static_cast<double>(cut.slices);
      sums.cost_s += cut.cost_s;
      const BruteForce brute = brute_force(tree, camera, options.profile);
      sums.all_s += brute.all_s;
      sums.in_view_s += brute.in_view_s;
      sums.ratio_to_optimum += ratio;
      sums.worst_to_optimum = std::max(sums.worst_to_optimum, ratio);
    }
    std::printf("%5d x %-4d %9.0f %9.0f %9.1f %10.1f %8.1f %22.2f %10.3f %6.2f\n", width, height,
                sums.triangles / views, sums.slices / views, views / sums.cost_s,
                views / sums.all_s, views / sums.in_view_s, sums.in_view_s / sums.cost_s,
                sums.ratio_to_optimum / views, sums.worst_to_optimum);
    std::fflush(stdout);
    if (sums.slices > 0.0) {
      chart.points.push_back(
          {sums.triangles / views, sums.slices / views,
           fmt::format("{} x {}, {}, {}", width, height,
                       variant == Variant::Published ? "published" : "conservative", flight.name)});
    }
  }
}

// How far the greedy descent is from the optimum, as its factor c changes.
void descent(const slicing::SlicingTree& tree, int views) {
  std::printf("\ngreedy cost / optimal cost, 800 x 600, mean and worst of %d views\n", views);
  std::printf("      variant");
  const double factors[] = {0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
  for (const double c : factors) std::printf("      c = %.1f    ", c);
  for (const Variant variant : {Variant::Published, Variant::Conservative}) {
    std::printf("\n%13s", variant == Variant::Published ? "published" : "conservative");
    for (const double c : factors) {
      double sum = 0.0, worst = 0.0;
      for (int frame = 0; frame < views; ++frame) {
        const Camera camera = relative_to(view_of(kWide, tree.field(), frame, views, 800, 600),
                                          tree.field().world_origin_m());
        CutOptions options;
        options.variant = variant;
        options.descend_factor = c;
        const double ratio =
            cut_tree(tree, camera, options).cost_s / optimal_cut(tree, camera, options).cost_s;
        sum += ratio;
        worst = std::max(worst, ratio);
      }
      std::printf("   %6.4f %6.3f", sum / views, worst);
    }
  }
  std::printf("\n");
  std::fflush(stdout);
}

template <class Work>
double least_s(const Work& work) {
  double least = 1e9;
  for (int run = 0; run < 5; ++run) {
    Stopwatch watch;
    work();
    least = std::min(least, watch.lap_s());
  }
  return least;
}

// Conservative at a pixel, 1280 x 720: the same view by rays through slices and through triangles.
void beside_the_caster(const slicing::SlicingTree& tree) {
  std::printf("\nconservative, 1 px, 1280 x 720, all threads, best of five\n");
  std::printf(
      "     view  caster s  rays s  times  slices s  times   fragments a pixel  hybrid s  times  "
      "against slices  against polygons\n");
  const reference::PyramidCaster caster(tree.field(), tree.diagonal());
  const slicing::HeightLookup heights(tree.field(), tree.diagonal());
  for (const char* view : {"oblique", "top", "grazing", "valley"}) {
    const Camera camera = bench_camera(view, 1280, 720);
    const Camera local = relative_to(camera, tree.field().world_origin_m());
    CutOptions options;
    options.hybrid = false;
    const SlicingCut slices = cut_tree(tree, local, options);
    const slicing::NodeMesh rest = mesh_of_nodes(tree, slices.polygons);
    options.hybrid = true;
    const SlicingCut hybrid = cut_tree(tree, local, options);
    const slicing::NodeMesh polygons = mesh_of_nodes(tree, hybrid.polygons);
    options.profile.pixels_per_s = 1e-3;  // no slice is worth it
    const SlicingCut none = cut_tree(tree, local, options);
    const slicing::NodeMesh all = mesh_of_nodes(tree, none.polygons);
    slicing::HybridFrame frame;
    const double caster_s = least_s([&] { caster.cast_frame(camera); });
    const double rays_s = least_s([&] { slice_rays(slices, local, heights); });
    const double slices_s =
        least_s([&] { frame = draw_frame(tree, slices, rest, camera, heights); });
    const double hybrid_s = least_s([&] { draw_frame(tree, hybrid, polygons, camera, heights); });
    const double all_s = least_s([&] { draw_frame(tree, none, all, camera, heights); });
    std::printf(
        "%9s %9.3f %7.3f %6.1f %9.3f %6.1f %19.1f %9.3f %6.1f %14.0f%% %16.0f%%\n", view, caster_s,
        rays_s, rays_s / caster_s, slices_s, slices_s / caster_s,
        static_cast<double>(frame.slice_fragments) / static_cast<double>(frame.image.size()),
        hybrid_s, hybrid_s / caster_s, 100.0 * (1.0 - hybrid_s / slices_s),
        100.0 * (1.0 - hybrid_s / all_s));
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  const int views = argc > 1 ? std::max(0, std::atoi(argv[1])) : 50;
  setenv("PLUMB_BENCH_TERRAIN", "generate:alpine?size=1025", 0);
  const plumb::slicing::SlicingTree tree(plumb::bench::bench_terrain(),
                                         plumb::terrain::Diagonal::Alternating);
  if (views > 0) {
    plumb::report::ScatterChart chart;
    chart.title = "Five windows, 400 x 300 to 1024 x 768, on two flights";
    chart.x_label = "triangles";
    chart.y_label = "slices";
    for (const auto variant :
         {plumb::slicing::Variant::Published, plumb::slicing::Variant::Conservative}) {
      for (const auto& flight : {plumb::bench::kWide, plumb::bench::kNear})
        plumb::bench::table(tree, variant, flight, views, chart);
    }
    if (argc > 2) plumb::write_file_atomically(argv[2], plumb::report::to_svg(chart));
    plumb::bench::descent(tree, views);
  }
  plumb::bench::beside_the_caster(tree);
  return 0;
}
