// Triangles sorted into bands of rows, so that each band is one task's own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace plumb::audit {

/// For each band of `band_m` metres from y = 0 northwards, the triangles that touch it, by index.
/// Triangles that reach beyond the first or last band are in those; their y is counted relative to
/// the terrain's origin.
class RowBins {
 public:
  /// shift_y_m is added to every vertex; slack_m widens each triangle both ways.
  RowBins(const TriangleMesh& mesh, double shift_y_m, double band_m, int bands, double slack_m);

  int bands() const { return static_cast<int>(start_.size()) - 1; }
  std::span<const std::uint32_t> triangles(int band) const {
    const auto b = static_cast<std::size_t>(band);
    return {triangles_.data() + start_[b], start_[b + 1] - start_[b]};
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace plumb::audit
