#include <span>
#include <vector>

#include "compare/flip.h"
#include "compare/flip_pool.h"
#include "core/hash.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

using compare::ColourPlanes;

constexpr int kWidth = 75, kHeight = 53;

// Six channels: patches with noise, from below `low` to `high`.
std::vector<std::vector<float>> channels(std::uint64_t seed, double low, double high) {
  Sequence numbers(seed);
  std::vector<std::vector<float>> values(6);
  for (int c = 0; c < 6; ++c) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double even = ((x / 9 * 5 + y / 7 * 3 + c) % 8) / 8.0;
        const double share = even + numbers.between(-0.1, 0.1);
        values[c].push_back(static_cast<float>(low + (high - low) * share * share * share));
      }
    }
  }
  return values;
}

ColourPlanes planes(const std::vector<std::vector<float>>& values, int first) {
  return {kWidth, kHeight, values[first], values[first + 1], values[first + 2]};
}

std::uint64_t flip() {
  Checksum sum;
  const auto srgb = channels(11, -0.05, 1.1), light = channels(12, -0.1, 30.0);
  for (const double density : {compare::kFlipPixelsPerDegree, 11.0, 200.0}) {
    const compare::FlipMap map = compare::flip_ldr(planes(srgb, 0), planes(srgb, 3), {density});
    sum.add(std::span<const float>(map.error));
    const compare::FlipPooled pooled = compare::pool_flip(map.error);
    sum.add(pooled.mean).add(pooled.first_quartile).add(pooled.median).add(pooled.third_quartile);
  }
  for (const auto mapper :
       {compare::ToneMapper::Aces, compare::ToneMapper::Hable, compare::ToneMapper::Reinhard}) {
    compare::HdrFlipOptions options;
    options.tone_mapper = mapper;
    const compare::HdrFlip hdr = compare::flip_hdr(planes(light, 0), planes(light, 3), options);
    sum.add(hdr.range.start_stops).add(hdr.range.stop_stops).add(hdr.range.count);
    sum.add(std::span<const float>(hdr.largest.error));
    sum.add(std::span<const int>(hdr.exposure_index));
  }
  return sum.value();
}

}  // namespace

std::vector<Stage> compare_stages() { return {{"compare.flip", flip}}; }

}  // namespace plumb::determinism
