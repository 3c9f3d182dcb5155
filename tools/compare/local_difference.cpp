#include "compare/local_difference.h"

#include <algorithm>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::compare {
namespace {

constexpr int kRim = 2;  // of the 5 x 5 pixels

// Plain comparisons, which compilers turn into vector instructions.
inline float lesser(float a, float b) { return a < b ? a : b; }
inline float larger(float a, float b) { return a > b ? a : b; }

// A plane with its rim repeated beyond it, so that every pixel has neighbours.
class Padded {
 public:
  Padded(std::span<const float> plane, int width, int height)
      : stride_(static_cast<std::size_t>(width) + 2 * kRim),
        values_(stride_ * (static_cast<std::size_t>(height) + 2 * kRim)) {
    parallel_for(height + 2 * kRim, 16, [&](std::int64_t row) {
      const int y = std::clamp(static_cast<int>(row) - kRim, 0, height - 1);
      const float* from = &plane[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
      float* to = &values_[static_cast<std::size_t>(row) * stride_];
      std::fill_n(to, kRim, from[0]);
      std::copy_n(from, width, to + kRim);
      std::fill_n(to + kRim + width, kRim, from[width - 1]);
    });
  }

  // Row y, at its first pixel; y from -2 to height + 1.
  const float* row(int y) const {
    return &values_[static_cast<std::size_t>(y + kRim) * stride_ + kRim];
  }

 private:
  std::size_t stride_;
  std::vector<float> values_;
};

// Of a row: what the 3 x 3 pixels around hold, and the nine places a quarter of a pixel away in x
// and in y. (Between them a bilinear surface has no larger and no smaller number.)
struct RowRanges {
  std::vector<float> low, high, quarter_low, quarter_high;

  explicit RowRanges(int width)
      : low(static_cast<std::size_t>(width)), high(low), quarter_low(low), quarter_high(low) {}

  void fill(const Padded& plane, int y, int width) {
    const float *up = plane.row(y - 1), *here = plane.row(y), *down = plane.row(y + 1);
    float *l = low.data(), *h = high.data(), *ql = quarter_low.data(), *qh = quarter_high.data();
    for (int x = 0; x < width; ++x) {
      const float c = here[x], w = here[x - 1], e = here[x + 1], n = up[x], s = down[x];
      const float nw = up[x - 1], ne = up[x + 1], sw = down[x - 1], se = down[x + 1];
      l[x] = lesser(
          lesser(lesser(lesser(w, e), lesser(n, s)), lesser(lesser(nw, ne), lesser(sw, se))), c);
      h[x] = larger(
          larger(larger(larger(w, e), larger(n, s)), larger(larger(nw, ne), larger(sw, se))), c);
      const float to_w = 0.75f * c + 0.25f * w, to_e = 0.75f * c + 0.25f * e;
      const float to_n = 0.75f * c + 0.25f * n, to_s = 0.75f * c + 0.25f * s;
      const float to_nw = 0.75f * to_w + 0.25f * (0.75f * n + 0.25f * nw);
      const float to_ne = 0.75f * to_e + 0.25f * (0.75f * n + 0.25f * ne);
      const float to_sw = 0.75f * to_w + 0.25f * (0.75f * s + 0.25f * sw);
      const float to_se = 0.75f * to_e + 0.25f * (0.75f * s + 0.25f * se);
      ql[x] = lesser(lesser(lesser(lesser(to_w, to_e), lesser(to_n, to_s)),
                            lesser(lesser(to_nw, to_ne), lesser(to_sw, to_se))),
                     c);
      qh[x] = larger(larger(larger(larger(to_w, to_e), larger(to_n, to_s)),
                            larger(larger(to_nw, to_ne), larger(to_sw, to_se))),
                     c);
    }
  }
};

// Of a row: largest less smallest of the 5 x 5 pixels around.
struct RowContrast {
  std::vector<float> low, high, contrast;  // low and high: of five rows, with the rim

  explicit RowContrast(int width)
      : low(static_cast<std::size_t>(width) + 2 * kRim),
        high(low),
        contrast(static_cast<std::size_t>(width)) {}

