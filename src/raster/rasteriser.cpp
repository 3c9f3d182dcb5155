#include "raster/rasteriser.h"

#include <algorithm>
#include <limits>

#include "core/check.h"

namespace plumb::raster {
namespace {

// Worst case of the bins: every triangle of a chunk in every tile, 16 bytes each, is 1 GiB.
constexpr std::size_t kMostEntries = std::size_t{1} << 26;
constexpr std::size_t kLeastChunk = 8192;
constexpr std::size_t kMostChunk = std::size_t{1} << 19;

}  // namespace

template RasterResult rasterise<KeepAll>(const TriangleMesh&, const Camera&, const RasterOptions&,
                                         const KeepAll&);

Geometry make_geometry(const TriangleMesh& mesh, const Camera& camera,
                       const RasterOptions& options) {
  require(options.tile_px >= 1 && options.tile_px <= 4096, "tile_px must lie in 1..4096, got {}",
          options.tile_px);
  require(options.chunk_triangles >= 0, "chunk_triangles must be >= 0, got {}",
          options.chunk_triangles);
  require(mesh.triangles.size() < std::numeric_limits<std::uint32_t>::max(),
          "a mesh may have at most 2^32 - 2 triangles, got {}", mesh.triangles.size());
  require(options.runs == nullptr || options.runs->mesh().get() == &mesh,
          "runs must be those of the mesh");
  Geometry geometry;
  geometry.mesh = &mesh;
  geometry.projection = make_projection(camera, mesh.origin_m);
  if (options.runs != nullptr) geometry.in_view = options.runs->in_view(camera);
  geometry.vertices =
      transform(geometry.projection, mesh.vertices_m, options.runs, geometry.in_view);
  return geometry;
}

std::uint32_t chunk_size(const Tiling& tiling, const RasterOptions& options) {
  if (options.chunk_triangles > 0) return static_cast<std::uint32_t>(options.chunk_triangles);
  return static_cast<std::uint32_t>(
      std::clamp(kMostEntries / tiling.count(), kLeastChunk, kMostChunk));
}

RasterResult rasterise(const TriangleMesh& mesh, const Camera& camera,
                       const RasterOptions& options) {
  return rasterise(mesh, camera, options, KeepAll{});
}

}  // namespace plumb::raster
