#include "mesh/full/full_detail.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/memory.h"

namespace plumb::mesh::full {
namespace {

using terrain::Heightfield;

constexpr int kPatchCells = 64;

struct Sample {
  int i, j;
};

// The two triangles of a cell, counter-clockwise.
std::array<std::array<Sample, 3>, 2> triangles_of_cell(terrain::Diagonal diagonal, int i, int j) {
  const Sample sw{i, j}, se{i + 1, j}, nw{i, j + 1}, ne{i + 1, j + 1};
  if (rises_north_east(diagonal, i, j)) return {{{sw, se, ne}, {sw, ne, nw}}};
  return {{{sw, se, nw}, {se, ne, nw}}};
}

// Calls visit(corners) for each triangle of cells [i0, i1) x [j0, j1) that exists.
template <class Visit>
void for_each_triangle(const Heightfield& field, terrain::Diagonal diagonal, int i0, int j0, int i1,
                       int j1, const Visit& visit) {
  for (int j = j0; j < j1; ++j) {
    for (int i = i0; i < i1; ++i) {
      for (const auto& corners : triangles_of_cell(diagonal, i, j)) {
        const bool exists = std::none_of(corners.begin(), corners.end(),
                                         [&](Sample s) { return field.is_void(s.i, s.j); });
        if (exists) visit(corners);
      }
    }
  }
}

// The vertex of each sample that a triangle uses, numbered row by row; kNoPrimitive for the others.
Grid<std::uint32_t> number_vertices(const Heightfield& field, terrain::Diagonal diagonal,
                                    TriangleMesh& mesh) {
  Grid<std::uint32_t> vertex(field.columns(), field.rows(), kNoPrimitive);
  for_each_triangle(field, diagonal, 0, 0, field.cell_columns(), field.cell_rows(),
                    [&](const std::array<Sample, 3>& corners) {
                      for (const Sample s : corners) vertex(s.i, s.j) = 0;
                    });
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      if (vertex(i, j) == kNoPrimitive) continue;
      vertex(i, j) = static_cast<std::uint32_t>(mesh.vertices_m.size());
      mesh.vertices_m.emplace_back(i * field.dx_m, j * field.dy_m, field.heights_m(i, j));
    }
  }
  return vertex;
}

}  // namespace

Prepared prepare(const Heightfield& field, const Parameters& parameters) {
  terrain::require_valid(field);
  const std::int64_t samples = static_cast<std::int64_t>(field.columns()) * field.rows();
  require_memory(samples * static_cast<std::int64_t>(sizeof(glm::dvec3) + 2 * sizeof(Triangle) +
                                                     sizeof(std::uint32_t)),
                 "the full-detail mesh");
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->origin_m = field.world_origin_m();
  mesh->vertices_m.reserve(static_cast<std::size_t>(samples));
  const Grid<std::uint32_t> vertex = number_vertices(field, parameters.diagonal, *mesh);

  DrawnSurface surface;
  mesh->triangles.reserve(2 * static_cast<std::size_t>(samples));
  for (int j = 0; j < field.cell_rows(); j += kPatchCells) {
    for (int i = 0; i < field.cell_columns(); i += kPatchCells) {
      const int i1 = std::min(i + kPatchCells, field.cell_columns()),
                j1 = std::min(j + kPatchCells, field.cell_rows());
      const auto first = static_cast<std::uint32_t>(mesh->triangles.size());
      for_each_triangle(field, parameters.diagonal, i, j, i1, j1,
                        [&](const std::array<Sample, 3>& corners) {
                          mesh->triangles.push_back({vertex(corners[0].i, corners[0].j),
                                                     vertex(corners[1].i, corners[1].j),
                                                     vertex(corners[2].i, corners[2].j)});
                        });
      const auto count = static_cast<std::uint32_t>(mesh->triangles.size()) - first;
      if (count > 0)
        surface.patches.push_back(
            {first, count, 0, fmt::format("cells {}..{} x {}..{}", i, i1 - 1, j, j1 - 1)});
    }
  }
  surface.claims = {{Measure::SampleError, 0.0, Unit::Metre},
                    {Measure::SampleError, 0.0, Unit::Pixel},
                    {Measure::SurfaceError, 0.0, Unit::Metre},
                    {Measure::PixelError, 0.0, Unit::Pixel}};
  surface.cost.vertices = static_cast<std::int64_t>(mesh->vertices_m.size());
  surface.cost.triangles = static_cast<std::int64_t>(mesh->triangles.size());
  surface.cost.bytes_resident =
      surface.cost.vertices * static_cast<std::int64_t>(sizeof(glm::dvec3)) +
      surface.cost.triangles * static_cast<std::int64_t>(sizeof(Triangle));
  surface.mesh = std::move(mesh);
  surface.runs = std::make_shared<const MeshRuns>(surface.mesh);
  return {std::move(surface)};
}

DrawnSurface draw(const Prepared& prepared, const Camera&, const Tolerance&) {
  return prepared.surface;
}

}  // namespace plumb::mesh::full
