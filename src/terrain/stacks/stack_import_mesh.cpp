#include "terrain/stacks/stack_import_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/check.h"
#include "core/memory.h"
#include "terrain/stacks/column_crossings.h"
#include "terrain/stacks/stack_import.h"

namespace plumb::terrain {
namespace {

constexpr double kMostRepaired = 0.01;  // of the stacks

struct Interval {
  float low_m, high_m;
};

bool is_least(double number) { return number >= 0.0 && std::isfinite(number); }

void require_options(const MeshStackOptions& options) {
  require(options.spacing_m > 0.0 && std::isfinite(options.spacing_m),
          "spacing_m must be above zero, got {}", options.spacing_m);
  require(is_least(options.voxel_m), "voxel_m must be >= 0, got {}", options.voxel_m);
  require(is_least(options.below_m) && is_least(options.above_m) && is_least(options.beside_m),
          "margins must be >= 0, got {} below, {} above, {} beside", options.below_m,
          options.above_m, options.beside_m);
  require(options.material != "air", "a mesh of air is nothing; subtract makes it a void");
}

Box require_closed(const TriangleMesh& mesh, const std::string& source, MeshStacks& result) {
  Box box;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      require(corner < mesh.vertices_m.size(), "vertex {} of a triangle is not one of {}", corner,
              mesh.vertices_m.size());
      const glm::dvec3& v = mesh.vertices_m[corner];
      require(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z),
              "vertex {} must be finite", corner);
      box.add(v);
    }
  }
  if (box.empty()) input_error("{}: expected triangles, there are none", source);
  const EdgeCounts edges = count_edges(mesh);
  if (edges.boundary > 0) {
    const glm::dvec3 at = mesh.origin_m + edges.first_boundary_m;
    input_error(
        "{}: expected a closed mesh, {} edges have one triangle only, the first at ({:.6g}, "
        "{:.6g}, {:.6g}) m",
        source, edges.boundary, at.x, at.y, at.z);
  }
  result.triangles = static_cast<std::int64_t>(mesh.triangles.size());
  result.non_manifold_edges = edges.non_manifold;
  result.unbalanced_edges = edges.unbalanced;
  return box;
}

// Multiples of the spacing from below `low` to `high` or above, so that the outermost stacks are
// outside the mesh: of a line on a side of it those of the west and the south are inside.
std::vector<double> axis(double low, double high, double spacing_m, const std::string& source) {
  const double first = std::ceil(low / spacing_m) - 1.0, last = std::ceil(high / spacing_m);
  if (!(last - first < 2147483646.0))
    input_error("{}: {} m between stacks are too few for {} m", source, spacing_m, high - low);
  require_memory(static_cast<std::int64_t>(last - first + 1.0) * 16, source + ": its stacks");
  std::vector<double> places;
  for (double k = first; k <= last; ++k) places.push_back(k * spacing_m);
  return places;
}

// Where the winding number is not zero; false if it does not come back to it.
bool inside(std::span<const Crossing> crossings, double origin_z_m,
            std::vector<Interval>& intervals) {
  intervals.clear();
  std::int64_t winding = 0;
  double low_m = 0.0;
  for (const Crossing& crossing : crossings) {
    const std::int64_t before = winding;
    winding -= crossing.sign;
    if (before == 0) low_m = crossing.z_m;
    if (before != 0 && winding == 0)
      intervals.push_back(
          {static_cast<float>(origin_z_m + low_m), static_cast<float>(origin_z_m + crossing.z_m)});
  }
  return winding == 0;
}

// The nearest sound stack in the row or the column, west, east, south and north in turn.
std::size_t sound_neighbour(const StackField& field, const std::vector<std::uint8_t>& sound, int i,
                            int j, const std::string& source) {
  for (int away = 1; away < std::max(field.columns, field.rows); ++away) {
    for (const auto& [a, b] : {std::pair{i - away, j}, {i + away, j}, {i, j - away}, {i, j + away}})
      if (a >= 0 && a < field.columns && b >= 0 && b < field.rows && sound[field.index(a, b)] != 0)
        return field.index(a, b);
  }
  input_error("{}: no stack beside ({}, {}) is sound to repair it from", source, i, j);
}

// Which stack's line each stack takes its layers from: its own, unless the mesh is open there.
std::vector<std::size_t> sources_of(const StackField& field, const Crossings& crossings,
                                    const std::string& source, MeshStacks& result) {
  const auto columns = static_cast<std::size_t>(field.columns);
  std::vector<std::uint8_t> sound(field.size());
  std::vector<std::size_t> sources(field.size());
  for (std::size_t line = 0; line < field.size(); ++line) {
    std::int64_t sum = 0;
    for (auto k = crossings.first[line]; k < crossings.first[line + 1]; ++k)
      sum += crossings.of[k].sign;
    sound[line] = sum == 0 ? 1 : 0;
    sources[line] = line;
    if (sum != 0 && result.repaired++ == 0) {
      result.first_repaired_column = static_cast<int>(line % columns);
      result.first_repaired_row = static_cast<int>(line / columns);
    }
  }
  if (static_cast<double>(result.repaired) > kMostRepaired * static_cast<double>(field.size()))
    input_error(
        "{}: on {} of {} stacks the mesh's inside has no end, the first is ({}, {}); its "
        "triangles do not agree which side is out at {} edges",
        source, result.repaired, field.size(), result.first_repaired_column,
        result.first_repaired_row, result.unbalanced_edges);
  for (int j = 0; j < field.rows && result.repaired > 0; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      if (sound[field.index(i, j)] == 0)
        sources[field.index(i, j)] = sound_neighbour(field, sound, i, j, source);
    }
  }
  return sources;
}

