#include "mesh/tessellation/patch_joiner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumb::mesh::tessellation {

using patch_quadtree::PatchPlace;

PatchJoiner::PatchJoiner(const Prepared& prepared, const PatchSelection& selection,
                         const std::vector<Grid<float>>& heights_m, const ChosenLevels& levels)
    : prepared_(prepared), selection_(selection), heights_m_(heights_m), levels_(levels) {
  mesh_->origin_m = {prepared.header().origin_m, 0.0};
  surface_.kinds = {"ground", "skirts"};
}

void PatchJoiner::add(std::size_t at, const PatchMesh& drawn, const Rims& rims) {
  const PatchPlace& place = selection_.drawn[at];
  const int n = prepared_.header().layout.patch_cells;
  std::vector<std::uint32_t> number;
  number.reserve(drawn.points.size());
  for (const PatchPoint& point : drawn.points) {
    const bool on_rim = point.i == 0 || point.j == 0 || point.i == n || point.j == n;
    number.push_back(on_rim ? rim_vertex(at, point) : new_vertex(position(at, point)));
  }
  begin_patch(place, "", 0);
  for (std::size_t k = 0; k < drawn.triangles.size(); ++k) {
    const Triangle& t = drawn.triangles[k];
    mesh_->triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    surface_.triangle_lod.push_back(static_cast<std::uint8_t>(place.level + drawn.thinned[k]));
  }
  if (end_patch()) claim_patch(at);
  begin_patch(place, "skirts of ", 1);
  for (const SeamTriangle& seam : rims.seams) wall(place.level, seam);
  for (const Skirt& skirt : rims.skirts) hang(at, skirt);
  end_patch();
}

DrawnSurface PatchJoiner::take() {
  surface_.cost.vertices = static_cast<std::int64_t>(mesh_->vertices_m.size());
  surface_.cost.triangles = static_cast<std::int64_t>(mesh_->triangles.size());
  surface_.mesh = std::move(mesh_);
  return std::move(surface_);
}

glm::dvec3 PatchJoiner::position(std::size_t at, const PatchPoint& point) const {
  const auto& header = prepared_.header();
  const PatchPlace& place = selection_.drawn[at];
  return {header.layout.sample_column(place, point.i) * header.dx_m,
          header.layout.sample_row(place, point.j) * header.dy_m,
          double{heights_m_[at](point.i + 1, point.j + 1)}};
}

std::uint32_t PatchJoiner::new_vertex(const glm::dvec3& place) {
  mesh_->vertices_m.push_back(place);
  return static_cast<std::uint32_t>(mesh_->vertices_m.size() - 1);
}

std::uint32_t PatchJoiner::rim_vertex(std::size_t at, const PatchPoint& point) {
  const auto& layout = prepared_.header().layout;
  const PatchPlace& place = selection_.drawn[at];
  const std::int64_t key = std::int64_t{layout.sample_row(place, point.j)} * layout.columns +
                           layout.sample_column(place, point.i);
  const float height_m = heights_m_[at](point.i + 1, point.j + 1);
  std::vector<RimVertex>& here = rim_[key];
  for (const RimVertex& vertex : here)
    if (vertex.height_m == height_m) return vertex.number;
  here.push_back({height_m, new_vertex(position(at, point))});
  return here.back().number;
}

void PatchJoiner::wall(int level, const SeamTriangle& seam) {
  Triangle triangle{};
  for (std::size_t k = 0; k < 3; ++k)
    triangle[k] = seam[k].drawn >= 0
                      ? rim_vertex(static_cast<std::size_t>(seam[k].drawn), seam[k].point)
                      : new_vertex(seam[k].place_m);
  mesh_->triangles.push_back(triangle);
  surface_.triangle_lod.push_back(static_cast<std::uint8_t>(level));
  ++rim_triangles_;
}

// Two triangles for each piece of the top; none where there is no height, or beyond the terrain.
void PatchJoiner::hang(std::size_t at, const Skirt& skirt) {
  if (skirt.depth_m == 0.0) return;
  for (std::size_t k = 0; k + 1 < skirt.top.size(); ++k) {
    const glm::dvec3 a = position(at, skirt.top[k]), b = position(at, skirt.top[k + 1]);
    if (std::isnan(a.z) || std::isnan(b.z) || (a.x == b.x && a.y == b.y)) continue;
    const glm::dvec3 down{0.0, 0.0, skirt.depth_m};
    const std::uint32_t top_a = rim_vertex(at, skirt.top[k]),
                        top_b = rim_vertex(at, skirt.top[k + 1]);
    const std::uint32_t low_a = new_vertex(a - down), low_b = new_vertex(b - down);
    mesh_->triangles.push_back({low_a, low_b, top_b});
    mesh_->triangles.push_back({low_a, top_b, top_a});
    const auto lod = static_cast<std::uint8_t>(selection_.drawn[at].level);
    surface_.triangle_lod.insert(surface_.triangle_lod.end(), 2, lod);
    rim_triangles_ += 2;
  }
}

void PatchJoiner::begin_patch(const PatchPlace& place, const char* what, int kind) {
  Patch patch;
  patch.first_triangle = static_cast<std::uint32_t>(mesh_->triangles.size());
  patch.lod = place.level;
  patch.name = fmt::format("{}patch ({}, {}) of level {}", what, place.px, place.py, place.level);
  patch.kind = kind;
  surface_.patches.push_back(std::move(patch));
}

// False if there is nothing in it: then it is no patch.
bool PatchJoiner::end_patch() {
  Patch& patch = surface_.patches.back();
  patch.triangle_count = static_cast<std::uint32_t>(mesh_->triangles.size()) - patch.first_triangle;
  if (patch.triangle_count > 0) return true;
  surface_.patches.pop_back();
  return false;
}

void PatchJoiner::claim_patch(std::size_t at) {
  double bound_m = 0.0;
  for (const double bound : levels_.patches[at].bound_m.values())
    bound_m = std::max(bound_m, bound);
  surface_.claims.push_back({Measure::SampleError, bound_m, Unit::Metre, Scope::Patch,
                             static_cast<int>(surface_.patches.size()) - 1});
}

}  // namespace plumb::mesh::tessellation
