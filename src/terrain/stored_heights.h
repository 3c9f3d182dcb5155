// Where a terrain's heights lie, for kernels that read many of them at once.
#pragma once

#include <cstdint>

namespace plumb::terrain {

class HeightGrid;

/// Samples row by row: floats, of which NaN is a void, or codes as HeightCoding has them; the other
/// pointer is null.
struct StoredHeights {
  const float* floats = nullptr;
  const std::uint16_t* codes = nullptr;
  int code_first = 0, void_code = 65536;
  double code_scale = 1.0, code_offset = 0.0;
  std::int32_t columns = 0;  // of samples
};

/// Points to the grid's own.
StoredHeights stored(const HeightGrid& heights);

}  // namespace plumb::terrain
