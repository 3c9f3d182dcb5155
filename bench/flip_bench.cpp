// FLIP on full HD, on one core with each instruction set and on all; what the comparer spends
// there.
#include "bench_support.h"
#include "compare/flip.h"
#include "compare/flip_pool.h"
#include "core/instruction_set.h"

namespace plumb::bench {
namespace {

using compare::ColourPlanes;

constexpr int kWidth = 1920, kHeight = 1080;

// Shapes of every size and some noise, from whole numbers of 8 bits; linear light has the fourth
// power of that, a range of some stops.
std::vector<float> channel_of(std::uint32_t seed, bool linear) {
  std::vector<float> values;
  std::uint32_t state = seed;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      state = state * 1664525u + 1013904223u;
      const std::uint32_t shape = (static_cast<std::uint32_t>(x * x + y * y + x * y) >> 9) * seed;
      const float value = static_cast<float>((shape + (state >> 28)) & 255u) / 255.0f;
      values.push_back(linear ? 64.0f * value * value * value * value : value);
    }
  }
  return values;
}

struct Pair {
  std::vector<float> channels[6];

  explicit Pair(bool linear) {
    for (std::uint32_t k = 0; k < 6; ++k) channels[k] = channel_of(3 + 2 * k, linear);
  }
  ColourPlanes reference() const {
    return {kWidth, kHeight, channels[0], channels[1], channels[2]};
  }
  ColourPlanes candidate() const {
    return {kWidth, kHeight, channels[3], channels[4], channels[5]};
  }
};

const Pair& ldr_pair() {
  static const Pair kPair(false);
  return kPair;
}

void flip_ldr(benchmark::State& state, InstructionSet set) {
  const ForcedInstructionSet forced(set);
  measure(state, [] { compare::flip_ldr(ldr_pair().reference(), ldr_pair().candidate()); });
  set_rate(state, "Mpixel/s", 1.0 * kWidth * kHeight);
}

void flip_hdr(benchmark::State& state) {
  static const Pair kPair(true);
  int exposures = 0;
  measure(state,
          [&] { exposures = compare::flip_hdr(kPair.reference(), kPair.candidate()).range.count; });
  state.counters["exposures"] = exposures;
}

void pool(benchmark::State& state) {
  const compare::FlipMap map = compare::flip_ldr(ldr_pair().reference(), ldr_pair().candidate());
  measure(state, [&] { benchmark::DoNotOptimize(compare::pool_flip(map.error)); });
}

void add_all() {
  for (const InstructionSet set : available_instruction_sets())
    add(std::string("flip_ldr/") + name_of(set), flip_ldr, set);
  add("flip_hdr", flip_hdr);
  add("flip_pool", pool);
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  plumb::bench::add_all();
  return plumb::bench::run(argc, argv);
}
