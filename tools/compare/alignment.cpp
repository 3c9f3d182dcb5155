#include "compare/alignment.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "compare/local_difference.h"
#include "core/check.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"

namespace plumb::compare {
namespace {

constexpr int kRim = kFarthestShift_px + 2;
constexpr int kLeastSide = 2 * kRim + 6;

// Bilinear, (x, y) in samples; the place lies inside.
double at(const Grid<float>& picture, double x, double y) {
  const int i = std::min(static_cast<int>(x), picture.columns() - 2);
  const int j = std::min(static_cast<int>(y), picture.rows() - 2);
  const double a = x - i, b = y - j;
  return (1.0 - b) * ((1.0 - a) * picture(i, j) + a * picture(i + 1, j)) +
         b * ((1.0 - a) * picture(i, j + 1) + a * picture(i + 1, j + 1));
}

// Sums for one step towards the best shift, over all pixels but the rim's.
struct Normal {
  double xx = 0.0, xy = 0.0, yy = 0.0, xd = 0.0, yd = 0.0, dd = 0.0;
  std::int64_t count = 0;

  void add(const Normal& other) {
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
    xd += other.xd;
    yd += other.yd;
    dd += other.dd;
    count += other.count;
  }
  double rms() const { return count > 0 ? std::sqrt(dd / static_cast<double>(count)) : 0.0; }
};

// A hundred thousand pixels tell a shift as well as all do: of larger pictures some rows.
int row_stride(const Grid<float>& picture) {
  constexpr std::int64_t kEnough = 100'000;
  const std::int64_t pixels = std::int64_t{picture.columns()} * picture.rows();
  return static_cast<int>(std::max<std::int64_t>(1, pixels / kEnough));
}

// Reference moved by `by`, candidate by `back`. What differs by more than `most` counts as that
// much and has no say in where to go: outlines that a sampler took for one side or the other.
Normal sums(const Grid<float>& reference, const Grid<float>& candidate, const glm::dvec2& by,
            const glm::dvec2& back) {
  const int stride = row_stride(reference);
  return parallel_ordered_reduce(
      (reference.rows() - 2 * kRim + stride - 1) / stride, 16, Normal{},
      [&](std::int64_t begin, std::int64_t end, Normal normal) {
        for (auto k = static_cast<int>(begin); k < static_cast<int>(end); ++k) {
          const int row = kRim + stride * k;
          for (int column = kRim; column < reference.columns() - kRim; ++column) {
            const double x = column - by.x, y = row - by.y, u = column - back.x, v = row - back.y;
            const double difference = at(candidate, u, v) - at(reference, x, y);
            ++normal.count;
            normal.dd += difference * difference;
            // Change of the two pictures' mean along x and y.
            const double dx = 0.25 * (at(reference, x + 1.0, y) - at(reference, x - 1.0, y) +
                                      at(candidate, u + 1.0, v) - at(candidate, u - 1.0, v));
            const double dy = 0.25 * (at(reference, x, y + 1.0) - at(reference, x, y - 1.0) +
                                      at(candidate, u, v + 1.0) - at(candidate, u, v - 1.0));
            normal.xx += dx * dx;
            normal.xy += dx * dy;
            normal.yy += dy * dy;
            normal.xd += dx * difference;
            normal.yd += dy * difference;
          }
        }
        return normal;
      },
      [](Normal a, const Normal& b) {
        a.add(b);
        return a;
      });
}

// Sum of squared differences at a whole shift, of every fourth row or fewer.
double squares_at(const Grid<float>& reference, const Grid<float>& candidate, int di, int dj) {
  const int stride = 4 * row_stride(reference);
  const int rows = (reference.rows() - 2 * kRim + stride - 1) / stride;
  return parallel_ordered_reduce(
      rows, 16, 0.0,
      [&](std::int64_t begin, std::int64_t end, double value) {
        for (auto k = static_cast<int>(begin); k < static_cast<int>(end); ++k) {
          const int j = kRim + stride * k;
          for (int i = kRim; i < reference.columns() - kRim; ++i) {
            const double d = double{candidate(i + di, j + dj)} - double{reference(i, j)};
            value += d * d;
          }
        }
        return value;
      },
      [](double a, double b) { return a + b; });
}

glm::dvec2 best_whole_shift(const Grid<float>& reference, const Grid<float>& candidate) {
  glm::dvec2 best(0.0);
  double least = squares_at(reference, candidate, 0, 0);
  for (int dj = -kFarthestShift_px; dj <= kFarthestShift_px; ++dj) {
    for (int di = -kFarthestShift_px; di <= kFarthestShift_px; ++di) {
      const double here = squares_at(reference, candidate, di, dj);
      if (!(here < least)) continue;
      least = here;
      best = {di, dj};
    }
  }
  return best;
}

glm::dvec2 step(const Normal& n) {
  const double determinant = n.xx * n.yy - n.xy * n.xy;
  // A picture without structure in some direction says nothing of a shift along it.
  if (!(determinant > 1e-9 * n.xx * n.yy) || n.count == 0) return glm::dvec2(0.0);
  return {-(n.yy * n.xd - n.xy * n.yd) / determinant, -(n.xx * n.yd - n.xy * n.xd) / determinant};
}

// From a shift, by small steps, to the least difference around it.
struct Descent {
  glm::dvec2 by{0.0};
  Normal there;
};

Descent descend(const Grid<float>& reference, const Grid<float>& candidate, glm::dvec2 from) {
  Descent best{from, sums(reference, candidate, 0.5 * from, -0.5 * from)};
  for (int round = 0; round < 4; ++round) {
    const glm::dvec2 change = step(best.there);
    const double longest = std::max(std::abs(change.x), std::abs(change.y));
    if (!(longest < 1.0)) break;  // no small step: the pictures are too different for one
    Descent next{glm::clamp(best.by + change, -kFarthestShift_px - 0.5, kFarthestShift_px + 0.5),
                 {}};
    next.there = sums(reference, candidate, 0.5 * next.by, -0.5 * next.by);
    if (!(next.there.dd < best.there.dd)) break;
    best = next;
    if (longest < 1e-3) break;
  }
  return best;
}

// Least root mean square difference of a shift no longer than `radius`, by the differences and
// slopes at another one.
double rms_within(double radius, const Descent& found) {
  const Normal& n = found.there;
  if (glm::length(found.by) <= radius) return n.rms();
  constexpr int kDirections = 64;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 6.283185307179586 * k / kDirections;
    const glm::dvec2 d =
        radius * glm::dvec2(reproducible_cos(angle), reproducible_sin(angle)) - found.by;
    least = std::min(least, n.dd + 2.0 * (d.x * n.xd + d.y * n.yd) + d.x * d.x * n.xx +
                                2.0 * d.x * d.y * n.xy + d.y * d.y * n.yy);
  }
  return std::sqrt(std::max(0.0, least) / static_cast<double>(n.count));
}

}  // namespace

