#include "mesh/full/full_detail.h"
#include "mesh/restricted_quadtree/restricted_quadtree.h"
#include "scene.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

std::uint64_t full() {
  Checksum sum;
  add(sum, mesh::full::prepare(hills()).surface);
  return sum.value();
}

std::uint64_t restricted_quadtree(const Tolerance& tolerance) {
  namespace method = mesh::restricted_quadtree;
  const terrain::Heightfield field = hills();
  method::Parameters parameters;
  parameters.patch_cells = 16;
  const method::Prepared prepared = method::prepare(field, parameters);
  Checksum sum;
  for (const char* preset : {"oblique", "grazing"})
    add(sum, method::draw(prepared, camera_for(field, preset), tolerance));
  return sum.value();
}

}  // namespace

std::vector<Stage> mesh_stages() {
  return {{"mesh.full", full},
          {"mesh.restricted_quadtree_px",
           [] {
             return restricted_quadtree({1.0, Unit::Pixel});
           }},
          {"mesh.restricted_quadtree_m", [] {
             return restricted_quadtree({20.0, Unit::Metre});
           }}};
}

}  // namespace plumb::determinism
