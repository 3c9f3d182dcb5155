// The rasteriser with a fragment stage of the caller's.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "core/camera.h"
#include "core/hit_image.h"
#include "core/mesh_runs.h"
#include "core/parallel.h"
#include "core/triangle_mesh.h"
#include "raster/binning.h"
#include "raster/tile_kernel.h"

namespace plumb::raster {

struct RasterOptions {
  Facing facing = Facing::Both;
  int tile_px = 64;         // side of a tile, 1..4096; no pixel depends on it
  int chunk_triangles = 0;  // sorted into tiles at a time, >= 0; 0 chooses; no pixel depends on it
  /// Of the mesh: runs that are out of view are then left out; no pixel depends on it. Null: all
  /// triangles are looked at.
  const MeshRuns* runs = nullptr;
};

struct RasterResult {
  HitImage image;
  std::int64_t fragments = 0;  // that passed near, far and the fragment stage
};

/// Checks the arguments, transforms the vertices that may be needed.
Geometry make_geometry(const TriangleMesh& mesh, const Camera& camera,
                       const RasterOptions& options);
std::uint32_t chunk_size(const Tiling& tiling, const RasterOptions& options);

/// `rasterise` (see rasteriser.h) where a fragment exists only if `keep(fragment)` says so.
///
/// keep  bool(Fragment&), called once for every covered pixel of every triangle, in no particular
///       order and from several threads at once: it has no memory. It may write the depth and the
///       point of what it keeps
template <class Keep>
RasterResult rasterise(const TriangleMesh& mesh, const Camera& camera, const RasterOptions& options,
                       const Keep& keep) {
  const Geometry geometry = make_geometry(mesh, camera, options);
  const Tiling tiling = make_tiling(camera.width_px, camera.height_px, options.tile_px);
  RasterResult result;
  result.image = HitImage(camera.width_px, camera.height_px);
  result.image.overdraw.assign(result.image.size(), 0);
  const TileKernel<Keep> kernel(geometry, keep, result.image);
  constexpr bool kKeepsAll = std::is_same_v<Keep, KeepAll>;
  Binner binner(geometry, tiling, options.facing, kKeepsAll);
  std::vector<std::int64_t> fragments(tiling.count(), 0);  // by tile

  const auto total = static_cast<std::uint32_t>(mesh.triangles.size());
  const std::uint32_t chunk = chunk_size(tiling, options);
  for (std::uint32_t first = 0; first < total; first += std::min(chunk, total - first)) {
    const Bins& bins = binner.bin(first, std::min(chunk, total - first));
    parallel_for(static_cast<std::int64_t>(tiling.count()), 1, [&](std::int64_t t) {
      const auto tile = static_cast<std::size_t>(t);
      const PixelBox box =
          tiling.box(static_cast<int>(t % tiling.columns), static_cast<int>(t / tiling.columns));
      fragments[tile] += kernel.draw(bins, bins.of_tile(tile), box);
    });
  }
  if (kKeepsAll) fill_points(geometry, result.image);
  for (const std::int64_t of_tile : fragments) result.fragments += of_tile;
  return result;
}

extern template RasterResult rasterise<KeepAll>(const TriangleMesh&, const Camera&,
                                                const RasterOptions&, const KeepAll&);

}  // namespace plumb::raster
