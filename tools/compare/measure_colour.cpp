// Colour: numbers as stored, structure, FLIP, and what no small shift explains.
#include <algorithm>
#include <cmath>

#include "compare/flip.h"
#include "compare/flip_pool.h"
#include "compare/local_difference.h"
#include "compare/measuring.h"
#include "compare/plane_errors.h"
#include "compare/shift_match.h"
#include "compare/structural_similarity.h"

namespace plumb::compare {
namespace {

using Spans = std::vector<std::span<const float>>;
constexpr const char* kGroup = "colour";

Spans spans_of(const std::vector<const image::Plane*>& planes) {
  Spans spans;
  for (const image::Plane* plane : planes) spans.push_back(plane->values);
  return spans;
}

// The largest difference of a channel; NaN where any number is not finite.
std::vector<float> difference_map(const Spans& reference, const Spans& candidate) {
  std::vector<float> map(reference.front().size(), 0.0f);
  for (std::size_t channel = 0; channel < reference.size(); ++channel) {
    for (std::size_t k = 0; k < map.size(); ++k) {
      const float apart = std::abs(candidate[channel][k] - reference[channel][k]);
      map[k] = std::isnan(apart) || std::isnan(map[k]) || std::isinf(apart)
                   ? std::numeric_limits<float>::quiet_NaN()
                   : std::max(map[k], apart);
    }
  }
  return map;
}

void measure_numbers(const Measuring& m, const Spans& reference, const Spans& candidate,
                     std::vector<float> difference) {
  PlaneErrors all;
  double sum = 0.0, squares = 0.0;
  for (std::size_t channel = 0; channel < reference.size(); ++channel) {
    const PlaneErrors errors = plane_errors(reference[channel], candidate[channel], m.pair.mask);
    const auto count = static_cast<double>(errors.compared);
    sum += errors.mean * count;
    squares += errors.root_mean_square * errors.root_mean_square * count;
    all.compared += errors.compared;
    all.differing += errors.differing;
    if (errors.largest > all.largest) {
      all.largest = errors.largest;
      all.worst = errors.worst;
    }
  }
  if (all.compared > 0) {
    all.mean = sum / static_cast<double>(all.compared);
    all.root_mean_square = std::sqrt(squares / static_cast<double>(all.compared));
  }
  m.add(kGroup, "largest", all.largest,
        all.differing > 0 ? std::optional(all.worst) : std::nullopt);
  m.add(kGroup, "mean", all.mean);
  m.add(kGroup, "rmse", all.root_mean_square);
  m.add(kGroup, "psnr", all.psnr_db());
  for (const double threshold : m.thresholds(kGroup)) {
    std::size_t over = 0;
    for (std::size_t k = 0; k < difference.size(); ++k)
      over += m.pair.judged(k) && double{difference[k]} > threshold;
    m.add({kGroup, "", "share_over", threshold, share_of(m.pair, over)});
  }
  m.keep_map({"colour difference", "the largest difference of a channel, numbers as stored", "",
              std::move(difference), m.bound(kGroup, "largest")});
}

// Numbers that FLIP and SSIM can work with.
std::vector<std::vector<float>> finite_copy(const Spans& planes) {
  std::vector<std::vector<float>> copies;
  for (const auto& plane : planes) {
    copies.emplace_back(plane.begin(), plane.end());
    for (float& value : copies.back()) value = std::isfinite(value) ? value : 0.0f;
  }
  return copies;
}

void measure_flip(const Measuring& m, const Spans& reference, const Spans& candidate) {
  if (!m.wants_any(kGroup, {"flip_mean", "flip_first_quartile", "flip_median",
                            "flip_third_quartile", "flip_largest"}))
    return;
  const auto a = finite_copy(reference), b = finite_copy(candidate);
  const int width = m.pair.width_px(), height = m.pair.height_px();
  const ColourPlanes there{width, height, a[0], a[1], a[2]}, here{width, height, b[0], b[1], b[2]};
  const double pixels_per_degree = m.profile.options.pixels_per_degree;
  const bool ldr = m.pair.reference.encoding == image::Encoding::Srgb;
  HdrFlipOptions hdr;
  hdr.pixels_per_degree = pixels_per_degree;
  FlipMap map =
      ldr ? flip_ldr(there, here, {pixels_per_degree}) : flip_hdr(there, here, hdr).largest;
  const FlipPooled pooled = pool_flip(map.error, m.pair.mask);
  std::optional<std::size_t> worst;
  for (std::size_t k = 0; k < map.error.size() && !worst && pooled.largest > 0.0; ++k) {
    if (m.pair.judged(k) && double{map.error[k]} == pooled.largest) worst = k;
  }
  m.add(kGroup, "flip_mean", pooled.mean);
  m.add(kGroup, "flip_first_quartile", pooled.first_quartile);
  m.add(kGroup, "flip_median", pooled.median);
  m.add(kGroup, "flip_third_quartile", pooled.third_quartile);
  m.add(kGroup, "flip_largest", pooled.largest, worst);
  m.keep_map({ldr ? "FLIP" : "HDR-FLIP", "how different it looks to somebody who flips", "",
              std::move(map.error), m.bound(kGroup, "flip_largest")});
}

void measure_structure(const Measuring& m) {
  if (!m.wants_any(kGroup, {"ssim", "ssim_least"})) return;
  const StructuralSimilarity ssim =
      structural_similarity(luma_of(m.pair.reference), luma_of(m.pair.candidate), m.pair.mask);
  m.add(kGroup, "ssim", ssim.mean);
  m.add(kGroup, "ssim_least", ssim.least,
        ssim.least < 1.0 ? std::optional(static_cast<std::size_t>(ssim.least_y) *
                                             static_cast<std::size_t>(m.pair.width_px()) +
                                         static_cast<std::size_t>(ssim.least_x))
                         : std::nullopt);
}

void measure_shift_match(const Measuring& m, const Spans& reference, const Spans& candidate) {
  if (!m.wants(kGroup, "unmatched_share")) return;
  const MeasureOptions& options = m.profile.options;
  const auto unmatched =
      unmatched_pixels(reference, candidate, m.pair.width_px(), m.pair.height_px(),
                       {options.shift_radius_px, options.shift_tolerance});
  std::size_t count = 0;
  for (std::size_t k = 0; k < unmatched.size(); ++k) count += m.pair.judged(k) && unmatched[k] != 0;
  m.add(kGroup, "unmatched_share", share_of(m.pair, count));
}

void measure_local(const Measuring& m) {
  if (!m.wants_any(kGroup, {"unexplained_share", "isolated_pixels", "isolated_largest"})) return;
  const auto a = display_colour(m.pair.reference), b = display_colour(m.pair.candidate);
  const LocalDifference local = local_difference(
      Spans(a.begin(), a.end()), Spans(b.begin(), b.end()), m.pair.width_px(), m.pair.height_px());
  const auto above = static_cast<float>(m.profile.options.unexplained_above);
  const auto alone = static_cast<float>(m.profile.options.isolated_above);
  std::size_t unexplained = 0, isolated = 0, worst = 0;
  float largest = 0.0f;
  for (std::size_t k = 0; k < m.pair.size(); ++k) {
    if (!m.pair.judged(k)) continue;
    unexplained +=
        local.unexplained[k] > above && local.unexplained[k] > kContrastShare * local.contrast[k];
    isolated += local.isolated[k] > alone;
    if (local.isolated[k] > largest) {
      largest = local.isolated[k];
      worst = k;
    }
  }
  const auto where = largest > 0.0f ? std::optional(worst) : std::nullopt;
  m.add(kGroup, "unexplained_share", share_of(m.pair, unexplained));
  m.add(kGroup, "isolated_pixels", static_cast<double>(isolated), where);
  m.add(kGroup, "isolated_largest", double{largest}, where);
  m.keep_map({"isolated", "by how much a pixel stands out of all around it in the other picture",
              "", local.isolated, m.bound(kGroup, "isolated_largest")});
}

}  // namespace

void measure_colour(const Measuring& measuring) {
  const auto reference = colour_planes(measuring.pair.reference);
  const auto candidate = colour_planes(measuring.pair.candidate);
  if (reference.empty() || candidate.empty()) return;
  const Spans a = spans_of(reference), b = spans_of(candidate);
  measure_numbers(measuring, a, b, difference_map(a, b));
  measure_structure(measuring);
  measure_flip(measuring, a, b);
  measure_shift_match(measuring, a, b);
  measure_local(measuring);
}

}  // namespace plumb::compare
