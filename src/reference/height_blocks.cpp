#include "reference/height_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/grid.h"
#include "core/parallel.h"

namespace plumb::reference {
namespace {

static_assert(BlockSamples::kRow == HeightBlocks::kSide + 1);
constexpr int kRow = BlockSamples::kRow;

// Far more than the roundings by which a place on a ray is known, as a share of its distance.
constexpr double kOutside = 1e-9;

// Cells of a block, each as the bit of its south-west sample.
constexpr std::uint32_t kCells = [] {
  std::uint32_t cells = 0;
  for (int b = 0; b < HeightBlocks::kSide; ++b) {
    for (int a = 0; a < HeightBlocks::kSide; ++a) cells |= 1u << (b * kRow + a);
  }
  return cells;
}();

// Cells of which some corner is in the set.
std::uint32_t with_corner_in(std::uint32_t samples) {
  return samples | samples >> 1 | samples >> kRow | samples >> (kRow + 1);
}

bool cell_has_triangle(const terrain::Heightfield& field, int i, int j) {
  return field.is_void(i, j) + field.is_void(i + 1, j) + field.is_void(i, j + 1) +
             field.is_void(i + 1, j + 1) <=
         1;
}

}  // namespace

HeightBlocks::HeightBlocks(const terrain::Heightfield& field, terrain::Diagonal diagonal)
    : field_(field), diagonal_(diagonal), find_sides_(block_sides(instruction_set())) {
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

// A corner of a block less a point, moved by `share` of itself and of the spacing.
glm::dvec2 HeightBlocks::corner(const Extent& e, int a, int b, const glm::dvec3& from_m,
                                double share) const {
  const double x = (e.i0 + a) * field_.dx_m - from_m.x, y = (e.j0 + b) * field_.dy_m - from_m.y;
  return {x + share * (std::abs(x) + field_.dx_m), y + share * (std::abs(y) + field_.dy_m)};
}

void HeightBlocks::gather(std::uint32_t k, const glm::dvec3& from_m, Scratch& samples) const {
  if (samples.block == k && samples.from_m == from_m) return;
  samples.block = k;
  samples.from_m = from_m;
  const Extent e = extent(k);
  std::fill_n(&samples.at.axis[0][0], 3 * BlockSamples::kPadded,
              std::numeric_limits<double>::quiet_NaN());
  for (int b = 0; b < e.rows; ++b) {
    const double y = (e.j0 + b) * field_.dy_m - from_m.y;
    for (int a = 0; a < e.columns; ++a) {
      const int at = b * kRow + a;
      samples.at.axis[0][at] = (e.i0 + a) * field_.dx_m - from_m.x;
      samples.at.axis[1][at] = y;
      samples.at.axis[2][at] = static_cast<double>(field_.heights_m(e.i0 + a, e.j0 + b)) - from_m.z;
    }
  }
}

void HeightBlocks::meet(std::uint32_t k, const RayFrame& frame, double t_min, double t_max,
                        RayHit& best, Scratch& samples) const {
  const Extent e = extent(k);
  if (!frame.passes_over(corner(e, 0, 0, frame.origin_m(), -kOutside),
                         corner(e, e.columns - 1, e.rows - 1, frame.origin_m(), kOutside)))
    return;
  gather(k, frame.origin_m(), samples);
  const double* along = samples.at.axis[frame.along()];
  BlockSides sides;
  find_sides_({along, samples.at.axis[frame.across()], samples.at.axis[frame.up()], frame.shear_u(),
               frame.shear_v()},
              sides);
  // A void's coordinates are NaN, one of them or all: no triangle that has it is met.
  std::uint32_t cells = kCells & with_corner_in(sides.left) & with_corner_in(sides.right) &
                        with_corner_in(sides.below) & with_corner_in(sides.above);
  if (cells == 0) return;
  const auto point = [&](int at) {
    return RayPoint{sides.u[at], sides.v[at], frame.scale_t() * along[at]};
  };
  for (; cells; cells &= cells - 1) {
    const int at = __builtin_ctz(cells);
    const int i = e.i0 + at % kRow, j = e.j0 + at / kRow;
    const RayPoint sw = point(at), se = point(at + 1), nw = point(at + kRow),
                   ne = point(at + kRow + 1);
    const bool rising = rises_north_east(diagonal_, i, j);
    const std::uint32_t first = terrain::triangle_index(field_.cell_columns(), i, j, 0);
    const double t0 =
        rising ? meet_triangle(sw, se, ne, t_min, t_max) : meet_triangle(sw, se, nw, t_min, t_max);
    offer(best, t0, first);
    const double t1 =
        rising ? meet_triangle(sw, ne, nw, t_min, t_max) : meet_triangle(se, ne, nw, t_min, t_max);
    offer(best, t1, first + 1);
  }
}

}  // namespace plumb::reference
