#include "mesh/stacks/joined_surface.h"
#include "mesh/stacks/node_cache.h"
#include "mesh/stacks/octree.h"
#include "mesh/stacks/stacks.h"
#include "scene.h"
#include "stage.h"
#include "terrain/stacks/stack_source.h"

namespace plumb::determinism {
namespace {

using namespace mesh::stacks;
using mesh::dual_contouring::Kernel;
using mesh::dual_contouring::Placement;

// Odd sizes, caves, holes and five materials.
terrain::StackField caves() {
  return terrain::generate_stacks(
      "generate:caves?size=61x83&spacing=3,2.5&relief=107&feature=130&caves=2&voids=0.04&utm=1"
      "&seed=5");
}

Parameters parameters_of(Variant variant, Placement placement) {
  return {variant, placement, {Kernel::Gauss, 2}};
}

// Nodes divided by chance: three levels beside one another.
Octree random_tree(const Prepared& prepared) {
  Octree octree(prepared.densities->size());
  Sequence random(23);
  octree.divide([&](const Node& node) {
    return node.level == octree.root_level() || random.next() % 3 == 0;
  });
  octree.balance();
  return octree;
}

template <class Mesh>
void add_surface(Checksum& sum, const Mesh& mesh) {
  for (const VertexName& name : mesh.names)
    sum.add(name.level).add(name.cell.x).add(name.cell.y).add(name.cell.z).add(name.loop);
  for (const glm::dvec3& place : mesh.position) add(sum, place);
  for (const glm::dvec3& normal : mesh.normal) add(sum, normal);
  for (const glm::vec3& colour : mesh.colour) add(sum, glm::dvec3(colour));
  for (const Face& face : mesh.faces) sum.add(std::span<const std::uint32_t>(face));
}

std::uint64_t tree() {
  Checksum sum;
  const Octree octree = random_tree(prepare(caves()));
  for (const Node& node : octree.drawn()) {
    sum.add(node.level).add(node.at.x).add(node.at.y).add(node.at.z);
    for (const Beside beside : octree.surroundings(node)) sum.add(static_cast<int>(beside));
  }
  return sum.value();
}

std::uint64_t nodes() {
  Checksum sum;
  for (const Variant variant : {Variant::Published, Variant::Conservative}) {
    for (const Placement placement : {Placement::Mean, Placement::Qef, Placement::Particle}) {
      const Prepared prepared = prepare(caves(), parameters_of(variant, placement));
      const Octree octree = random_tree(prepared);
      for (const auto& mesh : prepared.cache->meshes(octree, octree.drawn())) {
        add_surface(sum, *mesh);
        sum.add(mesh->faces_vanished);
      }
    }
  }
  return sum.value();
}

std::uint64_t joined_nodes() {
  const Prepared prepared = prepare(caves());
  const Octree octree = random_tree(prepared);
  const auto meshes = prepared.cache->meshes(octree, octree.drawn());
  std::vector<const NodeMesh*> pointers;
  for (const auto& mesh : meshes) pointers.push_back(mesh.get());
  const JoinedSurface surface = joined(pointers);
  Checksum sum;
  add_surface(sum, surface);
  return sum.add(std::span<const std::uint32_t>(surface.first_face)).value();
}

// What a camera is shown, from nodes that other views have made before and from new ones.
std::uint64_t drawn() {
  const Prepared prepared = prepare(caves());
  const terrain::Heightfield top = terrain::top_surface(caves());
  Checksum sum;
  for (const char* preset : {"oblique", "top", "valley"}) {
    const DrawnSurface surface = draw(prepared, camera_for(top, preset), {60.0, Unit::Pixel});
    add(sum, surface);
    for (const glm::vec3& colour : surface.vertex_colours) add(sum, glm::dvec3(colour));
  }
  return sum.value();
}

}  // namespace

std::vector<Stage> stack_stages() {
  return {{"stacks.tree", tree},
          {"stacks.nodes", nodes},
          {"stacks.joined", joined_nodes},
          {"stacks.drawn", drawn}};
}

}  // namespace plumb::determinism