Shift find_shift(const Grid<float>& reference, const Grid<float>& candidate) {
  require(reference.columns() == candidate.columns() && reference.rows() == candidate.rows(),
          "two pictures must be of one size");
  Shift shift;
  if (std::min(reference.columns(), reference.rows()) < kLeastSide) return shift;
  // A picture of little but an outline is much the same along it: what is near comes first.
  Descent best = descend(reference, candidate, glm::dvec2(0.0));
  if (const glm::dvec2 whole = best_whole_shift(reference, candidate); whole != glm::dvec2(0.0)) {
    const Descent other = descend(reference, candidate, whole);
    if (other.there.dd < best.there.dd) best = other;
  }
  shift.by_px = best.by;
  shift.rms_after = best.there.rms();
  shift.rms_before = sums(reference, candidate, 0.5 * best.by, 0.5 * best.by).rms();
  shift.rms_of_jitter = rms_within(kJitter_px, best);
  return shift;
}

namespace {

// The picture without its rim, moved.
Grid<float> moved(const Grid<float>& picture, const glm::dvec2& by) {
  Grid<float> result(picture.columns() - 2 * kRim, picture.rows() - 2 * kRim);
  parallel_for(result.rows(), 16, [&](std::int64_t row) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < result.columns(); ++i)
      result(i, j) = static_cast<float>(at(picture, i + kRim - by.x, j + kRim - by.y));
  });
  return result;
}

