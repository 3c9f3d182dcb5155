// The same slices as a graphics card draws them: quads, and a look at the height for each fragment.
#pragma once

#include <cstdint>
#include <vector>

#include "slicing/ray_slicer.h"

namespace plumb::slicing {

/// A quad of a bundle: a slice, or one of those that close it.
struct SliceQuad {
  std::uint32_t bundle = 0;
  QuadKind kind = QuadKind::Slice;
  Axis axis = Axis::Z;
  double at_m = 0.0;
};

/// All quads of a cut, bundle by bundle, as two triangles each: triangles 2 k and 2 k + 1 are quad
/// k.
struct SliceMesh {
  TriangleMesh mesh;  // relative to the terrain's origin
  std::vector<SliceQuad> quads;
};

/// Throws InputError if they do not fit into memory.
SliceMesh mesh_of_slices(const SlicingCut& cut);

/// As slice_rays, by src/raster: coverage is the quads' own, snapped; a fragment's position is that
/// of the pixel's ray on the plane.
///
///   (1) The same hits as slice_rays, depth and point to the bit, in every pixel whose centre is
///   not within 1/128 pixel of a quad's edge. (2) `overdraw` and `fragments` count what is
///   tested, in front of what is seen or behind it.
SlicedImage rasterise_slices(const SlicingCut& cut, const Camera& camera,
                             const HeightLookup& heights);

}  // namespace plumb::slicing
