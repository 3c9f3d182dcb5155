// The values in a generator's argument, checked against what the generator knows.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "terrain/generators.h"

namespace plumb::terrain {

/// Columns, rows and spacings that a generator is to fill.
struct GridShape {
  int columns = 1, rows = 1;
  double dx_m = 1.0, dy_m = 1.0;
};

/// Writes the heights of row j. Called for different rows at the same time.
using RowFiller = std::function<void(int j, std::span<float> row)>;

/// A generator's name and the text of every parameter that it has, given or default.
class GeneratorValues {
 public:
  /// Splits `generate:NAME?key=value&...`. Throws InputError for an unknown name or parameter, a
  /// parameter given twice or without a value.
  explicit GeneratorValues(const std::string& argument);

  const std::string& name() const { return help_->name; }
  bool makes_stacks() const { return help_->makes_stacks; }
  /// The argument with every parameter, in the order of the help.
  std::string canonical() const;

  const std::string& text(const std::string& parameter) const;
  /// The number that a parameter holds. Throws InputError unless it lies in [low, high].
  double number(const std::string& parameter, double low, double high) const;
  double number(const std::string& parameter) const { return number(parameter, -1e7, 1e7); }
  int whole(const std::string& parameter, int low, int high) const;
  std::uint64_t seed() const;
  /// "A" or "A,B"; one number stands for both.
  std::pair<double, double> pair(const std::string& parameter, double low, double high) const;
  /// Where the south-west sample stands: origin or utm. Throws InputError for utm and another
  /// origin than 0,0.
  glm::dvec2 origin_m() const;
  /// The seed of the blobs of void.
  std::uint64_t void_seed() const { return seed() ^ 0x85ebca6bULL; }
  /// size ("N" or "WxH") and spacing ("D" or "DX,DY").
  GridShape shape() const;

  [[noreturn]] void refuse(const std::string& parameter, const std::string& expected) const;

 private:
  const GeneratorHelp* help_ = nullptr;
  std::map<std::string, std::string> given_;
};

/// The rows of the generator that `values` names. Throws InputError for a value that does not fit.
RowFiller row_filler(const GeneratorValues& values, const GridShape& shape);

}  // namespace plumb::terrain
