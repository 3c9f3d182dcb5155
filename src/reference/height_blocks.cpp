#include "reference/height_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/grid.h"
#include "core/parallel.h"

namespace plumb::reference {
namespace {

constexpr int kSamples = HeightBlocks::kSide + 1;
using RayPoints = std::array<std::array<RayPoint, kSamples>, kSamples>;

bool cell_has_triangle(const terrain::Heightfield& field, int i, int j) {
  return field.is_void(i, j) + field.is_void(i + 1, j) + field.is_void(i, j + 1) +
             field.is_void(i + 1, j + 1) <=
         1;
}

// Which sides of the ray a set of points lies on. Voids, which are NaN, lie on none.
struct Sides {
  bool left = false, right = false, below = false, above = false;
  void add(const RayPoint& p) {
    left |= p.u <= 0.0;
    right |= p.u >= 0.0;
    below |= p.v <= 0.0;
    above |= p.v >= 0.0;
  }
  bool around_ray() const { return left && right && below && above; }
};

}  // namespace

HeightBlocks::HeightBlocks(const terrain::Heightfield& field, terrain::Diagonal diagonal)
    : field_(field), diagonal_(diagonal) {
  across_ = (field.cell_columns() + kSide - 1) / kSide;
  const int up = (field.cell_rows() + kSide - 1) / kSide;
  Grid<std::uint8_t> filled(across_, up, 0);
  parallel_for(up, 16, [&](std::int64_t row) {
    const int block_j = static_cast<int>(row);
    for (int j = block_j * kSide; j < std::min((block_j + 1) * kSide, field.cell_rows()); ++j) {
      for (int i = 0; i < field.cell_columns(); ++i) {
        if (cell_has_triangle(field, i, j)) filled(i / kSide, block_j) = 1;
      }
    }
  });
  for (std::size_t k = 0; k < filled.size(); ++k) {
    if (filled.values()[k]) blocks_.push_back(static_cast<std::uint32_t>(k));
  }
}

HeightBlocks::Extent HeightBlocks::extent(std::uint32_t k) const {
  const int block = static_cast<int>(blocks_[k]);
  const int i0 = block % across_ * kSide, j0 = block / across_ * kSide;
  return {i0, j0, std::min(kSide, field_.cell_columns() - i0) + 1,
          std::min(kSide, field_.cell_rows() - j0) + 1};
}

Box HeightBlocks::box(std::uint32_t k) const {
  const Extent e = extent(k);
  Box box;
  for (int j = e.j0; j < e.j0 + e.rows; ++j) {
    for (int i = e.i0; i < e.i0 + e.columns; ++i) {
      if (!field_.is_void(i, j))
        box.add({i * field_.dx_m, j * field_.dy_m, field_.heights_m(i, j)});
    }
  }
  return box;
}

void HeightBlocks::meet(std::uint32_t k, const RayFrame& frame, double t_min, double t_max,
                        RayHit& best) const {
  const Extent e = extent(k);
  const glm::dvec3& eye = frame.origin_m();
  RayPoints p;
  Sides block_sides;
  for (int b = 0; b < e.rows; ++b) {
    const double y = (e.j0 + b) * field_.dy_m - eye.y;
    for (int a = 0; a < e.columns; ++a) {
      p[b][a] = frame.place({(e.i0 + a) * field_.dx_m - eye.x, y,
                             static_cast<double>(field_.heights_m(e.i0 + a, e.j0 + b)) - eye.z});
      block_sides.add(p[b][a]);
    }
  }
  if (!block_sides.around_ray()) return;

  for (int b = 0; b + 1 < e.rows; ++b) {
    for (int a = 0; a + 1 < e.columns; ++a) {
      const RayPoint &sw = p[b][a], &se = p[b][a + 1], &nw = p[b + 1][a], &ne = p[b + 1][a + 1];
      Sides sides;
      sides.add(sw);
      sides.add(se);
      sides.add(nw);
      sides.add(ne);
      if (!sides.around_ray()) continue;
      const int i = e.i0 + a, j = e.j0 + b;
      const bool rising = rises_north_east(diagonal_, i, j);
      const std::uint32_t first = terrain::triangle_index(field_.cell_columns(), i, j, 0);
      const double t0 = rising ? meet_triangle(sw, se, ne, t_min, t_max)
                               : meet_triangle(sw, se, nw, t_min, t_max);
      offer(best, t0, first);
      const double t1 = rising ? meet_triangle(sw, ne, nw, t_min, t_max)
                               : meet_triangle(se, ne, nw, t_min, t_max);
      offer(best, t1, first + 1);
    }
  }
}

}  // namespace plumb::reference
