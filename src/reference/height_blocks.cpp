#include "reference/height_blocks.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/grid.h"
#include "core/parallel.h"

namespace plumb::reference {
namespace {

static_assert(BlockSamples::kRow == HeightBlocks::kSide + 1);
constexpr int kRow = BlockSamples::kRow;

constexpr int kMostBlocks = 65536;  // a side

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

// False if the box lies wholly outside one of the five planes that bound a picture, which is taken
// a pixel larger on every side: far more than roundings.
bool may_show(const Camera& camera, const Box& box) {
  constexpr double kMargin_px = 1.0;
  const double left = camera.centre_px.x + kMargin_px;
  const double right = camera.width_px - camera.centre_px.x + kMargin_px;
  const double top = camera.centre_px.y + kMargin_px;
  const double bottom = camera.height_px - camera.centre_px.y + kMargin_px;
  bool seen[5] = {};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 point{corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                           corner & 4 ? box.high.z : box.low.z};
    const glm::dvec3 view = to_view(camera, point);
    const double across = camera.gamma_h * view.x, up = camera.gamma_v * view.y;
    seen[0] |= view.z > 0.0;
    seen[1] |= across + left * view.z >= 0.0;
    seen[2] |= right * view.z - across >= 0.0;
    seen[3] |= top * view.z - up >= 0.0;
    seen[4] |= up + bottom * view.z >= 0.0;
  }
  return seen[0] && seen[1] && seen[2] && seen[3] && seen[4];
}

}  // namespace

HeightBlocks::HeightBlocks(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                           const std::optional<Camera>& seen_by)
    : field_(field), diagonal_(diagonal), find_sides_(block_sides(instruction_set())) {
  const int across = (field.cell_columns() + kSide - 1) / kSide;
  const int up = (field.cell_rows() + kSide - 1) / kSide;
  require(across <= kMostBlocks && up <= kMostBlocks,
          "a terrain has at most {} cells a side for Embree's caster, got {} x {}",
          kMostBlocks * kSide, field.cell_columns(), field.cell_rows());
  Grid<std::uint8_t> filled(across, up, 0);
  parallel_for(up, 16, [&](std::int64_t row) {
    const int block_j = static_cast<int>(row);
    for (int j = block_j * kSide; j < std::min((block_j + 1) * kSide, field.cell_rows()); ++j) {
      for (int i = 0; i < field.cell_columns(); ++i) {
        if (cell_has_triangle(field, i, j)) filled(i / kSide, block_j) = 1;
      }
    }
  });
  if (seen_by) {
    const Camera camera = relative_to(*seen_by, field.world_origin_m());
    parallel_for(up, 16, [&](std::int64_t row) {
      for (int column = 0; column < across; ++column) {
        std::uint8_t& here = filled(column, static_cast<int>(row));
        here = here && may_show(camera, box_of(extent_at(column, static_cast<int>(row))));
      }
    });
  }
  for (int row = 0; row < up; ++row) {
    for (int column = 0; column < across; ++column) {
      if (filled(column, row))
        blocks_.push_back({static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(row)});
    }
  }
}

HeightBlocks::Extent HeightBlocks::extent_at(int column, int row) const {
  const int i0 = column * kSide, j0 = row * kSide;
  return {i0, j0, std::min(kSide, field_.cell_columns() - i0) + 1,
          std::min(kSide, field_.cell_rows() - j0) + 1};
}

HeightBlocks::Extent HeightBlocks::extent(std::uint32_t k) const {
  return extent_at(blocks_[k].column, blocks_[k].row);
}

Box HeightBlocks::box(std::uint32_t k) const { return box_of(extent(k)); }

Box HeightBlocks::box_of(const Extent& e) const {
  Box box;
  for (int j = e.j0; j < e.j0 + e.rows; ++j) {
    for (int i = e.i0; i < e.i0 + e.columns; ++i) {
      if (!field_.is_void(i, j))
        box.add({i * field_.dx_m, j * field_.dy_m, field_.heights_m(i, j)});
    }
  }
  return box;
}

void HeightBlocks::place(std::uint32_t k, const glm::dvec3& from_m, Scratch& block) const {
  if (block.block == k && block.from_m == from_m) return;
  block.block = k;
  block.from_m = from_m;
  block.sampled = false;
  const Extent e = extent(k);
  const glm::dvec2 spacing(field_.dx_m, field_.dy_m), from(from_m);
  const glm::dvec2 low = glm::dvec2(e.i0, e.j0) * spacing - from;
  const glm::dvec2 high = glm::dvec2(e.i0 + e.columns - 1, e.j0 + e.rows - 1) * spacing - from;
  block.low = low - kOutside * (glm::abs(low) + spacing);
  block.high = high + kOutside * (glm::abs(high) + spacing);
}

void HeightBlocks::sample(Scratch& block) const {
  if (block.sampled) return;
  block.sampled = true;
  const Extent e = extent(block.block);
  const glm::dvec3& from_m = block.from_m;
  std::fill_n(&block.at.axis[0][0], 3 * BlockSamples::kPadded,
              std::numeric_limits<double>::quiet_NaN());
  for (int b = 0; b < e.rows; ++b) {
    const double y = (e.j0 + b) * field_.dy_m - from_m.y;
    for (int a = 0; a < e.columns; ++a) {
      const int at = b * kRow + a;
      block.at.axis[0][at] = (e.i0 + a) * field_.dx_m - from_m.x;
      block.at.axis[1][at] = y;
      block.at.axis[2][at] = static_cast<double>(field_.heights_m(e.i0 + a, e.j0 + b)) - from_m.z;
    }
  }
}

void HeightBlocks::meet(std::uint32_t k, const RayFrame& frame, double t_min, double t_max,
                        RayHit& best, Scratch& block) const {
  place(k, frame.origin_m(), block);
  if (!frame.passes_over(block.low, block.high)) return;
  sample(block);
  const double* along = block.at.axis[frame.along()];
  BlockSides sides;
  find_sides_({along, block.at.axis[frame.across()], block.at.axis[frame.up()], frame.shear_u(),
               frame.shear_v()},
              sides);
  // A void's coordinates are NaN, one of them or all: no triangle that has it is met.
  std::uint32_t cells = kCells & with_corner_in(sides.left) & with_corner_in(sides.right) &
                        with_corner_in(sides.below) & with_corner_in(sides.above);
  if (cells == 0) return;
  const Extent e = extent(k);
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
