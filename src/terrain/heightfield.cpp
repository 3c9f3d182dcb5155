#include "terrain/heightfield.h"

#include <algorithm>
#include <bit>

#include "core/check.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

const char* name_of(Diagonal diagonal) {
  switch (diagonal) {
    case Diagonal::Alternating:
      return "alternating";
    case Diagonal::Fixed:
      return "fixed";
    case Diagonal::Blocks8:
      return "blocks:8";
  }
  return "?";
}

Diagonal parse_diagonal(const std::string& text) {
  for (const Diagonal diagonal : {Diagonal::Alternating, Diagonal::Fixed, Diagonal::Blocks8}) {
    if (text == name_of(diagonal)) return diagonal;
  }
  input_error("diagonal '{}': expected alternating, fixed or blocks:8", text);
}

std::string local_system(const std::string& crs) {
  return fmt::format("local metres ({} laid out flat)", crs);
}

std::string system_of_coordinates(const Provenance& provenance) {
  return provenance.is_local && !provenance.crs.empty() ? local_system(provenance.crs)
                                                        : provenance.crs;
}

namespace {

template <class Value>
struct Range {
  Value low, high;
};

// Least and greatest value; `none` where all are void.
template <class Value, class IsVoid>
Range<Value> range_of(const Grid<Value>& values, Range<Value> none, const IsVoid& is_void) {
  return parallel_ordered_reduce(
      values.rows(), 64, none,
      [&](std::int64_t begin, std::int64_t end, Range<Value> found) {
        for (std::int64_t j = begin; j < end; ++j) {
          for (const Value value : values.row(static_cast<int>(j))) {
            if (is_void(value)) continue;
            found.low = std::min(found.low, value);
            found.high = std::max(found.high, value);
          }
        }
        return found;
      },
      [](Range<Value> a, Range<Value> b) {
        return Range<Value>{std::min(a.low, b.low), std::max(a.high, b.high)};
      });
}

Range<float> range_of(const HeightGrid& heights_m) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr Range<float> kNone{kInfinity, -kInfinity};
  if (!heights_m.is_coded())
    return range_of(*heights_m.as_floats(), kNone, [](float height) { return std::isnan(height); });
  const HeightCoding& coding = heights_m.coding();
  const auto codes = range_of(*heights_m.as_codes(), Range<std::uint16_t>{65535, 0},
                              [&](std::uint16_t code) { return code == coding.void_code; });
  if (codes.low > codes.high) return kNone;
  return {coding.height_m(codes.low), coding.height_m(codes.high)};
}

}  // namespace

Box bounds(const Heightfield& field) {
  const Range<float> range = range_of(field.heights_m);
  Box box;
  if (range.low <= range.high) {
    box.low = {0.0, 0.0, range.low};
    box.high = {field.cell_columns() * field.dx_m, field.cell_rows() * field.dy_m, range.high};
  }
  return box;
}

std::uint64_t checksum(const Heightfield& field) {
  Checksum sum;
  sum.add(std::int64_t{field.columns()}).add(std::int64_t{field.rows()});
  sum.add(field.dx_m).add(field.dy_m).add(field.origin_m.x).add(field.origin_m.y);
  constexpr std::uint32_t kVoid = 0x7fc00000u;  // every NaN counts as the same one
  std::vector<std::uint32_t> bits;
  std::vector<float> buffer;
  for (int j = 0; j < field.rows(); ++j) {
    bits.clear();
    for (const float height : field.heights_m.row(j, buffer)) {
      bits.push_back(std::isnan(height) ? kVoid : std::bit_cast<std::uint32_t>(height));
    }
    sum.add(std::span<const std::uint32_t>(bits));
  }
  if (field.stacks != nullptr) sum.add(checksum(*field.stacks));
  return sum.value();
}

void require_valid(const Heightfield& field) {
  require(field.columns() >= 1 && field.rows() >= 1,
          "a heightfield needs at least one sample, got {} x {}", field.columns(), field.rows());
  require(field.dx_m > 0.0 && std::isfinite(field.dx_m) && field.dy_m > 0.0 &&
              std::isfinite(field.dy_m),
          "a heightfield's spacing must be positive and finite, got {} x {} m", field.dx_m,
          field.dy_m);
  require(std::isfinite(field.origin_m.x) && std::isfinite(field.origin_m.y),
          "a heightfield's origin must be finite");
  require(static_cast<std::int64_t>(field.cell_columns()) * field.cell_rows() <
              (std::int64_t{1} << 31) - 1,
          "a heightfield may have at most 2^31 - 2 cells, got {} x {} samples", field.columns(),
          field.rows());
  if (field.heights_m.is_coded()) return;  // no code stands for an infinite height
  std::vector<float> none;
  for (int j = 0; j < field.rows(); ++j) {
    for (const float height : field.heights_m.row(j, none)) {
      if (std::isinf(height))
        throw std::invalid_argument("a height must be finite or NaN (void), got an infinite one");
    }
  }
}

}  // namespace plumb::terrain