void fill(const Crossings& crossings, const std::vector<std::size_t>& sources, double origin_z_m,
          float top_m, bool subtract, StackField& field) {
  StackWriter writer(field);
  std::vector<Interval> intervals;
  std::vector<Layer> layers;
  for (const std::size_t line : sources) {
    const auto first = crossings.first[line];
    inside(std::span(crossings.of).subspan(first, crossings.first[line + 1] - first), origin_z_m,
           intervals);
    layers.clear();
    float reached_m = field.low_m;
    for (const Interval& interval : intervals) {
      subtract ? layers.push_back({reached_m, interval.low_m, 1})
               : layers.push_back({interval.low_m, interval.high_m, 1});
      reached_m = interval.high_m;
    }
    if (subtract) layers.push_back({reached_m, top_m, 1});
    writer.add(layers);
  }
}

void say(const std::string& source, const MeshStackOptions& options, MeshStacks& result) {
  Provenance& p = result.field.provenance;
  p.source = source;
  p.format = options.subtract ? "mesh subtracted from rock" : "mesh";
  p.assumptions.push_back(
      fmt::format("inside the mesh of {} triangles is where its winding number is not zero{}",
                  result.triangles, options.subtract ? "; there is air, and rock around it" : ""));
  if (result.non_manifold_edges > 0)
    p.assumptions.push_back(fmt::format("{} edges of the mesh have more than two triangles",
                                        result.non_manifold_edges));
  if (result.repaired > 0)
    p.assumptions.push_back(
        fmt::format("{} stacks, the first of them ({}, {}), have a neighbour's layers: the mesh's "
                    "triangles do not agree there which side is out",
                    result.repaired, result.first_repaired_column, result.first_repaired_row));
}

}  // namespace

MeshStacks stacks_of_mesh(const TriangleMesh& mesh, const std::string& source,
                          const MeshStackOptions& options) {
  require_options(options);
  MeshStacks result;
  const Box box = require_closed(mesh, source, result);
  const LineGrid lines{
      axis(box.low.x - options.beside_m, box.high.x + options.beside_m, options.spacing_m, source),
      axis(box.low.y - options.beside_m, box.high.y + options.beside_m, options.spacing_m, source)};
  constexpr std::int64_t kStackBytes = 32;  // its crossings, where it is repaired from, its layers
  require_memory(static_cast<std::int64_t>(lines.size()) * kStackBytes,
                 fmt::format("{}: {} x {} stacks", source, lines.x_m.size(), lines.y_m.size()));
  StackField& field = result.field;
  field.columns = static_cast<int>(lines.x_m.size());
  field.rows = static_cast<int>(lines.y_m.size());
  field.dx_m = field.dy_m = options.spacing_m;
  field.origin_m = {mesh.origin_m.x + lines.x_m.front(), mesh.origin_m.y + lines.y_m.front()};
  const double top_m = mesh.origin_m.z + box.high.z + options.above_m;
  reach(field, mesh.origin_m.z + box.low.z - options.below_m, top_m, options.voxel_m);
  add_material(field, options.material);
  const Crossings crossings = cross(mesh, lines);
  const std::vector<std::size_t> sources = sources_of(field, crossings, source, result);
  fill(crossings, sources, mesh.origin_m.z, static_cast<float>(top_m), options.subtract, field);
  say(source, options, result);
  return result;
}

double signed_volume_m3(const TriangleMesh& mesh) {
  const glm::dvec3 middle = mesh.vertices_m.empty() ? glm::dvec3(0.0) : mesh.vertices_m.front();
  double sum = 0.0;  // six times the volume of tetrahedra at one place of the mesh
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a = mesh.vertices_m[t[0]] - middle, b = mesh.vertices_m[t[1]] - middle,
                     c = mesh.vertices_m[t[2]] - middle;
    sum += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
           a.z * (b.x * c.y - b.y * c.x);
  }
  return sum / 6.0;
}

std::vector<double> volumes_m3(const StackField& field) {
  std::vector<double> volumes(field.materials.size(), 0.0);
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      const StackView stack = field.stack(i, j);
      for (std::size_t k = 0; k < stack.size(); ++k)
        volumes[stack.material[k]] += double{stack.end_m[k]} - double{stack.start_m(k)};
    }
  }
  for (double& volume : volumes) volume *= field.dx_m * field.dy_m;
  return volumes;
}

}  // namespace plumb::terrain
