#include "mesh/stacks/height_surface.h"

#include <algorithm>
#include <cmath>

#include "mesh/stacks/height_pieces.h"

namespace plumb::mesh::stacks {
namespace {

struct CornersOfHalf {
  std::array<int, 3> i, j;
};

// As terrain::triangle_index says.
CornersOfHalf corners_of(bool rises, int half) {
  if (rises) {
    return half == 0 ? CornersOfHalf{{0, 1, 1}, {0, 0, 1}} : CornersOfHalf{{0, 1, 0}, {0, 1, 1}};
  }
  return half == 0 ? CornersOfHalf{{0, 1, 0}, {0, 0, 1}} : CornersOfHalf{{1, 1, 0}, {0, 1, 1}};
}

}  // namespace

HeightSurface::HeightSurface(const terrain::Heightfield& field, terrain::Diagonal diagonal)
    : columns_(field.columns()),
      rows_(field.rows()),
      dx_m_(field.dx_m),
      dy_m_(field.dy_m),
      diagonal_(diagonal) {
  std::vector<float> buffer;
  heights_m_.reserve(field.heights_m.size());
  for (int j = 0; j < rows_; ++j) {
    const auto row = field.heights_m.row(j, buffer);
    heights_m_.insert(heights_m_.end(), row.begin(), row.end());
  }
  if (std::none_of(heights_m_.begin(), heights_m_.end(), [](float h) { return std::isnan(h); }))
    return;
  missing_.assign(heights_m_.size(), 0);
  const auto columns = static_cast<std::size_t>(columns_);
  for (int j = 0; j < cell_rows(); ++j) {
    std::uint32_t in_row = 0;
    for (int i = 0; i < cell_columns(); ++i) {
      in_row += (exists({i, j, 0}) ? 0U : 1U) + (exists({i, j, 1}) ? 0U : 1U);
      const std::size_t corner =
          static_cast<std::size_t>(j) * columns + static_cast<std::size_t>(i);
      missing_[corner + columns + 1] = missing_[corner + 1] + in_row;
    }
  }
}

bool HeightSurface::exists(const CellHalf& at) const {
  const CornersOfHalf corners = corners_of(rises(at.i, at.j), at.half);
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::isnan(this->at(at.i + corners.i[k], at.j + corners.j[k]))) return false;
  }
  return true;
}

double HeightSurface::height_m(const CellHalf& cell, double x_m, double y_m) const {
  const int i = cell.i, j = cell.j;
  const double u = x_m / dx_m_ - i, v = y_m / dy_m_ - j;
  const double east_south = at(i + 1, j), west_north = at(i, j + 1);
  if (rises(i, j)) {
    const double south_west = at(i, j), north_east = at(i + 1, j + 1);
    return cell.half == 0
               ? south_west + u * (east_south - south_west) + v * (north_east - east_south)
               : south_west + v * (west_north - south_west) + u * (north_east - west_north);
  }
  if (cell.half == 0) {
    const double south_west = at(i, j);
    return south_west + u * (east_south - south_west) + v * (west_north - south_west);
  }
  const double north_east = at(i + 1, j + 1);
  return north_east + (1.0 - u) * (west_north - north_east) + (1.0 - v) * (east_south - north_east);
}

bool HeightSurface::is_whole(const glm::dvec3& low, const glm::dvec3& high) const {
  if (cell_columns() < 1 || cell_rows() < 1) return false;
  if (missing_.empty()) return true;
  const auto cell = [](double at_m, double step_m, int cells) {
    return static_cast<std::size_t>(std::clamp(std::floor(at_m / step_m), 0.0, cells - 1.0));
  };
  const auto columns = static_cast<std::size_t>(columns_);
  const std::size_t i0 = cell(low.x, dx_m_, cell_columns()),
                    i1 = cell(high.x, dx_m_, cell_columns()) + 1,
                    j0 = cell(low.y, dy_m_, cell_rows()), j1 = cell(high.y, dy_m_, cell_rows()) + 1;
  return missing_[j1 * columns + i1] + missing_[j0 * columns + i0] ==
         missing_[j1 * columns + i0] + missing_[j0 * columns + i1];
}

double HeightSurface::off_m(const Corners& triangle) const {
  Piece whole;
  for (const glm::dvec3& corner : triangle) whole.add({corner});
  double off = -1.0;
  for_each_height_piece(
      *this, whole,
      [](const PieceCorner& a, double at_a, const PieceCorner& b, double at_b,
         const CutLine& line) { return PieceCorner{crossing_m(a, at_a, b, at_b, line)}; },
      [&](const CellHalf& half, const Piece& piece) {
        if (!exists(half)) return;
        for (const PieceCorner& corner : piece)
          off = std::max(off,
                         std::abs(corner.place.z - height_m(half, corner.place.x, corner.place.y)));
      });
  return off;
}

}  // namespace plumb::mesh::stacks
