#include "slicing/slice_raster.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/memory.h"
#include "raster/rasteriser.h"

namespace plumb::slicing {
namespace {

void add_quad(SliceMesh& slices, const Box& reach, const SliceQuad& quad) {
  const int n = index_of(quad.axis), a = (n + 1) % 3, b = (n + 2) % 3;
  const auto first = static_cast<std::uint32_t>(slices.mesh.vertices_m.size());
  for (int k = 0; k < 4; ++k) {
    glm::dvec3 corner;
    corner[n] = quad.at_m;
    corner[a] = k == 1 || k == 2 ? reach.high[a] : reach.low[a];
    corner[b] = k >= 2 ? reach.high[b] : reach.low[b];
    slices.mesh.vertices_m.push_back(corner);
  }
  slices.mesh.triangles.push_back({first, first + 1, first + 2});
  slices.mesh.triangles.push_back({first, first + 2, first + 3});
  slices.quads.push_back(quad);
}

}  // namespace

SliceMesh mesh_of_slices(const SlicingCut& cut) {
  require_memory(cut.slices * static_cast<std::int64_t>(4 * sizeof(glm::dvec3) +
                                                        2 * sizeof(Triangle) + sizeof(SliceQuad)),
                 "the quads of all slices");
  SliceMesh slices;
  for (std::uint32_t number = 0; number < cut.bundles.size(); ++number) {
    const SliceBundle& bundle = cut.bundles[number];
    const Box& reach = bundle.reach;
    for (int j = 0; j < bundle.count; ++j)
      add_quad(slices, reach, {number, QuadKind::Slice, bundle.axis, bundle.plane_m(j)});
    if (!bundle.closed) continue;
    for (const Axis axis : {Axis::X, Axis::Y}) {
      for (const double at : {reach.low[index_of(axis)], reach.high[index_of(axis)]})
        add_quad(slices, reach, {number, QuadKind::Closing, axis, at});
    }
    add_quad(slices, reach, {number, QuadKind::Closing, Axis::Z, reach.low.z});
  }
  return slices;
}

SlicedImage rasterise_slices(const SlicingCut& cut, const Camera& camera,
                             const HeightLookup& heights) {
  const SliceMesh slices = mesh_of_slices(cut);
  // A pixel's fragments are tested on one thread at a time: they are its tile's.
  std::vector<std::uint32_t> tested(
      static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px), 0);
  const auto keep = [&](raster::Fragment& fragment) {
    const SliceQuad& quad = slices.quads[fragment.primitive / 2];
    const SliceRay ray(camera, fragment.x, fragment.y);
    const PlanePoint met = meet_plane(ray, quad.axis, quad.at_m);
    if (!(met.t >= camera.near_m && met.t <= camera.far_m)) return false;
    ++tested[static_cast<std::size_t>(fragment.y) * static_cast<std::size_t>(camera.width_px) +
             static_cast<std::size_t>(fragment.x)];
    fragment.depth_m = met.t;
    fragment.from_eye_m = met.t * ray.direction;
    return passes(cut.bundles[quad.bundle], quad.kind, quad.axis, heights, ray, met);
  };
  raster::RasterResult raster = raster::rasterise(slices.mesh, camera, {}, keep);
  SlicedImage result;
  result.image = std::move(raster.image);
  result.image.overdraw.resize(tested.size());
  for (std::size_t pixel = 0; pixel < tested.size(); ++pixel) {
    result.fragments += tested[pixel];
    result.image.overdraw[pixel] =
        static_cast<std::uint16_t>(std::min<std::uint32_t>(tested[pixel], 65535));
  }
  for (std::uint32_t& primitive : result.image.primitive) {
    if (primitive != kNoPrimitive) primitive = slices.quads[primitive / 2].bundle;
  }
  return result;
}

}  // namespace plumb::slicing
