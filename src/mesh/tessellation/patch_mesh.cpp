#include "mesh/tessellation/patch_mesh.h"

#include <algorithm>
#include <cmath>

namespace plumb::mesh::tessellation {
namespace {

class Emitter {
 public:
  Emitter(const Prepared& prepared, const patch_quadtree::PatchPlace& patch,
          const Grid<float>& heights_m)
      : heights_m_(heights_m), side_(prepared.header().layout.patch_cells + 1) {
    for (int k = 0; k < side_; ++k) {
      columns_.push_back(prepared.header().layout.sample_column(patch, k));
      rows_.push_back(prepared.header().layout.sample_row(patch, k));
    }
    number_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), kNoPrimitive);
    for (auto& rim : mesh_.rims) rim.assign(static_cast<std::size_t>(side_), 0);
  }

  void add(const BlockTriangle& triangle, int first_i, int first_j, std::uint8_t thinned) {
    std::array<PatchPoint, 3> corner;
    std::array<std::int64_t, 3> x{}, y{};
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = {static_cast<std::uint16_t>(first_i + triangle[k].i),
                   static_cast<std::uint16_t>(first_j + triangle[k].j)};
      if (std::isnan(heights_m_(corner[k].i + 1, corner[k].j + 1))) return;
      x[k] = columns_[corner[k].i];
      y[k] = rows_[corner[k].j];
    }
    if ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]) <= 0) return;
    mesh_.triangles.push_back({number(corner[0]), number(corner[1]), number(corner[2])});
    mesh_.thinned.push_back(thinned);
    for (std::size_t k = 0; k < 3; ++k) mark_rims(corner[k], corner[(k + 1) % 3]);
  }

  PatchMesh take() { return std::move(mesh_); }

 private:
  void mark_rims(const PatchPoint& a, const PatchPoint& b) {
    const int n = side_ - 1;
    const auto mark = [&](std::size_t side, bool on, int from, int to) {
      if (on) mesh_.rims[side][static_cast<std::size_t>(std::min(from, to))] = 1;
    };
    mark(West, a.i == 0 && b.i == 0, a.j, b.j);
    mark(East, a.i == n && b.i == n, a.j, b.j);
    mark(South, a.j == 0 && b.j == 0, a.i, b.i);
    mark(North, a.j == n && b.j == n, a.i, b.i);
  }
  // The first of the samples that stand at one place: beyond the terrain they are its last.
  static int first_at(const std::vector<int>& places, int k) {
    while (k > 0 && places[static_cast<std::size_t>(k) - 1] == places[static_cast<std::size_t>(k)])
      --k;
    return k;
  }
  std::uint32_t number(PatchPoint point) {
    point.i = static_cast<std::uint16_t>(first_at(columns_, point.i));
    point.j = static_cast<std::uint16_t>(first_at(rows_, point.j));
    std::uint32_t& number =
        number_[static_cast<std::size_t>(point.j) * static_cast<std::size_t>(side_) + point.i];
    if (number == kNoPrimitive) {
      number = static_cast<std::uint32_t>(mesh_.points.size());
      mesh_.points.push_back(point);
    }
    return number;
  }

  const Grid<float>& heights_m_;
  int side_;
  std::vector<int> columns_, rows_;
  std::vector<std::uint32_t> number_;
  PatchMesh mesh_;
};

bool has_void(const Grid<float>& heights_m, int first_i, int first_j, int cells) {
  for (int j = first_j; j <= first_j + cells; ++j) {
    for (int i = first_i; i <= first_i + cells; ++i)
      if (std::isnan(heights_m(i + 1, j + 1))) return true;
  }
  return false;
}

// A block as the truth is, whatever its size.
void add_full_detail(const Prepared& prepared, int first_i, int first_j, Emitter& emitter) {
  const int cells = prepared.pieces->block_cells();
  for (int j = 0; j < cells; j += kTruthBlockCells) {
    for (int i = 0; i < cells; i += kTruthBlockCells) {
      prepared.truth_pieces->for_each_piece(BlockLevels{},
                                            [&](const std::vector<BlockTriangle>& triangles) {
                                              for (const BlockTriangle& triangle : triangles)
                                                emitter.add(triangle, first_i + i, first_j + j, 0);
                                            });
    }
  }
}

}  // namespace

PatchMesh mesh_of_patch(const Prepared& prepared, const patch_quadtree::PatchPlace& patch,
                        const Grid<float>& heights_m, const PatchLevels& levels) {
  Emitter emitter(prepared, patch, heights_m);
  const int cells = prepared.pieces->block_cells();
  for (int j = 0; j < levels.levels.rows(); ++j) {
    for (int i = 0; i < levels.levels.columns(); ++i) {
      const BlockLevels& block = levels.levels(i, j);
      const bool amid_voids = patch.level == 0 && cells > kTruthBlockCells &&
                              block == BlockLevels{} &&
                              has_void(heights_m, i * cells, j * cells, cells);
      if (amid_voids) {
        add_full_detail(prepared, i * cells, j * cells, emitter);
        continue;
      }
      prepared.pieces->for_each_piece(block, [&](const std::vector<BlockTriangle>& triangles) {
        for (const BlockTriangle& triangle : triangles)
          emitter.add(triangle, i * cells, j * cells, block.inside);
      });
    }
  }
  return emitter.take();
}

}  // namespace plumb::mesh::tessellation
