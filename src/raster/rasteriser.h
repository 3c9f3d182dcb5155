// Draws a triangle mesh as a GPU would, with exact coverage and the same bits on any number of
// threads.
#pragma once

#include <cstdint>

#include "core/camera.h"
#include "core/hit_image.h"
#include "core/triangle_mesh.h"
#include "raster/fragment_stage.h"

namespace plumb::raster {

/// The mesh seen by the camera, one sample at the centre of each pixel.
///
///   (1) Vertices are snapped to 1/256 pixel (`kSnap`) and edges decided in exact integers by the
///       fill rule `kFillRule`: where triangles share an edge each pixel is covered by one of them.
///   (2) A hit lies on its triangle: it is the convex combination of the triangle's own corners
///       that the pixel's perspective-correct barycentric coordinates give. Through the camera it
///       falls within 1/512 pixel, per axis, of the pixel's centre, which is the snapping and
///       nothing else.
///   (3) The nearest fragment wins, of equal depths the triangle with the lowest index.
///   (4) Parts nearer than near_m are cut off, fragments deeper than far_m dropped. Triangles of no
///       area once snapped are dropped.
///   (5) `overdraw` counts the fragments of a pixel, nearest or not (65535 at most), `fragments`
///       their sum without a limit.
///   (6) Same bits on any number of threads, for any tile size and any chunk size.
/// Throws std::invalid_argument if an index is out of range, a vertex is not finite, or the camera
/// or an option is out of range.
/// Source: derived in docs/algorithms/rasteriser.md; fill rule: Direct3D 11.3 functional
/// specification, section 3.4.2.
RasterResult rasterise(const TriangleMesh& mesh, const Camera& camera,
                       const RasterOptions& options = {});

}  // namespace plumb::raster
