#include "mesh/dual_contouring/attributes.h"
#include "mesh/dual_contouring/classification.h"
#include "mesh/dual_contouring/density.h"
#include "mesh/dual_contouring/quadrangulate.h"
#include "mesh/dual_contouring/smoothing.h"
#include "scene.h"
#include "stage.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::determinism {
namespace {

using namespace mesh::dual_contouring;

constexpr terrain::Material kRock = 1, kSand = 2;

// Rock with a sandy top, caves here and there, slabs that float, holes, all thicknesses.
const terrain::StackField& stacks() {
  static const terrain::StackField kField = [] {
    terrain::StackField field;
    field.columns = 71;
    field.rows = 23;
    field.voxel_m = 1.7;
    field.low_m = -3.1F;
    field.voxels = 19;
    field.materials = {{"air"}, {"rock"}, {"sand"}};
    terrain::StackWriter writer(field);
    Sequence random(17);
    for (std::size_t k = 0; k < field.size(); ++k) {
      const auto height = [&](double low, double high) {
        return static_cast<float>(random.between(low, high));
      };
      const float floor_m = height(-2.0, 9.0), roof_m = height(9.0, 14.0),
                  top_m = height(14.0, 19.0);
      const float rock_m = height(19.0, 20.0), sand_m = height(20.0, 22.0);
      if (random.next() % 20 == 0)
        writer.add_hole();
      else if (random.next() % 2 == 0)
        writer.add(std::vector<terrain::Layer>{{-3.1F, top_m, kRock}, {top_m, sand_m, kSand}});
      else
        writer.add(std::vector<terrain::Layer>{
            {-3.1F, floor_m, kRock}, {roof_m, rock_m, kRock}, {rock_m, sand_m, kSand}});
    }
    return field;
  }();
  return kField;
}

constexpr LatticeBox kBox{{-3, -2, -3}, {77, 27, 25}};

const Lattice<float>& smooth_density() {
  static const Lattice<float> kDensity = smoothed(density_of(stacks(), kBox), {Kernel::Gauss, 1});
  return kDensity;
}

template <class T>
std::uint64_t bits_of(const std::vector<T>& values) {
  return Checksum().add(std::span<const T>(values)).value();
}

std::uint64_t bits_of(const std::vector<glm::dvec3>& values) {
  Checksum sum;
  for (const glm::dvec3& v : values) add(sum, v);
  return sum.value();
}

std::uint64_t density() {
  return Checksum()
      .add(bits_of(density_of(stacks(), kBox).values()))
      .add(bits_of(material_density_of(stacks(), kSand, kBox).values()))
      .value();
}

std::uint64_t smoothing() {
  const Lattice<float> rough = density_of(stacks(), kBox);
  Checksum sum;
  for (const Kernel kernel : {Kernel::Box, Kernel::Gauss}) {
    for (const int radius : {1, 2, 4}) sum.add(bits_of(smoothed(rough, {kernel, radius}).values()));
  }
  return sum.value();
}

std::uint64_t masks() { return bits_of(cell_masks(smooth_density()).values()); }

std::uint64_t allocation() {
  Checksum sum;
  for (const Variant variant : {Variant::Published, Variant::Conservative}) {
    const ActiveCells active = allocate(smooth_density(), variant);
    sum.add(bits_of(active.first_cell)).add(bits_of(active.first_quad)).add(active.vertices);
    for (const ActiveCell& cell : active.cells)
      sum.add(cell.x).add(cell.first_vertex).add(cell.mask).add(cell.vertices).add(cell.split);
  }
  return sum.value();
}

std::uint64_t attributes() {
  const ActiveCells active = allocate(smooth_density(), Variant::Conservative);
  const std::vector<Quad> quads = quads_of(active);
  const std::vector<Lattice<float>> materials{material_density_of(stacks(), kRock, kBox),
                                              material_density_of(stacks(), kSand, kBox)};
  Checksum sum;
  for (const Placement placement : {Placement::Mean, Placement::Qef, Placement::Particle}) {
    const auto positions = vertex_positions(smooth_density(), active, placement);
    sum.add(bits_of(positions))
        .add(bits_of(vertex_normals(smooth_density(), active, positions, quads)))
        .add(bits_of(vertex_materials(materials, active, positions)));
  }
  return sum.value();
}

std::uint64_t faces() {
  Checksum sum;
  for (const Variant variant : {Variant::Published, Variant::Conservative}) {
    const QuadMesh mesh = quadrangulate(smooth_density(), {variant, Placement::Qef});
    sum.add(bits_of(mesh.position));
    for (const Quad& quad : mesh.quads) sum.add(std::span<const std::uint32_t>(quad));
  }
  return sum.value();
}

}  // namespace

std::vector<Stage> contouring_stages() {
  return {{"contouring.density", density},       {"contouring.smoothing", smoothing},
          {"contouring.masks", masks},           {"contouring.allocation", allocation},
          {"contouring.attributes", attributes}, {"contouring.faces", faces}};
}

}  // namespace plumb::determinism
