#include "mesh/restricted_quadtree/restricted_quadtree.h"

#include "mesh/full/full_detail.h"
#include "scene.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

std::uint64_t full() {
  Checksum sum;
  add(sum, *mesh::full::prepare(mountains()).surface.mesh);
  return sum.value();
}

std::uint64_t restricted_quadtree() {
  const terrain::Heightfield field = mountains();
  const auto prepared = mesh::restricted_quadtree::prepare(field);
  Checksum sum;
  for (const Tolerance& tolerance : {Tolerance{5.0, Unit::Metre}, Tolerance{1.0, Unit::Pixel}}) {
    const DrawnSurface surface =
        mesh::restricted_quadtree::draw(prepared, view_of(field, "oblique"), tolerance);
    add(sum, *surface.mesh);
    for (const Claim& claim : surface.claims) sum.add(claim.bound);
  }
  return sum.value();
}

}  // namespace

std::vector<Stage> mesh_stages() {
  return {{"mesh.full", full}, {"mesh.restricted_quadtree", restricted_quadtree}};
}

}  // namespace plumb::determinism
