// Triangles a second of the tessellator on one core, into vectors that are used again.
#include "bench_support.h"
#include "mesh/tessellation/tessellator.h"

namespace plumb::bench {
namespace {

using mesh::tessellation::Factors;
using mesh::tessellation::Spacing;
using mesh::tessellation::Tessellation;

constexpr int kPatches = 1000;  // an iteration: too many for the clock's grain to matter

void tessellator(benchmark::State& state, Spacing spacing, float factor) {
  const Factors factors{{factor, factor, factor, factor}, {factor, factor}};
  Tessellation patch;
  measure(state, [&] {
    for (int k = 0; k < kPatches; ++k) {
      mesh::tessellation::tessellate(spacing, factors, patch);
      benchmark::DoNotOptimize(patch.triangles.data());
    }
  });
  set_rate(state, "Mtriangle/s", kPatches * static_cast<double>(patch.triangles.size()));
}

void add_all() {
  for (const float factor : {8.0f, 64.0f}) {
    const std::string name = std::to_string(static_cast<int>(factor));
    add("integer/" + name, tessellator, Spacing::Integer, factor);
    add("fractional_even/" + name, tessellator, Spacing::FractionalEven, factor - 0.5f);
  }
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
  plumb::bench::add_all();
  return plumb::bench::run(argc, argv);
}
