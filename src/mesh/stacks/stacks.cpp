#include "mesh/stacks/stacks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"
#include "mesh/stacks/height_cut.h"
#include "mesh/stacks/joined_surface.h"
#include "mesh/stacks/node_errors.h"
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

// What a camera asks for, relative to (field().origin_m, 0).
struct Asked {
  Camera camera;
  Tolerance tolerance;
};

void add_claims_of_heights(const HeightsReached& reached, const Asked& asked, double voxel_m,
                           DrawnSurface& surface) {
  const bool is_out_of_reach = reached.px > asked.tolerance.value;
  const double bound = std::max(reached.px, asked.tolerance.value);
  for (const Measure measure : {Measure::SurfaceError, Measure::PixelError})
    surface.claims.push_back({measure, bound, Unit::Pixel, Scope::Frame, -1, is_out_of_reach});
  surface.out_of_reach_m = reached.metres;
  if (reached.finest_m > 0.0)
    surface.notes.push_back(fmt::format(
        "the finest level misses the tolerance in {} parts of nodes in view: in voxels of {:g} m "
        "it lies up to {:.3g} m above or below the heights there",
        reached.parts_over, voxel_m, reached.finest_m));
}

DrawnSurface surface_of(const Prepared& prepared, const Octree& octree,
                        const Asked* asked = nullptr) {
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
  if (HeightErrors* errors = prepared.errors_of_heights.get()) {
    cut_to_heights(errors->heights(), surface);
    if (asked != nullptr)
      add_claims_of_heights(errors->reached(nodes, meshes, asked->camera, asked->tolerance.value),
                            *asked, prepared.densities->field().voxel_m, surface);
  }
  return surface;
}

Octree octree_of(const Prepared& prepared) { return Octree(prepared.densities->size()); }

Asked asked_of(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance) {
  return {relative_to(camera, {prepared.densities->field().origin_m, 0.0}), tolerance};
}

Octree selection_of(const Prepared& prepared, const Asked& asked) {
  const StackDensities& densities = *prepared.densities;
  return prepared.errors == nullptr
             ? published_selection(densities, asked.camera, asked.tolerance)
             : conservative_selection(densities, *prepared.errors, *prepared.cache, asked.camera,
                                      asked.tolerance);
}

}  // namespace

Prepared prepare(terrain::StackField field, const Parameters& parameters,
                 const std::shared_ptr<const HeightSurface>& heights) {
  Prepared prepared;
  prepared.parameters = parameters;
  prepared.densities = std::make_shared<const StackDensities>(std::move(field), parameters.filter);
  const bool is_conservative = parameters.variant == Variant::Conservative,
             is_of_heights = is_conservative && heights != nullptr;
  NodeMeshOptions options{parameters.variant, parameters.placement,
                          glm::ivec2(prepared.densities->size())};
  if (prepared.densities->has_holes() && !is_of_heights) {
    options.is_hole = [densities = prepared.densities](int level, int i, int j) {
      return densities->is_hole(level, i, j);
    };
  }
  prepared.cache = std::make_shared<NodeCache>(prepared.densities, std::move(options));
  if (is_of_heights) {
    prepared.errors_of_heights = std::make_shared<HeightErrors>(*prepared.densities, heights);
    prepared.errors = prepared.errors_of_heights;
  } else if (is_conservative) {
    prepared.errors = std::make_shared<NodeErrors>(*prepared.densities, *prepared.cache);
  }
  return prepared;
}

DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance) {
  const Asked asked = asked_of(prepared, camera, tolerance);
  DrawnSurface surface = surface_of(prepared, selection_of(prepared, asked), &asked);
  if (prepared.errors != nullptr && prepared.errors_of_heights == nullptr)
    surface.claims.push_back({Measure::NearestError, tolerance.value, Unit::Pixel});
  return surface;
}

Run::Run(Prepared prepared, int budget)
    : prepared_(std::move(prepared)),
      tree_(prepared_.densities->size(),
            [densities = prepared_.densities](const Node& node, const Surroundings& around) {
              return may_have_faces(node, around,
                                    [&](int level, const dual_contouring::LatticeBox& box) {
                                      return densities->uniform(level, box);
                                    });
            }),
      budget_(budget) {
  require(budget >= 0, "a budget must be 0 or more node meshes, got {}", budget);
}

DrawnSurface Run::step(const Camera& camera, const Tolerance& tolerance) {
  if (budget_ == 0) return draw(prepared_, camera, tolerance);
  const Asked asked = asked_of(prepared_, camera, tolerance);
  const TreeChange change = tree_.step(selection_of(prepared_, asked), is_started_ ? budget_ : 0);
  is_started_ = true;
  DrawnSurface surface = surface_of(prepared_, tree_.tree(), &asked);
  surface.claims.clear();
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