  void fill(const Padded& plane, int y, int width) {
    const float* rows[2 * kRim + 1];
    for (int j = -kRim; j <= kRim; ++j) rows[j + kRim] = plane.row(y + j) - kRim;
    float *l = low.data(), *h = high.data();
    for (int x = 0; x < width + 2 * kRim; ++x) {
      const float a = rows[0][x], b = rows[1][x], c = rows[2][x], d = rows[3][x], e = rows[4][x];
      l[x] = lesser(lesser(lesser(a, b), lesser(d, e)), c);
      h[x] = larger(larger(larger(a, b), larger(d, e)), c);
    }
    float* result = contrast.data();
    for (int x = 0; x < width; ++x) {
      const float least =
          lesser(lesser(lesser(l[x], l[x + 1]), lesser(l[x + 3], l[x + 4])), l[x + 2]);
      const float most =
          larger(larger(larger(h[x], h[x + 1]), larger(h[x + 3], h[x + 4])), h[x + 2]);
      result[x] = most - least;
    }
  }
};

// How far a number is beyond a range.
inline float beyond(float low, float high, float value) {
  return larger(larger(0.0f, value - high), low - value);
}

// One row of one channel.
struct RowDifference {
  RowRanges reference, candidate;
  RowContrast reference_contrast, candidate_contrast;
  std::vector<float> unexplained, out_of_reference, out_of_candidate;

  explicit RowDifference(int width)
      : reference(width),
        candidate(width),
        reference_contrast(width),
        candidate_contrast(width),
        unexplained(static_cast<std::size_t>(width)),
        out_of_reference(unexplained),
        out_of_candidate(unexplained) {}

  void fill(const Padded& there, const Padded& here, int y, int width) {
    reference.fill(there, y, width);
    candidate.fill(here, y, width);
    const float *a = there.row(y), *b = here.row(y);
    for (int x = 0; x < width; ++x) {
      const auto k = static_cast<std::size_t>(x);
      // Explained from either side is explained: a thin feature is wide in one of the two.
      unexplained[k] = lesser(beyond(reference.quarter_low[k], reference.quarter_high[k], b[x]),
                              beyond(candidate.quarter_low[k], candidate.quarter_high[k], a[x]));
      out_of_reference[k] = beyond(reference.low[k], reference.high[k], b[x]);
      out_of_candidate[k] = beyond(candidate.low[k], candidate.high[k], a[x]);
    }
  }
};

void raise(float& value, float to) { value = larger(value, to); }

// What a row of a channel adds to the result.
void merge(RowDifference& row, const Padded& there, const Padded& here, int y, int width,
           LocalDifference& result) {
  bool has_contrast = false;
  const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  for (std::size_t k = 0; k < static_cast<std::size_t>(width); ++k) {
    const float unexplained = row.unexplained[k], out_of_a = row.out_of_reference[k],
                out_of_b = row.out_of_candidate[k];
    if (unexplained == 0.0f && out_of_a == 0.0f && out_of_b == 0.0f) continue;
    if (!has_contrast) {
      row.reference_contrast.fill(there, y, width);
      row.candidate_contrast.fill(here, y, width);
      has_contrast = true;
    }
    const float contrast_a = row.reference_contrast.contrast[k],
                contrast_b = row.candidate_contrast.contrast[k];
    raise(result.unexplained[first + k], unexplained);
    raise(result.out_of_range[first + k], larger(out_of_a, out_of_b));
    raise(result.isolated[first + k], larger(out_of_a - contrast_a, out_of_b - contrast_b));
    raise(result.contrast[first + k], larger(contrast_a, contrast_b));
  }
}

}  // namespace

LocalDifference local_difference(std::span<const std::span<const float>> reference,
                                 std::span<const std::span<const float>> candidate, int width_px,
                                 int height_px) {
  require(reference.size() == candidate.size() && width_px >= 1 && height_px >= 1,
          "two pictures must have the same channels and be at least 1 x 1 pixels");
  const auto size = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  const std::vector<float> nothing(size, 0.0f);
  LocalDifference result{nothing, nothing, nothing, nothing};
  for (std::size_t plane = 0; plane < reference.size(); ++plane) {
    require(reference[plane].size() == size && candidate[plane].size() == size,
            "every plane must have {} numbers", size);
    const Padded there(reference[plane], width_px, height_px);
    const Padded here(candidate[plane], width_px, height_px);
    constexpr int kRows = 16;  // that share what a row needs
    parallel_for((height_px + kRows - 1) / kRows, 1, [&](std::int64_t band) {
      RowDifference row(width_px);
      const int first = static_cast<int>(band) * kRows;
      for (int y = first; y < std::min(first + kRows, height_px); ++y) {
        row.fill(there, here, y, width_px);
        merge(row, there, here, y, width_px, result);
      }
    });
  }
  return result;
}

}  // namespace plumb::compare
