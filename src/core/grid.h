// A rectangle of values: column i runs east, row j runs north.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/check.h"

namespace plumb {

/// columns x rows values in row-major order; (i, j) is column i of row j. T is not bool.
template <class T>
class Grid {
 public:
  Grid() = default;
  Grid(int columns, int rows, T fill = T{}) : columns_(columns), rows_(rows) {
    require(columns >= 0 && rows >= 0, "a grid's size must be >= 0, got {} x {}", columns, rows);
    values_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), fill);
  }

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool empty() const { return values_.empty(); }
  std::size_t size() const { return values_.size(); }

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(i);
  }
  bool contains(int i, int j) const { return i >= 0 && i < columns_ && j >= 0 && j < rows_; }
  T& operator()(int i, int j) { return values_[index(i, j)]; }
  const T& operator()(int i, int j) const { return values_[index(i, j)]; }

  std::span<T> row(int j) {
    return {values_.data() + index(0, j), static_cast<std::size_t>(columns_)};
  }
  std::span<const T> row(int j) const {
    return {values_.data() + index(0, j), static_cast<std::size_t>(columns_)};
  }
  std::vector<T>& values() { return values_; }
  const std::vector<T>& values() const { return values_; }

  friend bool operator==(const Grid&, const Grid&) = default;

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<T> values_;
};

}  // namespace plumb
