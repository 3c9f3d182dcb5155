// What the nodes of an octree over caves cost on one core: alone, beside coarser ones, in a frame.
#include <algorithm>
#include <string>
#include <vector>

#include "bench_support.h"
#include "mesh/stacks/joined_surface.h"
#include "mesh/stacks/node_colours.h"
#include "mesh/stacks/stacks.h"
#include "terrain/stacks/stack_source.h"

namespace plumb::bench {
namespace {

using namespace mesh::stacks;
using mesh::dual_contouring::LatticeBox;

// The terrain that PLUMB_BENCH_STACKS names, or 1025 x 1025 stacks of 256 voxels.
const Prepared& caves() {
  static const Prepared prepared = [] {
    const char* named = std::getenv("PLUMB_BENCH_STACKS");
    return prepare(terrain::generate_stacks(named ? named : "generate:caves?size=1025&relief=256"));
  }();
  return prepared;
}

// The same without any node's mesh.
Prepared fresh() {
  Prepared prepared = caves();
  prepared.cache = std::make_shared<NodeCache>(
      prepared.densities,
      NodeMeshOptions{prepared.parameters.variant, prepared.parameters.placement,
                      glm::ivec2(prepared.densities->size())});
  return prepared;
}

mesh::dual_contouring::Lattice<float> densities(int level, const LatticeBox& box) {
  return (*caves().densities)(level, box);
}

constexpr Surroundings kAlike{};

Surroundings coarser_eastwards() {
  Surroundings around{};
  for (std::size_t k = 2; k < around.size(); k += 3) around[k] = Beside::Coarser;
  return around;
}

NodeMesh mesh_of(const Node& node, const Surroundings& around) {
  return node_mesh(node, around, densities,
                   {caves().parameters.variant, caves().parameters.placement,
                    glm::ivec2(caves().densities->size())});
}

// Every seventh of the first nodes of level 1 that have a surface, or have none.
std::vector<Node> some_nodes(bool with_surface) {
  Octree octree(caves().densities->size());
  octree.divide([](const Node& node) { return node.level > 1; });
  std::vector<Node> nodes;
  for (const Node& node : octree.drawn()) {
    if (mesh_of(node, kAlike).faces.empty() != with_surface) nodes.push_back(node);
  }
  std::vector<Node> some;
  for (std::size_t k = 0; k < nodes.size() && some.size() < 64; k += 7) some.push_back(nodes[k]);
  return some;
}

void set_nodes(benchmark::State& state, std::size_t count) {
  state.counters["s_a_node"] =
      benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

void nodes(benchmark::State& state, bool with_surface, const Surroundings& around) {
  const std::vector<Node> some = some_nodes(with_surface);
  std::size_t faces = 0;
  measure(state, [&] {
    faces = 0;
    for (const Node& node : some) faces += mesh_of(node, around).faces.size();
  });
  set_nodes(state, some.size());
  state.counters["faces"] = static_cast<double>(faces) / static_cast<double>(some.size());
}

void colours(benchmark::State& state) {
  std::vector<NodeMesh> meshes;
  for (const Node& node : some_nodes(true)) meshes.push_back(mesh_of(node, kAlike));
  measure(state, [&] {
    for (const NodeMesh& mesh : meshes)
      benchmark::DoNotOptimize(node_colours(mesh, *caves().densities));
  });
  set_nodes(state, meshes.size());
}

void only_densities(benchmark::State& state) {
  const std::vector<Node> some = some_nodes(true);
  measure(state, [&] {
    for (const Node& node : some) {
      const LatticeBox box{node.at * kNodeVoxels, glm::ivec3(kNodeVoxels)};
      benchmark::DoNotOptimize(densities(node.level, box.grown(2)));
    }
  });
  set_nodes(state, some.size());
}

Camera camera_of(const char* preset) {
  static const terrain::Heightfield top = terrain::top_surface(caves().densities->field());
  return make_camera(terrain::preset_camera(top, preset, 1920, 1080, 50.0));
}

// 160 px a node are the paper's 10 px a cell.
constexpr Tolerance kTolerance{160.0, Unit::Pixel};

void frame(benchmark::State& state, const char* preset) {
  const Camera camera = camera_of(preset);
  DrawnSurface surface;
  measure(state, [&] { surface = draw(fresh(), camera, kTolerance); });
  state.counters["nodes"] = static_cast<double>(surface.cost.nodes_visited);
  state.counters["triangles"] = static_cast<double>(surface.cost.triangles);
  state.counters["stacks_MB"] = 1e-6 * static_cast<double>(caves().densities->bytes());
}

// The same view again: every node is there.
void frame_again(benchmark::State& state, const char* preset) {
  const Camera camera = camera_of(preset);
  const Prepared prepared = fresh();
  DrawnSurface surface = draw(prepared, camera, kTolerance);
  measure(state, [&] { surface = draw(prepared, camera, kTolerance); });
  state.counters["nodes_MB"] = 1e-6 * static_cast<double>(prepared.cache->bytes());
}

void add_all() {
  add("node/surface", nodes, true, kAlike);
  add("node/surface/coarser", nodes, true, coarser_eastwards());
  add("node/empty", nodes, false, kAlike);
  add("node/empty/coarser", nodes, false, coarser_eastwards());
  add("node/densities", only_densities);
  add("node/colours", colours);
  for (const char* preset : kPresets) add(std::string("frame/") + preset, frame, preset);
  add("again/oblique", frame_again, "oblique");
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  plumb::bench::add_all();
  return plumb::bench::run(argc, argv);
}
