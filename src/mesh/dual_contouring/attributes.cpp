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

glm::ivec3 corner_of(int corner) { return {corner & 1, corner >> 1 & 1, corner >> 2}; }

double at_border(const Lattice<float>& density, const glm::ivec3& p) {
  const glm::ivec3 low = density.box().low, high = density.box().high() - 1;
  return density({std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y),
                  std::clamp(p.z, low.z, high.z)});
}

// Calls body(row, cell) for all active cells, rows side by side.
template <class Body>
void for_cells(const ActiveCells& active, const Body& body) {
  parallel_for(static_cast<std::int64_t>(active.rows()), kRows, [&](std::int64_t row) {
    const auto at = static_cast<std::size_t>(row);
    for (std::uint32_t k = active.first_cell[at]; k < active.first_cell[at + 1]; ++k)
      body(at, active.cells[k]);
  });
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

glm::dvec3 central_gradient(const Lattice<float>& density, const glm::ivec3& sample) {
  const LatticeBox& box = density.box();
  glm::dvec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    glm::ivec3 before = sample, after = sample;
    before[axis] = std::max(sample[axis] - 1, box.low[axis]);
    after[axis] = std::min(sample[axis] + 1, box.high()[axis] - 1);
    const int apart = after[axis] - before[axis];
    gradient[axis] = apart == 0 ? 0.0 : (double{density(after)} - double{density(before)}) / apart;
  }
  return gradient;
}

glm::dvec3 sobel_gradient(const Lattice<float>& density, const glm::ivec3& sample) {
  glm::dvec3 gradient(0.0);
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const double value = at_border(density, sample + glm::ivec3(x, y, z));
        const int wx = 2 - std::abs(x), wy = 2 - std::abs(y), wz = 2 - std::abs(z);
        gradient += value * glm::dvec3(x * wy * wz, wx * y * wz, wx * wy * z);
      }
    }
  }
  return gradient / 32.0;
}

CellCorners corners_of(const Lattice<float>& density, const glm::ivec3& cell, bool with_gradients) {
  CellCorners corners;
  for (int c = 0; c < 8; ++c) {
    const glm::ivec3 sample = cell + corner_of(c);
    corners.density[static_cast<std::size_t>(c)] = density(sample);
    if (with_gradients)
      corners.gradient[static_cast<std::size_t>(c)] = central_gradient(density, sample);
  }
  return corners;
}

std::vector<glm::dvec3> vertex_positions(const Lattice<float>& density, const ActiveCells& active,
                                         Placement placement) {
  std::vector<glm::dvec3> positions(active.vertices);
  for_cells(active, [&](std::size_t row, const ActiveCell& cell) {
    const glm::ivec3 place = active.place(row, cell);
    const CellCorners corners = corners_of(density, place, placement != Placement::Mean);
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
  for_cells(active, [&](std::size_t row, const ActiveCell& cell) {
    const glm::ivec3 place = active.place(row, cell);
    std::array<glm::dvec3, 8> gradient;
    for (int c = 0; c < 8; ++c)
      gradient[static_cast<std::size_t>(c)] = sobel_gradient(density, place + corner_of(c));
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
  for_cells(active, [&](std::size_t row, const ActiveCell& cell) {
    const glm::ivec3 place = active.place(row, cell);
    for (std::size_t v = cell.first_vertex; v < cell.first_vertex + cell.vertices; ++v) {
      float* out = weights.data() + v * materials.size();
      double sum = 0.0;
      for (std::size_t m = 0; m < materials.size(); ++m) {
        const CellCorners corners = corners_of(materials[m], place, false);
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
