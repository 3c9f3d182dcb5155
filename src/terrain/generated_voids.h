// Which samples of a generated terrain are void.
#pragma once

#include <cstddef>
#include <cstdint>

namespace plumb::terrain {

/// Blobs of void that cover a part of a terrain: as many samples as one of 65536 levels of a noise
/// allow, never more than the part.
class GeneratedVoids {
 public:
  /// Of `part` (0 to 1) of columns x rows samples.
  GeneratedVoids(int columns, int rows, double part, std::uint64_t seed);

  bool at(int i, int j) const;
  std::int64_t count() const { return count_; }

 private:
  std::uint64_t seed_;
  std::size_t first_void_level_;
  std::int64_t count_ = 0;
};

}  // namespace plumb::terrain
