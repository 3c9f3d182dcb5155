#include "mesh/full/full_detail.h"
#include "mesh/restricted_quadtree/restricted_quadtree.h"
#include "mesh/tessellation/block_levels.h"
#include "mesh/tessellation/build.h"
#include "mesh/tessellation/tessellation.h"
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

// The file, bounds and all, by either version of the codec.
std::uint64_t coded_file(mesh::patch_quadtree::CodecVersion version) {
  mesh::tessellation::BuildOptions options;
  options.heights.error_m = 0.5;
  options.heights.version = version;
  options.heights.patch_cells = 16;
  const auto bytes = mesh::tessellation::build(hills(), options);
  return Checksum().add_bytes(bytes.data(), bytes.size()).value();
}

// Surfaces, and the tessellation factors that they are made of.
std::uint64_t tessellated(mesh::tessellation::Variant variant) {
  namespace method = mesh::tessellation;
  const terrain::Heightfield field = hills();
  method::Parameters parameters;
  parameters.variant = variant;
  parameters.patch_cells = 16;
  const method::Prepared prepared = method::prepare(field, parameters);
  const Tolerance tolerance{1.0, Unit::Pixel};
  Checksum sum;
  for (const char* preset : {"oblique", "grazing"}) {
    const Camera camera = camera_for(field, preset);
    add(sum, method::draw(prepared, camera, tolerance));
    const method::ViewTest view{relative_to(camera, field.world_origin_m()), tolerance};
    const method::PatchSelection selection = method::select_patches(prepared, view);
    const auto levels =
        method::choose_levels(prepared, view, selection, method::decode_drawn(prepared, selection));
    for (const method::PatchLevels& patch : levels.patches) {
      for (const method::BlockLevels& block : patch.levels.values())
        sum.add(block.inside).add_bytes(block.side.data(), block.side.size());
    }
  }
  return sum.value();
}

std::uint64_t tessellator() {
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
          {"mesh.tessellator", tessellator},
          {"mesh.coded_file_1",
           [] { return coded_file(mesh::patch_quadtree::CodecVersion::Published); }},
          {"mesh.coded_file_2",
           [] { return coded_file(mesh::patch_quadtree::CodecVersion::Modelled); }},
          {"mesh.tessellation_conservative",
           [] { return tessellated(mesh::tessellation::Variant::Conservative); }},
          {"mesh.tessellation_published",
           [] { return tessellated(mesh::tessellation::Variant::Published); }},
          {"mesh.restricted_quadtree_px",
           [] {
             return restricted_quadtree({1.0, Unit::Pixel});
           }},
          {"mesh.restricted_quadtree_m", [] {
             return restricted_quadtree({20.0, Unit::Metre});
           }}};
}

}  // namespace plumb::determinism
