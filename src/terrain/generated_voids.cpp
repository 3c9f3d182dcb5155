#include "terrain/generated_voids.h"

#include <vector>

#include "core/parallel.h"
#include "terrain/gradient_noise.h"

namespace plumb::terrain {
namespace {

constexpr int kLevels = 65536;

/// How deep in a blob of void a sample lies, as a level below kLevels.
std::size_t void_level(int i, int j, std::uint64_t seed) {
  constexpr double kBlob = 1.0 / 24.0;  // in samples
  // Half a lattice step aside, as the noise is 0 on the lattice; a little hash parts equals.
  const double noise = gradient_noise((i + 0.5) * kBlob, (j + 0.5) * kBlob, seed);
  const double fine = lattice_part(i, j, ~seed);
  const double level = ((noise + 1.0) * 0.5 * 0.98 + 0.02 * fine) * (kLevels - 1);
  return static_cast<std::size_t>(level);
}

using Counts = std::vector<std::int64_t>;

Counts samples_of_levels(int columns, int rows, std::uint64_t seed) {
  return parallel_ordered_reduce(
      rows, 256, Counts(kLevels, 0),
      [&](std::int64_t begin, std::int64_t end, Counts found) {
        for (std::int64_t j = begin; j < end; ++j) {
          for (int i = 0; i < columns; ++i) ++found[void_level(i, static_cast<int>(j), seed)];
        }
        return found;
      },
      [](Counts a, const Counts& b) {
        for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k];
        return a;
      });
}

}  // namespace

GeneratedVoids::GeneratedVoids(int columns, int rows, double part, std::uint64_t seed)
    : seed_(seed), first_void_level_(kLevels) {
  if (!(part > 0.0)) return;
  const Counts counts = samples_of_levels(columns, rows, seed);
  const double wanted = part * (static_cast<double>(columns) * static_cast<double>(rows));
  while (first_void_level_ > 0 &&
         static_cast<double>(count_ + counts[first_void_level_ - 1]) <= wanted) {
    count_ += counts[--first_void_level_];
  }
}

bool GeneratedVoids::at(int i, int j) const {
  return count_ > 0 && void_level(i, j, seed_) >= first_void_level_;
}

}  // namespace plumb::terrain
