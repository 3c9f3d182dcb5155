#include "mesh/full/full_detail.h"
#include "mesh/restricted_quadtree/restricted_quadtree.h"
#include "mesh/tessellation/tessellator.h"
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

std::uint64_t tessellation() {
  using mesh::tessellation::Spacing;
  Sequence random(31);
  Checksum sum;
  for (int k = 0; k < 200; ++k) {
    mesh::tessellation::Factors factors{};
    for (float& factor : factors.outer) factor = static_cast<float>(random.between(0.5, 66.0));
    for (float& factor : factors.inner) factor = static_cast<float>(random.between(0.5, 66.0));
    for (const Spacing spacing :
         {Spacing::Integer, Spacing::PowerOfTwo, Spacing::FractionalOdd, Spacing::FractionalEven}) {
      const auto patch = mesh::tessellation::tessellate(spacing, factors);
      for (const auto& point : patch.points) sum.add(point.u).add(point.v);
      for (const auto& t : patch.triangles) sum.add(t[0]).add(t[1]).add(t[2]);
    }
  }
  return sum.value();
}

}  // namespace

std::vector<Stage> mesh_stages() {
  return {{"mesh.full", full},
          {"mesh.tessellation", tessellation},
          {"mesh.restricted_quadtree_px",
           [] {
             return restricted_quadtree({1.0, Unit::Pixel});
           }},
          {"mesh.restricted_quadtree_m", [] {
             return restricted_quadtree({20.0, Unit::Metre});
           }}};
}

}  // namespace plumb::determinism
