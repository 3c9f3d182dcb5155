// The heights of a terrain: floats, or the 16 bits of the file that they come from.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/grid.h"

namespace plumb::terrain {

/// How a code of 16 bits stands for a height: as the whole number first + code, which is
/// multiplied by `scale`, shifted by `offset_m` and rounded to a float, as a file's samples are.
///
///   (1) A higher code stands for no lower height.
struct HeightCoding {
  static constexpr int kNoVoid = 65536;  // no code

  int first = 0;       // 0 or -32768
  double scale = 1.0;  // metres, > 0
  double offset_m = 0.0;
  int void_code = kNoVoid;  // of a void; the code then stands for no height

  float height_m(std::uint16_t code) const {
    return code == void_code ? std::numeric_limits<float>::quiet_NaN()
                             : static_cast<float>((first + code) * scale + offset_m);
  }
  /// True if every code stands for a finite height and (1) holds.
  bool is_usable() const;

  friend bool operator==(const HeightCoding&, const HeightCoding&) = default;
};

/// columns x rows heights, metres, row by row; NaN is a void. Two bytes a height where they were
/// made from codes, else four; nothing that is read of them differs.
class HeightGrid {
 public:
  HeightGrid() = default;
  HeightGrid(Grid<float> heights_m)  // NOLINT: a grid of heights is one
      : columns_(heights_m.columns()), rows_(heights_m.rows()), floats_(std::move(heights_m)) {}
  /// Throws std::invalid_argument unless the coding is usable.
  HeightGrid(Grid<std::uint16_t> codes, const HeightCoding& coding);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t size() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }
  bool empty() const { return size() == 0; }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(i);
  }
  bool contains(int i, int j) const { return i >= 0 && i < columns_ && j >= 0 && j < rows_; }
  std::int64_t bytes() const {
    return static_cast<std::int64_t>(size() * (is_coded() ? sizeof(std::uint16_t) : sizeof(float)));
  }

  float operator()(int i, int j) const {
    const std::size_t k = index(i, j);
    return is_coded() ? coding_.height_m(codes_.values()[k]) : floats_.values()[k];
  }
  bool is_void(int i, int j) const {
    const std::size_t k = index(i, j);
    return is_coded() ? codes_.values()[k] == coding_.void_code : std::isnan(floats_.values()[k]);
  }

  /// The heights of row j, in `buffer` where they had to be made from codes.
  std::span<const float> row(int j, std::vector<float>& buffer) const;

  bool is_coded() const { return is_coded_; }
  const HeightCoding& coding() const { return coding_; }
  /// What is kept; null where it is the other.
  const Grid<float>* as_floats() const { return is_coded() ? nullptr : &floats_; }
  const Grid<std::uint16_t>* as_codes() const { return is_coded() ? &codes_ : nullptr; }

  /// A copy, all of it floats.
  Grid<float> to_floats() const;
  /// The heights as floats, to be written to; codes are given up.
  Grid<float>& floats();

  /// Makes (i, j) what (from_i, from_j) is.
  void copy(int from_i, int from_j, int i, int j);

  /// True if both have the same heights, whatever they are made from; a void equals nothing.
  friend bool operator==(const HeightGrid& a, const HeightGrid& b);

 private:
  void decode(int j, std::span<float> heights_m) const;

  int columns_ = 0, rows_ = 0;
  bool is_coded_ = false;
  Grid<float> floats_;  // one of these two is empty
  Grid<std::uint16_t> codes_;
  HeightCoding coding_;
};

/// The heights of a grid as floats: its own, or a copy where it holds codes. Keeps a reference to
/// the grid.
class FloatHeights {
 public:
  explicit FloatHeights(const HeightGrid& heights)
      : own_(heights.as_floats()), made_(own_ != nullptr ? Grid<float>{} : heights.to_floats()) {}

  const Grid<float>& operator*() const { return own_ != nullptr ? *own_ : made_; }

 private:
  const Grid<float>* own_;
  Grid<float> made_;
};

}  // namespace plumb::terrain
