#include "mesh/stacks/node_colours.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace plumb::mesh::stacks {

using dual_contouring::Lattice;
using dual_contouring::LatticeBox;

namespace {

// A run of vertices of one level, and the box of their cells' samples.
struct LevelRun {
  std::size_t first = 0, last = 0;
  LatticeBox samples;
};

LevelRun run_from(const NodeMesh& mesh, std::size_t first) {
  LevelRun run{first, first, {}};
  glm::ivec3 low = mesh.names[first].cell, high = low;
  while (run.last < mesh.names.size() && mesh.names[run.last].level == mesh.names[first].level) {
    const glm::ivec3& cell = mesh.names[run.last++].cell;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], cell[axis]);
      high[axis] = std::max(high[axis], cell[axis]);
    }
  }
  run.samples = {low, high - low + 2};
  return run;
}

double density_at(const Lattice<float>& densities, const glm::ivec3& cell, const glm::dvec3& at) {
  std::array<float, 8> corners{};
  for (int k = 0; k < 8; ++k)
    corners[static_cast<std::size_t>(k)] = densities(cell + glm::ivec3(k & 1, k >> 1 & 1, k >> 2));
  return dual_contouring::trilinear(corners, at);
}

// The vertex in its cell's own coordinates; one that was moved onto the rim stays in the cell.
glm::dvec3 within_cell(const NodeMesh& mesh, std::size_t k) {
  const VertexName& name = mesh.names[k];
  glm::dvec3 at =
      mesh.position[k] / static_cast<double>(1 << name.level) - (glm::dvec3(name.cell) + 0.5);
  for (int axis = 0; axis < 3; ++axis) at[axis] = std::clamp(at[axis], 0.0, 1.0);
  return at;
}

}  // namespace

std::vector<glm::vec3> node_colours(const NodeMesh& mesh, const StackDensities& densities) {
  const auto& materials = densities.field().materials;
  std::vector<glm::dvec3> sum(mesh.names.size(), glm::dvec3(0.0));
  std::vector<double> weight(mesh.names.size(), 0.0);
  for (std::size_t first = 0; first < mesh.names.size();) {
    const LevelRun run = run_from(mesh, first);
    const int level = mesh.names[first].level;
    for (const terrain::Material m : densities.materials_in(level, run.samples)) {
      const Lattice<float> of_material = densities.of_material(level, m, run.samples);
      for (std::size_t k = run.first; k < run.last; ++k) {
        const double density = density_at(of_material, mesh.names[k].cell, within_cell(mesh, k));
        sum[k] += density * materials[m].colour;
        weight[k] += density;
      }
    }
    first = run.last;
  }
  std::vector<glm::vec3> colours;
  colours.reserve(sum.size());
  for (std::size_t k = 0; k < sum.size(); ++k)
    colours.emplace_back(weight[k] > 0.0 ? sum[k] / weight[k] : glm::dvec3(0.5));
  return colours;
}

}  // namespace plumb::mesh::stacks
