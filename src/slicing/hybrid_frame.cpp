#include "slicing/hybrid_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "raster/rasteriser.h"
#include "slicing/slice_raster.h"

namespace plumb::slicing {
namespace {

using terrain::Heightfield;

class MeshOfNodes {
 public:
  explicit MeshOfNodes(const SlicingTree& tree)
      : tree_(tree), vertex_(tree.field().columns(), tree.field().rows(), kNoPrimitive) {
    result_.mesh.origin_m = tree.field().world_origin_m();
  }

  void add(std::uint32_t index) {
    const SlicingNode& node = tree_.node(index);
    for (int j = node.j0; j < node.j1; ++j) {
      for (int i = node.i0; i < node.i1; ++i) add_cell(index, i, j);
    }
  }

  NodeMesh take() { return std::move(result_); }

 private:
  struct Sample {
    int i, j;
  };

  void add_cell(std::uint32_t index, int i, int j) {
    const Sample sw{i, j}, se{i + 1, j}, nw{i, j + 1}, ne{i + 1, j + 1};
    if (rises_north_east(tree_.diagonal(), i, j)) {
      add_triangle(index, {sw, se, ne});
      add_triangle(index, {sw, ne, nw});
    } else {
      add_triangle(index, {sw, se, nw});
      add_triangle(index, {se, ne, nw});
    }
  }

  void add_triangle(std::uint32_t index, const std::array<Sample, 3>& corners) {
    const Heightfield& field = tree_.field();
    for (const Sample s : corners) {
      if (field.is_void(s.i, s.j)) return;
    }
    result_.mesh.triangles.push_back(
        {vertex_of(corners[0]), vertex_of(corners[1]), vertex_of(corners[2])});
    result_.node_of.push_back(index);
  }

  std::uint32_t vertex_of(Sample s) {
    const Heightfield& field = tree_.field();
    std::uint32_t& vertex = vertex_(s.i, s.j);
    if (vertex == kNoPrimitive) {
      vertex = static_cast<std::uint32_t>(result_.mesh.vertices_m.size());
      result_.mesh.vertices_m.emplace_back(s.i * field.dx_m, s.j * field.dy_m,
                                           field.heights_m(s.i, s.j));
    }
    return vertex;
  }

  const SlicingTree& tree_;
  Grid<std::uint32_t> vertex_;  // of a sample; kNoPrimitive where no triangle has used it
  NodeMesh result_;
};

}  // namespace

NodeMesh mesh_of_nodes(const SlicingTree& tree, const std::vector<std::uint32_t>& nodes) {
  MeshOfNodes mesh(tree);
  for (const std::uint32_t index : nodes) mesh.add(index);
  return mesh.take();
}

HybridFrame draw_frame(const SlicingTree& tree, const SlicingCut& cut, const NodeMesh& polygons,
                       const Camera& camera, const HeightLookup& heights, SliceRenderer renderer) {
  raster::RasterResult raster = raster::rasterise(polygons.mesh, camera);
  const Camera local = relative_to(camera, tree.field().world_origin_m());
  const SlicedImage slices = renderer == SliceRenderer::Quads
                                 ? rasterise_slices(cut, local, heights)
                                 : slice_rays(cut, local, heights);
  HybridFrame frame;
  frame.slice_fragments = slices.fragments;
  frame.polygon_fragments = raster.fragments;
  frame.triangles = static_cast<std::int64_t>(polygons.mesh.triangles.size());
  frame.vertices = static_cast<std::int64_t>(polygons.mesh.vertices_m.size());
  frame.image = std::move(raster.image);
  HitImage& image = frame.image;
  parallel_for(static_cast<std::int64_t>(image.size()), 4096, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    image.overdraw[pixel] = static_cast<std::uint16_t>(
        std::min(65535, image.overdraw[pixel] + slices.image.overdraw[pixel]));
    if (slices.image.depth_m[pixel] < image.depth_m[pixel]) {
      image.depth_m[pixel] = slices.image.depth_m[pixel];
      image.from_eye_m[pixel] = slices.image.from_eye_m[pixel];
      image.primitive[pixel] = cut.bundles[slices.image.primitive[pixel]].node;
    } else if (image.hit(pixel)) {
      image.primitive[pixel] = polygons.node_of[image.primitive[pixel]];
    }
  });
  return frame;
}

}  // namespace plumb::slicing
