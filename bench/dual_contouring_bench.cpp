// Voxels a second of dual contouring on one core: a terrain with caves of 256^3 smooth densities.
#include <algorithm>
#include <cmath>

#include "bench_support.h"
#include "mesh/dual_contouring/attributes.h"
#include "mesh/dual_contouring/density.h"
#include "mesh/dual_contouring/quadrangulate.h"
#include "mesh/dual_contouring/smoothing.h"
#include "terrain/gradient_noise.h"
#ifdef PLUMB_WITH_OPENVDB
#include "openvdb_mesher.h"
#endif

namespace plumb::bench {
namespace {

using namespace mesh::dual_contouring;

constexpr int kSize = 256;

// Hills, and caves where two noises are near zero together; about 6.5 % of the cells are active.
const Lattice<float>& terrain_with_caves() {
  static const Lattice<float> kDensity = [] {
    const auto noise = [](double x, double y, std::uint64_t seed) {
      return terrain::gradient_noise(x, y, seed);
    };
    Lattice<float> solid({glm::ivec3(-2), glm::ivec3(kSize + 4)});
    parallel_for(kSize + 4, 1, [&](std::int64_t slice) {
      const int z = static_cast<int>(slice) - 2;
      for (int y = -2; y < kSize + 2; ++y) {
        const auto row = solid.row(y, z);
        for (int x = -2; x < kSize + 2; ++x) {
          const double hill =
              150 + 60 * noise(x / 90.0, y / 90.0, 1) + 10 * noise(x / 15.0, y / 15.0, 2);
          const double cave = noise((x + 0.31 * z) / 23.0, (y - 0.23 * z) / 23.0, 3) +
                              noise((z + 0.17 * y) / 20.0, (x - 0.11 * y) / 23.0, 4);
          const double ground = std::min(hill - z, 14.0 * (0.0 - cave));
          row[static_cast<std::size_t>(x + 2)] =
              static_cast<float>(std::clamp(0.5 + ground, 0.0, 1.0));
        }
      }
    });
    return smoothed(solid, {Kernel::Gauss, 2});
  }();
  return kDensity;
}

void set_voxels(benchmark::State& state) {
  set_rate(state, "Mvoxel/s", static_cast<double>(terrain_with_caves().values().size()));
}

void whole(benchmark::State& state, Options options) {
  const Lattice<float>& density = terrain_with_caves();
  QuadMesh mesh;
  measure(state, [&] { mesh = quadrangulate(density, options); });
  set_voxels(state);
  state.counters["active_%"] = 100.0 *
                               static_cast<double>(allocate(density, Variant::Published).vertices) /
                               static_cast<double>(density.values().size());
}

void stage_bits(benchmark::State& state) {
  measure(state, [&] { benchmark::DoNotOptimize(InsideBits(terrain_with_caves())); });
  set_voxels(state);
}

void stage_allocate(benchmark::State& state) {
  measure(state,
          [&] { benchmark::DoNotOptimize(allocate(terrain_with_caves(), Variant::Conservative)); });
  set_voxels(state);
}

void stage_positions(benchmark::State& state, Placement placement) {
  const ActiveCells active = allocate(terrain_with_caves(), Variant::Conservative);
  measure(state, [&] {
    benchmark::DoNotOptimize(vertex_positions(terrain_with_caves(), active, placement));
  });
  set_voxels(state);
}

void stage_quads(benchmark::State& state) {
  const ActiveCells active = allocate(terrain_with_caves(), Variant::Conservative);
  measure(state, [&] { benchmark::DoNotOptimize(quads_of(active)); });
  set_voxels(state);
}

void stage_normals(benchmark::State& state) {
  const Lattice<float>& density = terrain_with_caves();
  const ActiveCells active = allocate(density, Variant::Conservative);
  const auto positions = vertex_positions(density, active, Placement::Mean);
  const auto quads = quads_of(active);
  measure(state,
          [&] { benchmark::DoNotOptimize(vertex_normals(density, active, positions, quads)); });
  set_voxels(state);
}

// A terrain of the same size as stacks, one layer each.
void coverage(benchmark::State& state) {
  const terrain::StackField field = [] {
    terrain::StackField stacks;
    stacks.columns = stacks.rows = stacks.voxels = kSize;
    stacks.materials = {{"air"}, {"rock"}};
    terrain::StackWriter writer(stacks);
    for (int k = 0; k < kSize * kSize; ++k) {
      const double hill = terrain::gradient_noise(k % kSize / 90.0, k / kSize / 90.0, 1);
      writer.add(std::vector<terrain::Layer>{{0.0F, static_cast<float>(150 + 60 * hill), 1}});
    }
    return stacks;
  }();
  measure(state, [&] { benchmark::DoNotOptimize(density_of(field, {{}, glm::ivec3(kSize)})); });
  set_voxels(state);
}

void filter(benchmark::State& state, Filter filter) {
  measure(state, [&] { benchmark::DoNotOptimize(smoothed(terrain_with_caves(), filter)); });
  set_voxels(state);
}

// With air on the outermost samples, so that both meshes end nowhere.
const Lattice<float>& capped() {
  static const Lattice<float> kDensity = [] {
    Lattice<float> density = terrain_with_caves();
    const LatticeBox inner = density.box().grown(-1);
    for (std::size_t k = 0; k < density.values().size(); ++k) {
      if (!inner.contains(density.box().at(k))) density.values()[k] = 0.0F;
    }
    return density;
  }();
  return kDensity;
}

void set_size(benchmark::State& state, std::size_t vertices, std::size_t quads) {
  set_voxels(state);
  state.counters["vertices"] = static_cast<double>(vertices);
  state.counters["quads"] = static_cast<double>(quads);
}

void peer_ours(benchmark::State& state, Options options) {
  const Lattice<float>& density = capped();
  QuadMesh mesh;
  measure(state, [&] { mesh = quadrangulate(density, options); });
  set_size(state, mesh.position.size(), mesh.quads.size());
}

#ifdef PLUMB_WITH_OPENVDB
void peer_openvdb(benchmark::State& state) {
  const OpenVdbMesher mesher(capped());
  OpenVdbMesher::Size size;
  measure(state, [&] { size = mesher.mesh(); });
  set_size(state, size.vertices, size.quads);
}

void peer_openvdb_copy(benchmark::State& state) {
  const Lattice<float>& density = capped();
  measure(state, [&] { const OpenVdbMesher mesher(density); });
  set_voxels(state);
}
#endif

void add_peers() {
  add("peer/published/mean", peer_ours, Options{Variant::Published, Placement::Mean});
  for (const Placement placement : {Placement::Mean, Placement::Qef})
    add(std::string("peer/conservative/") + name_of(placement), peer_ours,
        Options{Variant::Conservative, placement});
#ifdef PLUMB_WITH_OPENVDB
  add("peer/openvdb", peer_openvdb);
  add("peer/openvdb/copy", peer_openvdb_copy);
#endif
}

void add_all() {
  add_peers();
  for (const Placement placement : {Placement::Mean, Placement::Qef, Placement::Particle}) {
    const std::string name = name_of(placement);
    add("conservative/" + name, whole, Options{Variant::Conservative, placement});
    add("positions/" + name, stage_positions, placement);
  }
  add("published/mean", whole, Options{Variant::Published, Placement::Mean});
  add("bits", stage_bits);
  add("allocation", stage_allocate);
  add("quads", stage_quads);
  add("normals", stage_normals);
  add("density", coverage);
  add("smoothing/gauss1", filter, Filter{Kernel::Gauss, 1});
  add("smoothing/gauss2", filter, Filter{Kernel::Gauss, 2});
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  plumb::bench::add_all();
  return plumb::bench::run(argc, argv);
}
