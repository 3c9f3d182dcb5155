#include "mesh/patch_quadtree/child_samples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

namespace plumb::mesh::patch_quadtree {
namespace {

constexpr int kOff = 2;

// Thresholds of liveliness, 64ths of four numbers: three classes an octave.
std::uint8_t context_of(std::uint32_t liveliness) {
  const std::uint32_t x = (liveliness >> 6) + 4;  // 4 is none at all
  const int octave = std::bit_width(x) - 3;
  const std::uint32_t within = x >> octave;  // 4 .. 7
  return static_cast<std::uint8_t>(
      std::min<std::uint32_t>(4u * static_cast<std::uint32_t>(octave) + within - 4u,
                              static_cast<std::uint32_t>(kContexts) - 1u));
}

void start(std::size_t count, Foretold& row) {
  row.value.resize(count);
  row.context.resize(count);
}

// 64 p from four near numbers and eight about twice as far, and the context by the near ones.
struct Cross {
  static constexpr std::int32_t kNear = 22, kFar = -3;

  static void put(std::int32_t near_a, std::int32_t near_b, std::int32_t near_c,
                  std::int32_t near_d, std::int32_t far, std::size_t at, Foretold& row) {
    const std::int32_t p = kNear * (near_a + near_b + near_c + near_d) + kFar * far;
    row.value[at] = p;
    row.context[at] = context_of(
        static_cast<std::uint32_t>(std::abs(64 * near_a - p) + std::abs(64 * near_b - p) +
                                   std::abs(64 * near_c - p) + std::abs(64 * near_d - p)));
  }
};

// 4 x 4 numbers around a centre by (-1, 9, 9, -1) / 16 both ways, as 256ths.
std::int32_t cubic(const std::int32_t* a) { return 9 * (a[1] + a[2]) - a[0] - a[3]; }

}  // namespace

ChildSamples::ChildSamples(int patch_cells)
    : n(patch_cells),
      known(n / 2 + 5, n / 2 + 5),
      centre(n / 2 + 4, n / 2 + 4),
      across(n / 2 + 4, n / 2 + 5),
      up(n / 2 + 5, n / 2 + 4) {}

void ChildSamples::set_known(const Grid<std::int32_t>& parent, int s, int t) {
  const int last = parent.columns() - 1;
  for (int b = 0; b < known.rows(); ++b) {
    // Sample 2 (b - 2) of the child is sample b - 2 + t n/2 of the parent, one further in its grid.
    const int row = std::clamp(b - kOff + t * n / 2 + 1, 0, last);
    for (int a = 0; a < known.columns(); ++a)
      known(a, b) = parent(std::clamp(a - kOff + s * n / 2 + 1, 0, last), row);
  }
}

void ChildSamples::repeat_rim_of_centres() {
  const int last = centre.columns() - 1;  // a = n/2 + 1 is beyond the patch
  for (int b = 1; b < last; ++b) {
    centre(0, b) = centre(1, b);
    centre(last, b) = centre(last - 1, b);
  }
  for (int a = 0; a <= last; ++a) {
    centre(a, 0) = centre(a, 1);
    centre(a, last) = centre(a, last - 1);
  }
}

namespace {

// visit(i + 1, j + 1, the sample's number, whether it is the parent's) for every sample.
template <class Samples, class Visit>
void for_each_sample(Samples& samples, const Visit& visit) {
  for (int j = -1; j <= samples.n + 1; ++j) {
    const bool odd_j = (j & 1) != 0;
    const int b = (j >> 1) + kOff;
    for (int i = -1; i <= samples.n + 1; ++i) {
      const bool odd_i = (i & 1) != 0;
      auto& grid =
          odd_i ? (odd_j ? samples.centre : samples.across) : (odd_j ? samples.up : samples.known);
      visit(i + 1, j + 1, grid((i >> 1) + kOff, b), !odd_i && !odd_j);
    }
  }
}

}  // namespace

Grid<std::int32_t> ChildSamples::joined() const {
  Grid<std::int32_t> patch(n + 3, n + 3);
  for_each_sample(*this,
                  [&](int x, int y, const std::int32_t& number, bool) { patch(x, y) = number; });
  return patch;
}

void ChildSamples::split(const Grid<std::int32_t>& patch) {
  for_each_sample(*this, [&](int x, int y, std::int32_t& number, bool is_known) {
    if (!is_known) number = patch(x, y);
  });
}

void foretell_centres(const ChildSamples& samples, int b, Foretold& row) {
  const int half = samples.n / 2;
  start(static_cast<std::size_t>(half) + 2, row);
  const std::int32_t* rows[4];
  for (int k = 0; k < 4; ++k) {
    const int at = std::clamp(b - 1 + k + kOff, 0, samples.known.rows() - 1);
    rows[k] = samples.known.row(at).data();
  }
  // Columns summed up the four rows first, by the same weights; one more at either end repeats.
  std::vector<std::int32_t> column(static_cast<std::size_t>(half) + 7);
  for (int c = 0; c < half + 5; ++c) {
    const std::array<std::int32_t, 4> four{rows[0][c], rows[1][c], rows[2][c], rows[3][c]};
    column[static_cast<std::size_t>(c) + 1] = cubic(four.data());
  }
  column.front() = column[1];
  column.back() = column[column.size() - 2];
  for (int a = -1; a <= half; ++a) {
    const int c = a + kOff;  // the known one to the left
    const std::int32_t p = (cubic(&column[static_cast<std::size_t>(c)]) + 2) >> 2;
    const auto at = static_cast<std::size_t>(a + 1);
    row.value[at] = p;
    row.context[at] = context_of(static_cast<std::uint32_t>(
        std::abs(64 * rows[1][c] - p) + std::abs(64 * rows[1][c + 1] - p) +
        std::abs(64 * rows[2][c] - p) + std::abs(64 * rows[2][c + 1] - p)));
  }
}

void foretell_across(const ChildSamples& samples, int b, Foretold& row) {
  const int half = samples.n / 2;
  start(static_cast<std::size_t>(half) + 2, row);
  const std::int32_t *here = samples.known.row(b + kOff).data(),
                     *above = samples.known.row(b + 1 + kOff).data(),
                     *below = samples.known.row(b - 1 + kOff).data();
  const std::int32_t *up = samples.centre.row(b + kOff).data(),
                     *down = samples.centre.row(b - 1 + kOff).data();
  for (int a = -1; a <= half; ++a) {
    const int c = a + kOff;
    const std::int32_t far = up[c - 1] + up[c + 1] + down[c - 1] + down[c + 1] + above[c] +
                             above[c + 1] + below[c] + below[c + 1];
    Cross::put(here[c], here[c + 1], up[c], down[c], far, static_cast<std::size_t>(a + 1), row);
  }
}

void foretell_up(const ChildSamples& samples, int b, Foretold& row) {
  const int half = samples.n / 2;
  start(static_cast<std::size_t>(half) + 1, row);
  const std::int32_t *low = samples.known.row(b + kOff).data(),
                     *high = samples.known.row(b + 1 + kOff).data();
  const std::int32_t *here = samples.centre.row(b + kOff).data(),
                     *above = samples.centre.row(b + 1 + kOff).data(),
                     *below = samples.centre.row(b - 1 + kOff).data();
  for (int a = 0; a <= half; ++a) {
    const int c = a + kOff;
    const std::int32_t far = low[c - 1] + low[c + 1] + high[c - 1] + high[c + 1] + above[c - 1] +
                             above[c] + below[c - 1] + below[c];
    Cross::put(low[c], high[c], here[c - 1], here[c], far, static_cast<std::size_t>(a), row);
  }
}

}  // namespace plumb::mesh::patch_quadtree
