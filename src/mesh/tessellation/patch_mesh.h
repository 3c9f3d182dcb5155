// The triangles of one patch, block by block.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "mesh/tessellation/block_levels.h"

namespace plumb::mesh::tessellation {

/// A sample of a patch, from its south-west corner.
struct PatchPoint {
  std::uint16_t i = 0, j = 0;
};

/// Triangles by the points that they use, each place once, in the order of their first use.
/// Triangles with a void corner are left out, as are those without area: beyond the terrain.
/// Blocks of the finest level that voids touch are drawn as the full-detail surface is.
struct PatchMesh {
  std::vector<PatchPoint> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> thinned;  // of each triangle: its block's inside, by 2^d
  std::array<std::vector<std::uint8_t>, 4> rims;

  /// By Side: 1 where a triangle's edge on the patch's rim begins, counted along it in samples.
  std::span<const std::uint8_t> rim(std::size_t side) const { return rims[side]; }
};

PatchMesh mesh_of_patch(const Prepared& prepared, const patch_quadtree::PatchPlace& patch,
                        const Grid<float>& heights_m, const PatchLevels& levels);

}  // namespace plumb::mesh::tessellation
