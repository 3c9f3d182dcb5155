#include "audit/coarse_truth.h"

#include <algorithm>

#include "core/check.h"

namespace plumb::audit {
namespace {

constexpr int kMostCells = 1024;  // along a side

terrain::Heightfield decimated(const HeightfieldTruth& full, int stride) {
  require(stride >= 1, "a stride must be at least 1, got {}", stride);
  const terrain::Heightfield& field = full.field();
  const int columns = std::max(1, (field.cell_columns() + stride - 1) / stride),
            rows = std::max(1, (field.cell_rows() + stride - 1) / stride);
  const double width = field.cell_columns() * field.dx_m, depth = field.cell_rows() * field.dy_m;
  terrain::Heightfield coarse;
  coarse.heights_m = Grid<float>(columns + 1, rows + 1);
  coarse.origin_m = field.origin_m;
  coarse.dx_m = width / columns;
  coarse.dy_m = depth / rows;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      coarse.heights_m.floats()(i, j) = static_cast<float>(
          full.height_at(std::min(i * coarse.dx_m, width), std::min(j * coarse.dy_m, depth)));
    }
  }
  return coarse;
}

}  // namespace

CoarseTruth::CoarseTruth(const HeightfieldTruth& full, int stride)
    : field(decimated(full, stride)), truth(field, full.diagonal()) {}

std::vector<std::unique_ptr<CoarseTruth>> coarse_truths(const HeightfieldTruth& full) {
  std::vector<std::unique_ptr<CoarseTruth>> all;
  const int cells = std::max(full.field().cell_columns(), full.field().cell_rows());
  for (int stride = 2; stride <= kCoarsestStride && stride < cells; stride *= 2) {
    if (cells / stride <= kMostCells) all.push_back(std::make_unique<CoarseTruth>(full, stride));
  }
  return all;
}

}  // namespace plumb::audit
