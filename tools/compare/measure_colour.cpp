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
  parallel_for(static_cast<std::int64_t>(map.size()), 65536, [&](std::int64_t at) {
    const auto k = static_cast<std::size_t>(at);
    float most = 0.0f;
    bool finite = true;
    for (std::size_t channel = 0; channel < reference.size(); ++channel) {
      const float apart = std::abs(candidate[channel][k] - reference[channel][k]);
      finite = finite && std::isfinite(apart);
      most = std::max(most, apart);
    }
    map[k] = finite ? most : std::numeric_limits<float>::quiet_NaN();
  });
  return map;
}

void measure_numbers(const Measuring& m, const std::vector<const image::Plane*>& channels,
                     std::vector<float> difference) {
  PlaneErrors all;
  double sum = 0.0, squares = 0.0;
  for (const image::Plane* channel : channels) {
    const PlaneErrors& errors = m.errors_of(channel->name);
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
  if (all.compared > 0) {  // else nothing is known of them, least of all that they are equal
    m.add(kGroup, "largest", all.largest,
          all.differing > 0 ? std::optional(all.worst) : std::nullopt);
    m.add(kGroup, "mean", all.mean);
    m.add(kGroup, "rmse", all.root_mean_square);
    m.add(kGroup, "psnr", all.psnr_db());
  }
  for (const double threshold : m.thresholds(kGroup)) {
    const std::size_t over =
        count_judged(m.pair, [&](std::size_t k) { return double{difference[k]} > threshold; });
    m.add({kGroup, "", "share_over", threshold, share_of(m.pair, over)});
  }
  m.keep_map({"colour difference", "the largest difference of a channel, numbers as stored", "",
              std::move(difference), m.bound(kGroup, "largest")});
}

// Planes with zeros where numbers are not finite, which FLIP refuses; whole numbers' are theirs.
class FinitePlanes {
 public:
  FinitePlanes(const Spans& planes, const image::PlaneImage& of) : planes_(planes) {
    if (of.bits > 0) return;
    copies_.reserve(planes.size());
    for (auto& plane : planes_) {
      copies_.emplace_back(plane.begin(), plane.end());
      for (float& value : copies_.back()) value = std::isfinite(value) ? value : 0.0f;
      plane = copies_.back();
    }
  }
  FinitePlanes(const FinitePlanes&) = delete;
  FinitePlanes& operator=(const FinitePlanes&) = delete;

  ColourPlanes colours(int width, int height) const {
    return {width, height, planes_[0], planes_[1], planes_[2]};
  }

 private:
  Spans planes_;
  std::vector<std::vector<float>> copies_;
};

void measure_flip(const Measuring& m, const Spans& reference, const Spans& candidate) {
  if (!m.wants_any(kGroup, {"flip_mean", "flip_first_quartile", "flip_median",
                            "flip_third_quartile", "flip_largest"}))
    return;
  const FinitePlanes a(reference, m.pair.reference), b(candidate, m.pair.candidate);
  const int width = m.pair.width_px(), height = m.pair.height_px();
  const ColourPlanes there = a.colours(width, height), here = b.colours(width, height);
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
  const std::size_t count = count_judged(m.pair, [&](std::size_t k) { return unmatched[k] != 0; });
  m.add(kGroup, "unmatched_share", share_of(m.pair, count));
}

void measure_local(const Measuring& m) {
  if (!m.wants_any(kGroup, {"unexplained_share", "isolated_pixels", "isolated_largest"})) return;
  const auto a = display_colour(m.pair.reference), b = display_colour(m.pair.candidate);
  LocalDifference local = local_difference(Spans(a.begin(), a.end()), Spans(b.begin(), b.end()),
                                           m.pair.width_px(), m.pair.height_px());
  const auto above = static_cast<float>(m.profile.options.unexplained_above);
  const auto alone = static_cast<float>(m.profile.options.isolated_above);
  // What is explained is no more to be seen.
  parallel_for(static_cast<std::int64_t>(m.pair.size()), 65536, [&](std::int64_t at) {
    const auto k = static_cast<std::size_t>(at);
    float& left = local.unexplained[k];
    if (!(left > above && left > kContrastShare * local.contrast[k])) left = 0.0f;
  });
  const std::size_t unexplained =
      count_judged(m.pair, [&](std::size_t k) { return local.unexplained[k] > 0.0f; });
  const std::size_t isolated =
      count_judged(m.pair, [&](std::size_t k) { return local.isolated[k] > alone; });
  std::size_t worst = 0;
  float largest = 0.0f;
  for (std::size_t k = 0; k < m.pair.size(); ++k) {
    if (local.isolated[k] > largest && m.pair.judged(k)) {
      largest = local.isolated[k];
      worst = k;
    }
  }
  const auto where = largest > 0.0f ? std::optional(worst) : std::nullopt;
  m.add(kGroup, "unexplained_share", share_of(m.pair, unexplained));
  m.add(kGroup, "isolated_pixels", static_cast<double>(isolated), where);
  m.add(kGroup, "isolated_largest", double{largest}, where);
  m.keep_map({"isolated", "by how much a pixel stands out of all around it in the other picture",
              "", std::move(local.isolated), m.bound(kGroup, "isolated_largest")});
  m.keep_map({"unexplained",
              "by how much more a pixel differs than a shift by a quarter of a pixel explains, and "
              "the contrast around",
              "", std::move(local.unexplained)});
}

}  // namespace

void measure_colour(const Measuring& measuring) {
  const auto reference = colour_planes(measuring.pair.reference);
  const auto candidate = colour_planes(measuring.pair.candidate);
  if (reference.empty() || candidate.empty()) return;
  const Spans a = spans_of(reference), b = spans_of(candidate);
  measure_numbers(measuring, reference, difference_map(a, b));
  measure_structure(measuring);
  measure_flip(measuring, a, b);
  measure_shift_match(measuring, a, b);
  measure_local(measuring);
}

}  // namespace plumb::compare
