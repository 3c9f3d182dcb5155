#include "mesh/dual_contouring/smoothing.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::mesh::dual_contouring {
namespace {

constexpr int kMaxRadius = 4;

// weight[k]: of the samples k away. Sums of whole numbers, divided once: no weight is rounded.
struct Weights {
  int radius = 0;
  std::array<float, kMaxRadius + 1> weight{};
  float divisor = 1.0F;
};

Weights weights_of(const Filter& filter) {
  Weights weights;
  weights.radius = filter.radius;
  const int n = 2 * filter.radius;
  if (filter.kernel == Kernel::Box) {
    weights.weight.fill(1.0F);
    weights.divisor = static_cast<float>(n + 1);
    return weights;
  }
  int binomial = 1;  // C(n, k)
  for (int k = 0; k <= filter.radius; ++k) {
    weights.weight[static_cast<std::size_t>(filter.radius - k)] = static_cast<float>(binomial);
    binomial = binomial * (n - k) / (k + 1);
  }
  weights.divisor = static_cast<float>(1 << n);
  return weights;
}

// A row of `count` results; in[k * step] are the neighbours along the axis.
void filter_row(const float* in, std::ptrdiff_t step, const Weights& weights, float* __restrict out,
                std::size_t count) {
  for (std::size_t x = 0; x < count; ++x) out[x] = weights.weight[0] * in[x];
  for (int k = 1; k <= weights.radius; ++k) {
    const float weight = weights.weight[static_cast<std::size_t>(k)];
    const float *before = in - k * step, *after = in + k * step;
    for (std::size_t x = 0; x < count; ++x) out[x] += weight * (before[x] + after[x]);
  }
  if (weights.divisor != 1.0F) {
    for (std::size_t x = 0; x < count; ++x) out[x] /= weights.divisor;
  }
}

// Along x and y, each z by itself.
Lattice<float> smoothed_flat(const Lattice<float>& density, const Weights& weights) {
  const LatticeBox box = density.box();
  const int r = weights.radius;
  Lattice<float> flat({box.low + glm::ivec3(r, r, 0), box.size - glm::ivec3(2 * r, 2 * r, 0)});
  const LatticeBox inner = flat.box();
  const auto width = static_cast<std::size_t>(inner.size.x);
  const std::size_t rows_a_slice = width * static_cast<std::size_t>(box.size.y);
  parallel_for(box.size.z, slices_a_task(rows_a_slice), [&](std::int64_t slice) {
    const int z = box.low.z + static_cast<int>(slice);
    std::vector<float> rows(rows_a_slice);
    for (int y = 0; y < box.size.y; ++y)
      filter_row(density.row(box.low.y + y, z).data() + r, 1, weights,
                 rows.data() + static_cast<std::size_t>(y) * width, width);
    for (int y = 0; y < inner.size.y; ++y)
      filter_row(rows.data() + static_cast<std::size_t>(y + r) * width,
                 static_cast<std::ptrdiff_t>(width), weights, flat.row(inner.low.y + y, z).data(),
                 width);
  });
  return flat;
}

}  // namespace

void require_valid(const Filter& filter) {
  require(filter.radius >= 0 && filter.radius <= kMaxRadius,
          "a filter's radius must be in [0, {}], got {}", kMaxRadius, filter.radius);
}

Lattice<float> smoothed(const Lattice<float>& density, const Filter& filter) {
  require_valid(filter);
  const LatticeBox box = density.box();
  const int least = std::min({box.size.x, box.size.y, box.size.z});
  require(least >= 2 * filter.radius, "a filter of radius {} needs {} samples a side, got {}",
          filter.radius, 2 * filter.radius, least);
  if (filter.radius == 0) return density;
  const Weights weights = weights_of(filter);
  Lattice<float> result(box.grown(-filter.radius));
  const LatticeBox inner = result.box();
  if (result.values().empty()) return result;
  const Lattice<float> flat = smoothed_flat(density, weights);
  const auto slice =
      static_cast<std::size_t>(inner.size.x) * static_cast<std::size_t>(inner.size.y);
  parallel_for(inner.size.z, slices_a_task(slice), [&](std::int64_t z) {
    filter_row(flat.values().data() + static_cast<std::size_t>(z + filter.radius) * slice,
               static_cast<std::ptrdiff_t>(slice), weights,
               result.values().data() + static_cast<std::size_t>(z) * slice, slice);
  });
  return result;
}

}  // namespace plumb::mesh::dual_contouring
