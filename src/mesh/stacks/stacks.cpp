#include "mesh/stacks/stacks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"
#include "mesh/stacks/joined_surface.h"
#include "mesh/stacks/selection.h"

namespace plumb::mesh::stacks {
namespace {

// Names, levels and triangles of what is joined.
class Finisher {
 public:
  Finisher(const StackDensities& densities, std::span<const Node> nodes,
           const JoinedSurface& joined)
      : densities_(densities), nodes_(nodes), joined_(joined) {}

  DrawnSurface surface() {
    mesh_->origin_m = {densities_.field().origin_m, 0.0};
    for (const glm::dvec3& place : joined_.position)
      mesh_->vertices_m.push_back(densities_.metres(place));
    surface_.vertex_colours = joined_.colour;
    for (std::size_t k = 0; k < nodes_.size(); ++k) add_node(k);
    surface_.cost.vertices = static_cast<std::int64_t>(mesh_->vertices_m.size());
    surface_.cost.triangles = static_cast<std::int64_t>(mesh_->triangles.size());
    surface_.mesh = std::move(mesh_);
    return std::move(surface_);
  }

 private:
  void add_node(std::size_t k) {
    const Node& node = nodes_[k];
    Patch patch;
    patch.first_triangle = static_cast<std::uint32_t>(mesh_->triangles.size());
    for (std::uint32_t f = joined_.first_face[k]; f < joined_.first_face[k + 1]; ++f) {
      const Face& face = joined_.faces[f];
      mesh_->triangles.push_back({face[0], face[1], face[2]});
      if (face[3] != kNoCorner) mesh_->triangles.push_back({face[0], face[2], face[3]});
    }
    patch.triangle_count =
        static_cast<std::uint32_t>(mesh_->triangles.size()) - patch.first_triangle;
    if (patch.triangle_count == 0) return;
    patch.lod = node.level;
    patch.name =
        fmt::format("node ({}, {}, {}) of level {}", node.at.x, node.at.y, node.at.z, node.level);
    surface_.triangle_lod.insert(surface_.triangle_lod.end(), patch.triangle_count,
                                 static_cast<std::uint8_t>(node.level));
    surface_.patches.push_back(std::move(patch));
  }

  const StackDensities& densities_;
  std::span<const Node> nodes_;
  const JoinedSurface& joined_;
  std::shared_ptr<TriangleMesh> mesh_ = std::make_shared<TriangleMesh>();
  DrawnSurface surface_;
};

DrawnSurface surface_of(const Prepared& prepared, const Octree& octree) {
  const std::vector<Node> nodes = octree.drawn();
  const auto meshes = prepared.cache->meshes(octree, nodes);
  std::vector<const NodeMesh*> pointers;
  std::int64_t vanished = 0;
  for (const auto& mesh : meshes) {
    pointers.push_back(mesh.get());
    vanished += mesh->faces_vanished;
  }
  DrawnSurface surface = Finisher(*prepared.densities, nodes, joined(pointers)).surface();
  surface.cost.nodes_visited = static_cast<std::int64_t>(nodes.size());
  surface.cost.bytes_resident = static_cast<std::int64_t>(prepared.densities->bytes());
  for (const auto& mesh : meshes)
    surface.cost.bytes_resident += static_cast<std::int64_t>(mesh->bytes());
  surface.notes.push_back(
      fmt::format("{} nodes drawn, {} with a surface; {} faces between levels fell together",
                  nodes.size(), surface.patches.size(), vanished));
  return surface;
}

Octree octree_of(const Prepared& prepared) { return Octree(prepared.densities->size()); }

Octree selection_of(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance) {
  const StackDensities& densities = *prepared.densities;
  const Camera local = relative_to(camera, {densities.field().origin_m, 0.0});
  return prepared.errors == nullptr ? published_selection(densities, local, tolerance)
                                    : conservative_selection(densities, *prepared.errors,
                                                             *prepared.cache, local, tolerance);
}

}  // namespace

Prepared prepare(terrain::StackField field, const Parameters& parameters) {
  Prepared prepared;
  prepared.parameters = parameters;
  prepared.densities = std::make_shared<const StackDensities>(std::move(field), parameters.filter);
  NodeMeshOptions options{parameters.variant, parameters.placement,
                          glm::ivec2(prepared.densities->size())};
  if (prepared.densities->has_holes()) {
    options.is_hole = [densities = prepared.densities](int level, int i, int j) {
      return densities->is_hole(level, i, j);
    };
  }
  prepared.cache = std::make_shared<NodeCache>(prepared.densities, std::move(options));
  if (parameters.variant == Variant::Conservative)
    prepared.errors = std::make_shared<NodeErrors>(*prepared.densities, *prepared.cache);
  return prepared;
}

DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance) {
  DrawnSurface surface = surface_of(prepared, selection_of(prepared, camera, tolerance));
  if (prepared.errors != nullptr && prepared.parameters.is_truth)
    surface.claims.push_back({Measure::NearestError, tolerance.value, Unit::Pixel});
  return surface;
}

Run::Run(Prepared prepared, int budget)
    : prepared_(std::move(prepared)), tree_(prepared_.densities->size()), budget_(budget) {
  require(budget >= 0, "a budget must be 0 or more node meshes, got {}", budget);
}

DrawnSurface Run::step(const Camera& camera, const Tolerance& tolerance) {
  if (budget_ == 0) return draw(prepared_, camera, tolerance);
  const TreeChange change =
      tree_.step(selection_of(prepared_, camera, tolerance), is_started_ ? budget_ : 0);
  is_started_ = true;
  DrawnSurface surface = surface_of(prepared_, tree_.tree());
  surface.notes.push_back(
      fmt::format("{} nodes split, {} merged, {} meshes made in this frame; {} changes wait",
                  change.splits, change.merges, change.updated, change.wanting));
  return surface;
}

DrawnSurface finest(const Prepared& prepared) {
  Octree octree = octree_of(prepared);
  octree.divide([](const Node&) { return true; });
  return surface_of(prepared, octree);
}

}  // namespace plumb::mesh::stacks
