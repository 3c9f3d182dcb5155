#include "mesh/stacks/height_errors.h"

#include <algorithm>
#include <utility>

#include "core/parallel.h"
#include "core/screen_error.h"
#include "mesh/stacks/finest_surface.h"
#include "mesh/stacks/node_errors.h"

namespace plumb::mesh::stacks {
namespace {

constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};

HeightsReached both(const HeightsReached& a, const HeightsReached& b) {
  return {std::max(a.px, b.px), a.parts_over + b.parts_over, std::max(a.metres, b.metres),
          std::max(a.finest_m, b.finest_m)};
}

}  // namespace

// Heights in view may have what is drawn for them anywhere above or below.
Box HeightErrors::reach(const Node& node) const {
  Box box = drawn_box(densities_, node);
  box.low.z = std::min(box.low.z, static_cast<double>(densities_.field().low_m));
  box.high.z = std::max(box.high.z, densities_.field().high_m());
  return box;
}

double HeightErrors::apart_px(const Camera& camera, const Box& box, double distance_m) const {
  return displacement_bound_px(camera, box, kUp, distance_m);
}

std::vector<HeightErrors::Part> HeightErrors::measured(const DrawnMesh& drawn) const {
  std::vector<Part> parts;
  for (const std::vector<Corners>& triangles :
       parted(triangles_of(*drawn.mesh, densities_), densities_.box(drawn.node), kParts)) {
    Part part;
    bool is_over_heights = false;
    for (const Corners& triangle : triangles) {
      const double off = heights_->off_m(triangle);
      if (off < 0.0) continue;
      is_over_heights = true;
      part.off_m = std::max(part.off_m, off);
      for (const glm::dvec3& corner : triangle) part.box.add(corner);
    }
    if (!is_over_heights) continue;
    part.box.low.z -= part.off_m;
    part.box.high.z += part.off_m;
    parts.push_back(part);
  }
  return parts;
}

HeightErrors::Parts HeightErrors::parts(const DrawnMesh& drawn) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = parts_.find(drawn.mesh.get());
    if (found != parts_.end()) return found->second;
  }
  auto made = std::make_shared<const std::vector<Part>>(measured(drawn));
  const std::lock_guard lock(mutex_);
  return parts_.try_emplace(drawn.mesh.get(), std::move(made)).first->second;
}

bool HeightErrors::is_over_among_equals(const DrawnMesh& drawn, const std::function<NodeMeshes()>&,
                                        const Allowed& allowed) {
  return !over(drawn, {}, allowed).empty();
}

std::vector<Box> HeightErrors::over(const DrawnMesh& drawn, const NodeMeshes&,
                                    const Allowed& allowed) {
  std::vector<Box> over;
  if (drawn.mesh->faces.empty()) return over;
  for (const Part& part : *parts(drawn)) {
    if (allowed.is_wanted(part.box) && allowed.is_over(part.box, part.off_m))
      over.push_back(part.box);
  }
  return over;
}

HeightsReached HeightErrors::reached(std::span<const Node> nodes, const NodeMeshes& meshes,
                                     const Camera& camera, double tolerance_px) {
  return parallel_ordered_reduce(
      static_cast<std::int64_t>(nodes.size()), 16, HeightsReached{},
      [&](std::int64_t begin, std::int64_t end, HeightsReached so_far) {
        for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
          if (meshes[k]->faces.empty() || !may_be_in_view(camera, reach(nodes[k]))) continue;
          for (const Part& part : *parts({nodes[k], meshes[k]})) {
            if (!may_be_in_view(camera, part.box)) continue;
            HeightsReached of_part{apart_px(camera, part.box, part.off_m)};
            if (of_part.px > tolerance_px) {
              of_part.parts_over = 1;
              of_part.metres = part.off_m;
              if (nodes[k].level == 0) of_part.finest_m = part.off_m;
            }
            so_far = both(so_far, of_part);
          }
        }
        return so_far;
      },
      both);
}

}  // namespace plumb::mesh::stacks
