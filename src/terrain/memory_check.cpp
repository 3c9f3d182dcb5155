#include "terrain/memory_check.h"

#include "core/check.h"

namespace plumb::terrain {

void require_memory(const std::string& name, std::int64_t columns, std::int64_t rows,
                    int bytes_per_sample, std::uint64_t available_bytes) {
  // Sizes fit in 31 bits each, so the bytes fit in 64 bits for up to four bytes a sample; in double
  // they always do, and 2^53 bytes are more than any machine has.
  const double needed = static_cast<double>(columns) * static_cast<double>(rows) * bytes_per_sample;
  if (needed > static_cast<double>(available_bytes)) {
    input_error("{}: {} x {} samples need {:.0f} bytes of memory, there are {}", name, columns,
                rows, needed, available_bytes);
  }
  constexpr double kMostCells = 2147483646.0;  // two triangles a cell are counted in 32 bits
  if (static_cast<double>(columns - 1) * static_cast<double>(rows - 1) > kMostCells) {
    input_error(
        "{}: {} x {} samples have more than the 2^31 - 2 cells that a terrain may have: "
        "choose a part with --window",
        name, columns, rows);
  }
}

}  // namespace plumb::terrain
