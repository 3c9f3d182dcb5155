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

/// Slices by rays and polygons by the rasteriser, the nearer one of each pixel; of equal depths the
/// polygon.
///
/// camera  in world coordinates
HybridFrame draw_frame(const SlicingTree& tree, const SlicingCut& cut, const Camera& camera,
                       const HeightLookup& heights);

}  // namespace plumb::slicing
