// What a drawn surface costs, in counters that are the same on every machine.
#pragma once

#include <cstdint>

namespace plumb {

struct Cost {
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  std::int64_t slices = 0;
  std::int64_t fragments = 0;       // rasterised, overdraw included; filled in by who draws
  std::int64_t nodes_visited = 0;   // of the method's hierarchy, for this frame
  std::int64_t bytes_resident = 0;  // what drawing needs in memory
  std::int64_t bytes_encoded = 0;   // of a prepared file; 0 where there is none

  friend bool operator==(const Cost&, const Cost&) = default;
};

}  // namespace plumb
