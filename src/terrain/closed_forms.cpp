#include "terrain/closed_forms.h"

#include <algorithm>
#include <cmath>

#include "core/reproducible_math.h"

namespace plumb::terrain {
namespace {

/// Fills a row with height(i, j) in double, rounded once.
template <class Height>
RowFiller each_sample(const Height& height) {
  return [height](int j, std::span<float> row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = static_cast<float>(height(static_cast<int>(i), j));
    }
  };
}

/// Runs from -1 to 1 over `count` samples; 0 if there is only one.
double across(int index, int count) {
  return count > 1 ? (2.0 * index - (count - 1)) / (count - 1) : 0.0;
}

/// sin(2 pi length / wavelength), reduced to one turn first.
double wave(double length, double wavelength) {
  const double turns = length / wavelength;
  return reproducible_sin(2.0 * kPi * (turns - std::floor(turns)));
}

}  // namespace

RowFiller plane(const GeneratorValues& values, const GridShape&) {
  const double height = values.number("height");
  return each_sample([=](int, int) { return height; });
}

RowFiller tilted_plane(const GeneratorValues& values, const GridShape& shape) {
  const double height = values.number("height");
  double slope_x = values.number("slope_x", -1e4, 1e4);
  double slope_y = values.number("slope_y", -1e4, 1e4);
  const double relief = values.number("relief", 0.0, 1e7);
  const double rise = std::abs(slope_x) * (shape.columns - 1) * shape.dx_m +
                      std::abs(slope_y) * (shape.rows - 1) * shape.dy_m;
  if (relief > 0.0 && rise > 0.0) {
    slope_x *= relief / rise;
    slope_y *= relief / rise;
  }
  return each_sample(
      [=](int i, int j) { return height + i * shape.dx_m * slope_x + j * shape.dy_m * slope_y; });
}

RowFiller paraboloid(const GeneratorValues& values, const GridShape& shape) {
  const double height = values.number("height"), relief = values.number("relief");
  return each_sample([=](int i, int j) {
    const double u = across(i, shape.columns), v = across(j, shape.rows);
    return height + relief * (1.0 - (u * u + v * v) / 2.0);
  });
}

RowFiller step(const GeneratorValues& values, const GridShape& shape) {
  const double height = values.number("height"), relief = values.number("relief");
  const double position = values.number("position", 0.0, 1.0);
  const std::string& axis = values.text("axis");
  if (axis != "x" && axis != "y") values.refuse("axis", "x or y");
  const bool along_x = axis == "x";
  const int count = along_x ? shape.columns : shape.rows;
  const int last_low = static_cast<int>(std::floor((count - 1) * position));
  return each_sample(
      [=](int i, int j) { return (along_x ? i : j) > last_low ? height + relief : height; });
}

RowFiller spike(const GeneratorValues& values, const GridShape& shape) {
  const double height = values.number("height"), relief = values.number("relief");
  const int column = values.text("column") == "centre"
                         ? (shape.columns - 1) / 2
                         : values.whole("column", 0, shape.columns - 1);
  const int row = values.text("row") == "centre" ? (shape.rows - 1) / 2
                                                 : values.whole("row", 0, shape.rows - 1);
  return each_sample(
      [=](int i, int j) { return i == column && j == row ? height + relief : height; });
}

RowFiller sinusoid(const GeneratorValues& values, const GridShape& shape) {
  const double height = values.number("height"), relief = values.number("relief");
  const auto wavelength = values.pair("wavelength", 1e-3, 1e7);
  const double wavelength_x = wavelength.first, wavelength_y = wavelength.second;
  return each_sample([=](int i, int j) {
    return height +
           relief / 2.0 * (wave(i * shape.dx_m, wavelength_x) * wave(j * shape.dy_m, wavelength_y));
  });
}

RowFiller checkerboard(const GeneratorValues& values, const GridShape&) {
  const double height = values.number("height"), relief = values.number("relief");
  const int tile = values.whole("tile", 1, 1 << 30);
  return each_sample(
      [=](int i, int j) { return ((i / tile + j / tile) & 1) != 0 ? height + relief : height; });
}

}  // namespace plumb::terrain
