// Triangles sorted into bands of rows, so that each band is one task's own.
#pragma once

#include <cstdint>
#include <span>

#include "audit/band_lists.h"
#include "core/triangle_mesh.h"

namespace plumb::audit {

/// For each band of `band_m` metres from y = 0 northwards, the triangles that touch it, by index.
/// Triangles that reach beyond the first or last band are in those; their y is counted relative to
/// the terrain's origin.
class RowBins {
 public:
  /// shift_y_m is added to every vertex; slack_m widens each triangle both ways.
  RowBins(const TriangleMesh& mesh, double shift_y_m, double band_m, int bands, double slack_m);

  int bands() const { return static_cast<int>(lists_.bands()); }
  std::span<const std::uint32_t> triangles(int band) const {
    return lists_.of(static_cast<std::size_t>(band));
  }

 private:
  BandLists lists_;
};

}  // namespace plumb::audit