double unexplained_share(const Grid<float>& reference, const Grid<float>& candidate) {
  const std::vector<std::span<const float>> there{reference.values()}, here{candidate.values()};
  const LocalDifference local =
      local_difference(there, here, reference.columns(), reference.rows());
  std::size_t count = 0;
  for (std::size_t k = 0; k < local.unexplained.size(); ++k)
    count += local.unexplained[k] > 2.0f / 255.0f &&
             local.unexplained[k] > kContrastShare * local.contrast[k];
  return static_cast<double>(count) / static_cast<double>(local.unexplained.size());
}

}  // namespace

Unexplained unexplained_by(const Grid<float>& reference, const Grid<float>& candidate,
                           const glm::dvec2& by_px) {
  if (std::min(reference.columns(), reference.rows()) < kLeastSide) return {};
  const glm::dvec2 half = 0.5 * by_px;
  const Grid<float> there = moved(reference, half);
  return {unexplained_share(there, moved(candidate, half)),
          unexplained_share(there, moved(candidate, -half))};
}

namespace {

constexpr int kSquare = 4;

// Mean of the 4 x 4 pixels of a square; nothing where it leaves the picture.
std::optional<double> mean_around(const Grid<float>& picture, double x, double y, double spread) {
  double sum = 0.0;
  for (int j = 0; j < kSquare; ++j) {
    for (int i = 0; i < kSquare; ++i) {
      const double u = x + spread * (i - 0.5 * (kSquare - 1)),
                   v = y + spread * (j - 0.5 * (kSquare - 1));
      if (!(u >= 0.0 && v >= 0.0 && u <= picture.columns() - 1.0 && v <= picture.rows() - 1.0))
        return std::nullopt;
      sum += at(picture, u, v);
    }
  }
  return sum / (kSquare * kSquare);
}

}  // namespace

double rms_enlarged(const Grid<float>& reference, const Grid<float>& candidate, double factor) {
  require(factor > 0.0, "a factor must be > 0, got {}", factor);
  if (std::min(reference.columns(), reference.rows()) < kLeastSide) return 0.0;
  const double middle_x = 0.5 * (reference.columns() - 1), middle_y = 0.5 * (reference.rows() - 1);
  struct Sum {
    double squares = 0.0;
    std::int64_t count = 0;
  };
  const std::int64_t rows_of_squares = reference.rows() / kSquare;
  const std::int64_t stride = std::max(1, row_stride(reference) / kSquare);
  const Sum all = parallel_ordered_reduce(
      (rows_of_squares + stride - 1) / stride, 8, Sum{},
      [&](std::int64_t begin, std::int64_t end, Sum sum) {
        for (std::int64_t row = stride * begin; row < stride * end && row < rows_of_squares;
             row += stride) {
          for (int i = 0; i + kSquare <= reference.columns(); i += kSquare) {
            const double x = i + 0.5 * (kSquare - 1),
                         y = static_cast<double>(kSquare * row) + 0.5 * (kSquare - 1);
            const auto there = mean_around(reference, middle_x + (x - middle_x) / factor,
                                           middle_y + (y - middle_y) / factor, 1.0 / factor);
            const auto here = mean_around(candidate, x, y, 1.0);
            if (!there || !here) continue;
            sum.squares += (*here - *there) * (*here - *there);
            ++sum.count;
          }
        }
        return sum;
      },
      [](const Sum& a, const Sum& b) {
        return Sum{a.squares + b.squares, a.count + b.count};
      });
  return all.count > 0 ? std::sqrt(all.squares / static_cast<double>(all.count)) : 0.0;
}

}  // namespace plumb::compare
