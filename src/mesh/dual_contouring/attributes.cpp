#include "mesh/dual_contouring/attributes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "core/triangle_mesh.h"

namespace plumb::mesh::dual_contouring {
namespace {

constexpr std::int64_t kRows = 64;  // a task

// Calls body(place, cell, scratch) for all active cells, rows side by side.
template <class Scratch, class Body>
void for_cells(const ActiveCells& active, const Body& body) {
  parallel_for(static_cast<std::int64_t>(active.rows()), kRows, [&](std::int64_t row) {
    const auto at = static_cast<std::size_t>(row);
    Scratch scratch;
    for (std::uint32_t k = active.first_cell[at]; k < active.first_cell[at + 1]; ++k)
      body(active.place(at, active.cells[k]), active.cells[k], scratch);
  });
}

void fill_corners(const Lattice<float>& density, const glm::ivec3& cell, bool with_gradients,
                  CellCorners& corners) {
  const std::ptrdiff_t row = density.box().size.x, slice = row * density.box().size.y;
  const float* low = &density(cell);
  for (int c = 0; c < 8; ++c)
    corners.density[static_cast<std::size_t>(c)] =
        low[(c & 1) + (c >> 1 & 1) * row + (c >> 2) * slice];
  if (with_gradients) corners.gradient = central_gradients(density, cell);
}

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  const double squared = v.x * v.x + v.y * v.y + v.z * v.z;
  return squared > 0.0 ? v / std::sqrt(squared) : glm::dvec3(0.0);
}

// Only where some gradient vanished; in the order of the faces.
void add_face_normals(std::span<const glm::dvec3> positions, std::span<const Quad> quads,
                      std::vector<glm::dvec3>& normals) {
  const auto is_zero = [](const glm::dvec3& n) { return n == glm::dvec3(0.0); };
  std::vector<std::uint8_t> missing(normals.size());
  std::transform(normals.begin(), normals.end(), missing.begin(), is_zero);
  if (std::find(missing.begin(), missing.end(), 1) == missing.end()) return;
  for (const Quad& quad : quads) {
    const glm::dvec3 normal =
        area_normal(positions[quad[0]], positions[quad[1]], positions[quad[2]]) +
        area_normal(positions[quad[0]], positions[quad[2]], positions[quad[3]]);
    for (const std::uint32_t vertex : quad) {
      if (missing[vertex] != 0) normals[vertex] += normal;
    }
  }
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (missing[v] != 0) normals[v] = unit_or_zero(normals[v]);
  }
}

}  // namespace

CellCorners corners_of(const Lattice<float>& density, const glm::ivec3& cell, bool with_gradients) {
  CellCorners corners;
  fill_corners(density, cell, with_gradients, corners);
  return corners;
}

std::vector<glm::dvec3> vertex_positions(const Lattice<float>& density, const ActiveCells& active,
                                         Placement placement) {
  std::vector<glm::dvec3> positions(active.vertices);
  const bool with_gradients = placement != Placement::Mean;
  for_cells<CellCorners>(
      active, [&](const glm::ivec3& place, const ActiveCell& cell, CellCorners& corners) {
        fill_corners(density, place, with_gradients, corners);
        const CellLoops& loops = active.loops(cell);
        for (std::size_t v = 0; v < cell.vertices; ++v)
          positions[cell.first_vertex + v] =
              glm::dvec3(place) + place_vertex(corners, loops.edges[v], placement);
      });
  return positions;
}

std::vector<glm::dvec3> vertex_normals(const Lattice<float>& density, const ActiveCells& active,
                                       std::span<const glm::dvec3> positions,
                                       std::span<const Quad> quads) {
  require(positions.size() == active.vertices, "{} vertices need as many positions, got {}",
          active.vertices, positions.size());
  std::vector<glm::dvec3> normals(positions.size());
  struct Nothing {};
  for_cells<Nothing>(active, [&](const glm::ivec3& place, const ActiveCell& cell, Nothing) {
    const std::array<glm::dvec3, 8> gradient = sobel_gradients(density, place);
    for (std::size_t v = cell.first_vertex; v < cell.first_vertex + cell.vertices; ++v)
      normals[v] = unit_or_zero(-trilinear(gradient, positions[v] - glm::dvec3(place)));
  });
  add_face_normals(positions, quads, normals);
  return normals;
}

std::vector<float> vertex_materials(std::span<const Lattice<float>> materials,
                                    const ActiveCells& active,
                                    std::span<const glm::dvec3> positions) {
  require(positions.size() == active.vertices, "{} vertices need as many positions, got {}",
          active.vertices, positions.size());
  std::vector<float> weights(positions.size() * materials.size());
  for_cells<CellCorners>(active, [&](const glm::ivec3& place, const ActiveCell& cell,
                                     CellCorners& corners) {
    for (std::size_t v = cell.first_vertex; v < cell.first_vertex + cell.vertices; ++v) {
      float* out = weights.data() + v * materials.size();
      double sum = 0.0;
      for (std::size_t m = 0; m < materials.size(); ++m) {
        fill_corners(materials[m], place, false, corners);
        out[m] = static_cast<float>(trilinear(corners.density, positions[v] - glm::dvec3(place)));
        sum += out[m];
      }
      if (!(sum > 0.0)) continue;
      for (std::size_t m = 0; m < materials.size(); ++m) out[m] = static_cast<float>(out[m] / sum);
    }
  });
  return weights;
}

}  // namespace plumb::mesh::dual_contouring
