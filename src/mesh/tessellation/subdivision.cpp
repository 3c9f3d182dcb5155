#include "mesh/tessellation/subdivision.h"

#include <algorithm>
#include <bit>

namespace plumb::mesh::tessellation {
namespace {

// 65536 / n rounded: the only inexact number from which places are made.
constexpr std::uint32_t reciprocal(std::uint32_t n) { return (2 * kOne + n) / (2 * n); }

// To the nearest multiple of 2^-16, halves to even. The product is exact.
std::uint32_t to_fixed(float factor) {
  const double wanted = static_cast<double>(factor) * kOne;
  const auto below = static_cast<std::uint32_t>(wanted);
  const double rest = wanted - below;
  return below + (rest > 0.5 || (rest == 0.5 && below % 2 == 1) ? 1 : 0);
}

std::uint32_t round_up(float factor) {
  const auto below = static_cast<std::uint32_t>(factor);
  return below + (static_cast<float>(below) < factor ? 1 : 0);
}

Level level_of(Spacing spacing, float factor) {
  const float low = spacing == Spacing::FractionalEven ? 2.0f : 1.0f;
  const float high = spacing == Spacing::FractionalOdd ? 63.0f : 64.0f;
  const float clamped = factor > low ? std::min(factor, high) : low;  // NaN is not greater
  if (spacing == Spacing::FractionalOdd || spacing == Spacing::FractionalEven)
    return {to_fixed(clamped), spacing == Spacing::FractionalOdd};
  std::uint32_t segments = round_up(clamped);
  if (spacing == Spacing::PowerOfTwo) segments = std::bit_ceil(segments);
  return {segments * kOne, segments % 2 == 1};
}

bool exceeds_one(const Level& level) { return level.factor > kOne; }

}  // namespace

std::optional<Levels> levels_of(Spacing spacing, const Factors& factors) {
  Levels levels{};
  for (std::size_t k = 0; k < 4; ++k) {
    if (!(factors.outer[k] > 0.0f)) return std::nullopt;  // NaN too
    levels.outer[k] = level_of(spacing, factors.outer[k]);
  }
  for (std::size_t k = 0; k < 2; ++k) levels.inner[k] = level_of(spacing, factors.inner[k]);
  levels.undivided = std::ranges::none_of(levels.outer, exceeds_one) &&
                     std::ranges::none_of(levels.inner, exceeds_one);
  if (levels.undivided) return levels;
  // A rim with a factor of its own needs an inside to be joined to.
  for (Level& inner : levels.inner) {
    if (exceeds_one(inner)) continue;
    inner = spacing == Spacing::FractionalOdd ? Level{kOne + 1, true} : Level{2 * kOne, false};
  }
  return levels;
}

// Each half moves from the places of the whole number of segments below the factor to those of the
// one above. The segment that appears on the way does so at a place that bit reversal gives, so
// that the ones before it keep theirs.
Subdivision subdivide(Level level) {
  const std::uint32_t odd = level.odd ? 1 : 0;
  const std::uint32_t half = ((level.factor + 1) >> 1) + odd * (kOne / 2);
  const std::uint32_t below = half >> 16, above = (half + kOne - 1) >> 16;
  const std::uint64_t share = half & (kOne - 1);
  const std::uint32_t seed = below - odd;  // 0 only for odd factors under 3: the new one is first
  const std::uint32_t split = seed == 0 ? 0 : 2 * (seed - std::bit_floor(seed)) + 1;
  const std::uint64_t wide = reciprocal(2 * below - odd), narrow = reciprocal(2 * above - odd);
  Subdivision side;
  side.segments = 2 * above - odd;
  side.place[above] = kOne / 2;  // of an even number; an odd one overwrites it
  for (std::uint32_t i = 0; i < above; ++i) {
    const std::uint64_t before = i - (above > below && i > split ? 1 : 0);
    const auto place = static_cast<std::uint32_t>(
        (before * wide * (kOne - share) + i * narrow * share + kOne / 2) >> 16);
    side.place[i] = place;
    side.place[side.segments - i] = kOne - place;
  }
  return side;
}

}  // namespace plumb::mesh::tessellation
