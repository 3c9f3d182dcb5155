#include "mesh/restricted_quadtree/restricted_quadtree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "core/check.h"
#include "core/screen_error.h"
#include "mesh/restricted_quadtree/refinement.h"

namespace plumb::mesh::restricted_quadtree {
namespace {

constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};

// Writes the leaves of a refinement as an indexed mesh with patches and their measured bounds.
class Emitter {
 public:
  Emitter(const Prepared& prepared, const Refinement& refinement)
      : prepared_(prepared),
        refinement_(refinement),
        field_(*prepared.field),
        patch_level_(2 * std::countr_zero(static_cast<unsigned>(prepared.parameters.patch_cells))),
        vertex_(field_.columns(), field_.rows(), kNoPrimitive) {
    mesh_->origin_m = field_.world_origin_m();
  }

  DrawnSurface take() {
    for (const BinTriangle& root : root_triangles(prepared_.errors->root_side())) walk(root);
    surface_.cost.vertices = static_cast<std::int64_t>(mesh_->vertices_m.size());
    surface_.cost.triangles = static_cast<std::int64_t>(mesh_->triangles.size());
    surface_.mesh = std::move(mesh_);
    return std::move(surface_);
  }

 private:
  // Above the patches' size every leaf is a patch of its own; below it, all leaves of a subtree are
  // one.
  void walk(const BinTriangle& triangle) {
    if (level_above_finest(triangle) > patch_level_ && refinement_.is_split(triangle)) {
      for (const BinTriangle& child : children(triangle)) walk(child);
      return;
    }
    Patch patch;
    patch.first_triangle = static_cast<std::uint32_t>(mesh_->triangles.size());
    bound_m_ = 0.0;
    leaves_of(triangle, patch);
    patch.triangle_count =
        static_cast<std::uint32_t>(mesh_->triangles.size()) - patch.first_triangle;
    if (patch.triangle_count == 0) return;
    const auto [i0, i1] = std::minmax({triangle.a.i, triangle.b.i, triangle.c.i});
    const auto [j0, j1] = std::minmax({triangle.a.j, triangle.b.j, triangle.c.j});
    patch.name = fmt::format("samples {}..{} x {}..{}", i0, i1, j0, j1);
    const int index = static_cast<int>(surface_.patches.size());
    surface_.claims.push_back({Measure::SampleError, bound_m_, Unit::Metre, Scope::Patch, index});
    surface_.patches.push_back(std::move(patch));
  }

  void leaves_of(const BinTriangle& triangle, Patch& patch) {
    if (refinement_.is_split(triangle)) {
      for (const BinTriangle& child : children(triangle)) leaves_of(child, patch);
      return;
    }
    if (is_finest(triangle)) {
      if (!prepared_.errors->finest_exists(triangle)) return;
    } else {
      const float error = prepared_.errors->error(triangle);
      if (error == TriangleErrors::kEmpty) return;
      bound_m_ = std::max(bound_m_, static_cast<double>(error));
    }
    const int lod = level_above_finest(triangle);
    patch.lod = std::max(patch.lod, lod);
    mesh_->triangles.push_back(
        {vertex_of(triangle.a), vertex_of(triangle.b), vertex_of(triangle.c)});
    surface_.triangle_lod.push_back(static_cast<std::uint8_t>(lod));
  }

  std::uint32_t vertex_of(Corner corner) {
    std::uint32_t& vertex = vertex_(corner.i, corner.j);
    if (vertex == kNoPrimitive) {
      vertex = static_cast<std::uint32_t>(mesh_->vertices_m.size());
      mesh_->vertices_m.emplace_back(corner.i * field_.dx_m, corner.j * field_.dy_m,
                                     field_.heights_m(corner.i, corner.j));
    }
    return vertex;
  }

  const Prepared& prepared_;
  const Refinement& refinement_;
  const terrain::Heightfield& field_;
  int patch_level_;
  Grid<std::uint32_t> vertex_;
  std::shared_ptr<TriangleMesh> mesh_ = std::make_shared<TriangleMesh>();
  DrawnSurface surface_;
  double bound_m_ = 0.0;
};

// Claims in the tolerance's own unit; nested in the truth, so that what holds at samples holds
// between them as well.
std::vector<Claim> frame_claims(const Tolerance& tolerance) {
  std::vector<Claim> claims{{Measure::SampleError, tolerance.value, tolerance.unit},
                            {Measure::SurfaceError, tolerance.value, tolerance.unit}};
  if (tolerance.unit == Unit::Pixel)
    claims.push_back({Measure::PixelError, tolerance.value, Unit::Pixel});
  return claims;
}

}  // namespace

Prepared prepare(const terrain::Heightfield& field, const Parameters& parameters) {
  terrain::require_valid(field);
  require(parameters.patch_cells >= 2 &&
              std::has_single_bit(static_cast<unsigned>(parameters.patch_cells)),
          "patch_cells must be a power of two >= 2, got {}", parameters.patch_cells);
  return {&field, parameters, std::make_shared<TriangleErrors>(field),
          std::make_shared<HeightBounds>(field)};
}

DrawnSurface draw(const Prepared& prepared, const Camera& camera, const Tolerance& tolerance) {
  require(tolerance.unit != Unit::Count && tolerance.value >= 0.0,
          "tolerance must be >= 0 metres or pixels, got {}", tolerance.value);
  const terrain::Heightfield& field = *prepared.field;
  Refinement refinement(field, *prepared.errors);
  if (tolerance.unit == Unit::Metre) {
    refinement.refine([&](const BinTriangle&, float error_m) { return error_m > tolerance.value; });
  } else {
    const Camera local = relative_to(camera, field.world_origin_m());
    refinement.refine([&](const BinTriangle& triangle, float error_m) {
      return error_m > 0.0f &&
             error_m > allowed_displacement_m(local, prepared.bounds->box(triangle), kUp,
                                              tolerance.value);
    });
  }
  DrawnSurface surface = Emitter(prepared, refinement).take();
  const std::vector<Claim> claims = frame_claims(tolerance);
  surface.claims.insert(surface.claims.begin(), claims.begin(), claims.end());
  surface.cost.nodes_visited = refinement.triangles_visited();
  surface.cost.bytes_resident = prepared.errors->bytes() + prepared.bounds->bytes() +
                                static_cast<std::int64_t>(field.heights_m.size() * sizeof(float));
  return surface;
}

}  // namespace plumb::mesh::restricted_quadtree
