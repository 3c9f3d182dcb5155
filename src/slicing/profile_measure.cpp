#include "slicing/profile_measure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/stopwatch.h"
#include "raster/rasteriser.h"
#include "slicing/height_lookup.h"
#include "slicing/hybrid_frame.h"
#include "slicing/ray_slicer.h"

namespace plumb::slicing {
namespace {

template <class Work>
double least_time_s(int runs, const Work& work) {
  double least_s = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    Stopwatch watch;
    work();
    least_s = std::min(least_s, watch.lap_s());
  }
  return least_s;
}

// The same view in a picture of another size.
Camera resized(Camera camera, int width_px, int height_px) {
  const double x = static_cast<double>(width_px) / camera.width_px,
               y = static_cast<double>(height_px) / camera.height_px;
  camera.centre_px *= glm::dvec2(x, y);
  camera.gamma_h *= x;
  camera.gamma_v *= y;
  camera.width_px = width_px;
  camera.height_px = height_px;
  return camera;
}

std::vector<std::uint32_t> leaves_of(const SlicingTree& tree) {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t k = SlicingTree::first_of(tree.levels() - 1); k < tree.count(); ++k) {
    if (!tree.node(k).empty()) leaves.push_back(k);
  }
  return leaves;
}

}  // namespace

CostProfile ProfileMeasurement::profile(const std::string& name) const {
  require(vertices > 0 && fragments > 0 && vertices_s > 0.0 && fragments_s > 0.0,
          "a profile needs a view of the terrain: {} vertices and {} fragments were drawn",
          vertices, fragments);
  return {name, static_cast<double>(vertices) / vertices_s,
          static_cast<double>(fragments) / fragments_s};
}

ProfileMeasurement measure_profile(const SlicingTree& tree, const Camera& camera, int runs) {
  constexpr int kFewPixels = 32;
  ProfileMeasurement measured;
  const NodeMesh all = mesh_of_nodes(tree, leaves_of(tree));
  const Camera small = resized(camera, kFewPixels, kFewPixels);
  measured.vertices = static_cast<std::int64_t>(all.mesh.triangles.size()) * 10 / 8;
  measured.vertices_s = least_time_s(runs, [&] { raster::rasterise(all.mesh, small); });

  const Camera local = relative_to(camera, tree.field().world_origin_m());
  CutOptions options;
  options.variant = Variant::Published;
  options.hybrid = false;
  const SlicingCut cut = cut_tree(tree, local, options);
  const HeightLookup heights(tree.field(), tree.diagonal());
  measured.fragments_s =
      least_time_s(runs, [&] { measured.fragments = slice_rays(cut, local, heights).fragments; });
  return measured;
}

ModelledFrame model_frame(const SlicingTree& tree, const Camera& camera, const CostProfile& profile,
                          int runs) {
  CutOptions options;
  options.profile = profile;
  const SlicingCut cut =
      cut_tree(tree, relative_to(camera, tree.field().world_origin_m()), options);
  const NodeMesh polygons = mesh_of_nodes(tree, cut.polygons);
  const HeightLookup heights(tree.field(), tree.diagonal());
  return {cut.cost_s,
          least_time_s(runs, [&] { draw_frame(tree, cut, polygons, camera, heights); })};
}

ModelQuality quality_of(const std::vector<ModelledFrame>& frames) {
  ModelQuality quality;
  std::vector<double> ratios;
  std::vector<glm::dvec2> logarithms;
  glm::dvec2 sum(0.0);
  for (const ModelledFrame& frame : frames) {
    if (!(frame.predicted_s > 0.0) || !(frame.measured_s > 0.0)) continue;  // nothing was in view
    ratios.push_back(frame.predicted_s / frame.measured_s);
    logarithms.emplace_back(std::log(frame.predicted_s), std::log(frame.measured_s));
    sum += logarithms.back();
  }
  if (ratios.size() < 2) return quality;
  std::sort(ratios.begin(), ratios.end());
  quality.lower = ratios[ratios.size() / 4];
  quality.median = ratios[ratios.size() / 2];
  quality.upper = ratios[3 * ratios.size() / 4];
  const glm::dvec2 mean = sum / static_cast<double>(ratios.size());
  double pp = 0.0, mm = 0.0, pm = 0.0;
  for (const glm::dvec2& each : logarithms) {
    const glm::dvec2 off = each - mean;
    pp += off.x * off.x;
    mm += off.y * off.y;
    pm += off.x * off.y;
  }
  if (pp > 0.0 && mm > 0.0) quality.correlation = pm / std::sqrt(pp * mm);
  return quality;
}

}  // namespace plumb::slicing
