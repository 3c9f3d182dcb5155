// Parallel quads in a box, and when a fragment of one passes.
#pragma once

#include <cstdint>
#include <limits>

#include "core/box.h"

namespace plumb::slicing {

enum class Axis : std::uint8_t { X, Y, Z };

inline int index_of(Axis axis) { return static_cast<int>(axis); }

/// `count` quads across `axis` at first_m + j * spacing_m, j = 0 .. count - 1, each as large as the
/// box `reach`. A fragment at p passes if it is at or below the terrain: height(p.x, p.y) >= the
/// tested z, which is p.z - raise_m, kept within [least_z_m, greatest_z_m]. Metres relative to the
/// terrain's origin.
///
/// The quads of a closed bundle are joined by the four sides and the bottom of its reach, tested
/// with closing_raise_m. That, and what its reach stands out of the node's box, covers what a
/// rasteriser's snapping takes from polygons beside it.
/// Source: [Röttger & Ertl 2001], sections 4 and 5; closed bundles are ours.
struct SliceBundle {
  std::uint32_t node = 0;  // of the slicing tree
  Axis axis = Axis::Z;
  bool closed = false;
  int count = 1;
  double first_m = 0.0, spacing_m = 0.0;
  Box reach;  // the node's box, and the borders
  double raise_m = 0.0;
  double closing_raise_m = 0.0;
  double closing_rim_m = 0.0;  // by which closing quads are larger, lest a ray through the edge of
                               // two miss both by a rounding
  double least_z_m = 0.0, greatest_z_m = 0.0;
  double steepest = std::numeric_limits<double>::infinity();  // no slope within its reach is, m/m

  double plane_m(int j) const { return first_m + j * spacing_m; }
};

}  // namespace plumb::slicing
