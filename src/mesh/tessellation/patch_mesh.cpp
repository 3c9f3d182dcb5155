#include "mesh/tessellation/patch_mesh.h"

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
  }

  PatchMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t number(PatchPoint point) {
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

}  // namespace

PatchMesh mesh_of_patch(const Prepared& prepared, const patch_quadtree::PatchPlace& patch,
                        const Grid<float>& heights_m, const PatchLevels& levels) {
  Emitter emitter(prepared, patch, heights_m);
  const int cells = prepared.pieces->block_cells();
  for (int j = 0; j < levels.levels.rows(); ++j) {
    for (int i = 0; i < levels.levels.columns(); ++i) {
      const BlockLevels& block = levels.levels(i, j);
      prepared.pieces->for_each_piece(block, [&](const std::vector<BlockTriangle>& triangles) {
        for (const BlockTriangle& triangle : triangles)
          emitter.add(triangle, i * cells, j * cells, block.inside);
      });
    }
  }
  return emitter.take();
}

}  // namespace plumb::mesh::tessellation
