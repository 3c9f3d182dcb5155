#include "mesh/stacks/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/screen_error.h"
#include "mesh/stacks/drawn_errors.h"

namespace plumb::mesh::stacks {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distance_m(const Camera& camera, const Box& box) {
  return std::sqrt(squared_distance(camera.eye_m, box));
}

double edge_m(const StackDensities& densities, const Node& node) {
  const terrain::StackField& field = densities.field();
  return kNodeVoxels * static_cast<double>(1 << node.level) *
         std::max({field.dx_m, field.dy_m, field.voxel_m});
}

// The tangent of the largest angle between the view's axis and a pixel.
double corner_tangent(const Camera& camera) {
  const double x = std::max(camera.centre_px.x, camera.width_px - camera.centre_px.x),
               y = std::max(camera.centre_px.y, camera.height_px - camera.centre_px.y);
  return std::sqrt(x * x / (camera.gamma_h * camera.gamma_h) +
                   y * y / (camera.gamma_v * camera.gamma_v));
}

// What a node draws: its voxels and the cells that reach beyond them, a coarser level's included.
Box drawn_box(const StackDensities& densities, const Node& node) {
  const terrain::StackField& field = densities.field();
  Box box = densities.box(node);
  const glm::dvec3 reach = 2.0 * static_cast<double>(1 << node.level) *
                           glm::dvec3(field.dx_m, field.dy_m, field.voxel_m);
  box.low -= reach;
  box.high += reach;
  return box;
}

// Divides what is coarser around a node, or else the node itself; false if there is nothing.
bool refine_around(Octree& octree, const Node& node) {
  bool changed = false;
  for_each_around(node, [&](const Node& beside) {
    for_each_around(beside, [&](const Node& far) {
      if (!octree.is_inside(far) || octree.exists(far)) return;
      Node holder = far.parent();
      while (!octree.exists(holder)) holder = holder.parent();
      octree.divide(holder);
      changed = true;
    });
  });
  if (changed || node.level == 0 || !octree.is_drawn(node)) return changed;
  octree.divide(node);
  return true;
}

}  // namespace

double extent_px(const Camera& camera, const Box& box, double edge_m) {
  const double distance = distance_m(camera, box);
  return distance > 0.0 ? edge_m * camera.gamma_h / distance : kInfinity;
}

double apart_px(const Camera& camera, const Box& box, double distance_m) {
  if (!(distance_m > 0.0)) return 0.0;
  const double away = stacks::distance_m(camera, box);
  if (!(distance_m < away)) return kInfinity;
  const double t = distance_m / std::sqrt((away - distance_m) * (away + distance_m)),
               s = corner_tangent(camera);
  return s * t < 1.0 ? std::max(camera.gamma_h, camera.gamma_v) * t * (1.0 + s * s) / (1.0 - s * t)
                     : kInfinity;
}

Octree published_selection(const StackDensities& densities, const Camera& camera,
                           const Tolerance& tolerance) {
  Octree octree(densities.size());
  octree.divide([&](const Node& node) {
    return extent_px(camera, densities.box(node), edge_m(densities, node)) > tolerance.value;
  });
  octree.balance();
  return octree;
}

Octree conservative_selection(const StackDensities& densities, const LevelErrors& levels,
                              NodeCache& cache, const Camera& camera, const Tolerance& tolerance) {
  const auto is_seen = [&](const Node& node) {
    return may_be_in_view(camera, drawn_box(densities, node));
  };
  const auto is_over = [&](const Node& node, double bound_m) {
    return apart_px(camera, drawn_box(densities, node), bound_m) > tolerance.value;
  };
  Octree octree(densities.size());
  octree.divide(
      [&](const Node& node) { return is_seen(node) && is_over(node, levels.worst_m(node)); });
  DrawnErrors errors(densities, levels);
  for (bool changed = true; changed;) {
    octree.balance();
    const std::vector<Node> nodes = octree.drawn();
    std::vector<std::uint8_t> seen;
    for (const Node& node : nodes) seen.push_back(is_seen(node) ? 1 : 0);
    const std::vector<double> bounds =
        errors.bounds_m(octree, nodes, cache.meshes(octree, nodes), seen);
    changed = false;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (seen[k] != 0 && is_over(nodes[k], bounds[k]))
        changed = refine_around(octree, nodes[k]) || changed;
    }
  }
  return octree;
}

}  // namespace plumb::mesh::stacks
