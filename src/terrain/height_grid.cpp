#include "terrain/height_grid.h"

#include <algorithm>

#include "core/check.h"
#include "core/parallel.h"
#include "terrain/stored_heights.h"

namespace plumb::terrain {
bool HeightCoding::is_usable() const {
  const auto fits = [&](int code) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return std::abs((first + code) * scale + offset_m) <= kMost;  // false for NaN
  };
  return scale > 0.0 && fits(0) && fits(65535);
}

HeightGrid::HeightGrid(Grid<std::uint16_t> codes, const HeightCoding& coding)
    : columns_(codes.columns()),
      rows_(codes.rows()),
      is_coded_(true),
      codes_(std::move(codes)),
      coding_(coding) {
  require(coding.is_usable(),
          "heights of 16 bits need a scale > 0 by which all of them are finite, got {} and an "
          "offset of {}",
          coding.scale, coding.offset_m);
}

void HeightGrid::decode(int j, std::span<float> heights_m) const {
  const std::uint16_t* codes = codes_.row(j).data();
  const HeightCoding coding = coding_;
  for (float& height : heights_m) height = coding.height_m(*codes++);
}

std::span<const float> HeightGrid::row(int j, std::vector<float>& buffer) const {
  if (!is_coded()) return floats_.row(j);
  buffer.resize(static_cast<std::size_t>(columns_));
  decode(j, buffer);
  return buffer;
}

Grid<float> HeightGrid::to_floats() const {
  if (!is_coded()) return floats_;
  Grid<float> heights_m(columns_, rows_);
  parallel_for(rows_, 16, [&](std::int64_t row) {
    decode(static_cast<int>(row), heights_m.row(static_cast<int>(row)));
  });
  return heights_m;
}

Grid<float>& HeightGrid::floats() {
  if (is_coded()) *this = to_floats();
  return floats_;
}

void HeightGrid::copy(int from_i, int from_j, int i, int j) {
  if (is_coded()) {
    codes_(i, j) = codes_(from_i, from_j);
  } else {
    floats_(i, j) = floats_(from_i, from_j);
  }
}

bool operator==(const HeightGrid& a, const HeightGrid& b) {
  if (a.columns() != b.columns() || a.rows() != b.rows()) return false;
  std::vector<float> of_a, of_b;
  for (int j = 0; j < a.rows(); ++j) {
    const auto one = a.row(j, of_a), other = b.row(j, of_b);
    if (!std::equal(one.begin(), one.end(), other.begin())) return false;
  }
  return true;
}

StoredHeights stored(const HeightGrid& heights) {
  StoredHeights where;
  where.columns = heights.columns();
  if (heights.is_coded()) {
    where.codes = heights.as_codes()->values().data();
    where.code_first = heights.coding().first;
    where.void_code = heights.coding().void_code;
    where.code_scale = heights.coding().scale;
    where.code_offset = heights.coding().offset_m;
  } else {
    where.floats = heights.as_floats()->values().data();
  }
  return where;
}

}  // namespace plumb::terrain
