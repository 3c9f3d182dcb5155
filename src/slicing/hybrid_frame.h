// Polygons near, slices far, in one depth buffer.
#pragma once

#include <cstdint>
#include <vector>

#include "core/camera.h"
#include "core/hit_image.h"
#include "core/triangle_mesh.h"
#include "slicing/ray_slicer.h"
#include "slicing/slicing_cut.h"

namespace plumb::slicing {

/// The full-detail triangles of some nodes, relative to the terrain's origin, with the node of
/// each.
struct NodeMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> node_of;  // a triangle each
};

/// Triangles whose three samples exist, node by node in the order given; nodes share vertices along
/// their sides.
NodeMesh mesh_of_nodes(const SlicingTree& tree, const std::vector<std::uint32_t>& nodes);

/// What is seen of both. `primitive` is the node of the tree.
struct HybridFrame {
  HitImage image;  // `overdraw`: fragments of slices tested and of polygons
  std::int64_t slice_fragments = 0, polygon_fragments = 0;
  std::int64_t triangles = 0, vertices = 0;
};

/// Who draws slices: the ray-slicer, or the rasteriser as a graphics card would.
enum class SliceRenderer { Rays, Quads };

/// Slices and, by the rasteriser, polygons: the nearer one of each pixel; of equal depths the
/// polygon.
///
/// polygons  mesh_of_nodes(tree, cut.polygons)
/// camera    in world coordinates
HybridFrame draw_frame(const SlicingTree& tree, const SlicingCut& cut, const NodeMesh& polygons,
                       const Camera& camera, const HeightLookup& heights,
                       SliceRenderer renderer = SliceRenderer::Rays);

}  // namespace plumb::slicing
