#include "compare/others_rules.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>

#include "compare/flip.h"
#include "compare/flip_pool.h"
#include "compare/others_bilinear.h"
#include "compare/others_fuzzy.h"
#include "compare/others_pixelmatch.h"
#include "compare/others_similarity.h"
#include "core/check.h"
#include "core/reproducible_math.h"

namespace plumb::compare {
namespace {

using image::Rgb8Image;

// Of each pixel the largest difference of a channel, counted; and all squares.
struct Differences {
  std::array<std::int64_t, 256> pixels{};
  std::int64_t squares = 0;
};

Differences differences(const Rgb8Image& reference, const Rgb8Image& candidate) {
  Differences found;
  for (std::size_t k = 0; k < reference.rgb.size(); k += 3) {
    int largest = 0;
    for (std::size_t c = k; c < k + 3; ++c) {
      const int difference = std::abs(reference.rgb[c] - candidate.rgb[c]);
      largest = std::max(largest, difference);
      found.squares += difference * difference;
    }
    ++found.pixels[static_cast<std::size_t>(largest)];
  }
  return found;
}

// Of a ratio >= 1; exact for powers of ten, at one of which a limit stands.
double decibels(double ratio) {
  double tens = 0.0;
  for (; ratio >= 10.0; ratio /= 10.0) tens += 10.0;
  constexpr double kDecibelsOfTwo = 3.010299956639812;  // 10 log10 2
  return tens + kDecibelsOfTwo * reproducible_log2(ratio);
}

double mean_flip(const Rgb8Image& reference, const Rgb8Image& candidate) {
  std::vector<float> planes[6];
  for (int p = 0; p < 6; ++p) {
    const Rgb8Image& picture = p < 3 ? reference : candidate;
    planes[p].reserve(picture.rgb.size() / 3);
    for (std::size_t k = static_cast<std::size_t>(p % 3); k < picture.rgb.size(); k += 3)
      planes[p].push_back(static_cast<float>(picture.rgb[k]) / 255.0f);
  }
  const int width = reference.width_px, height = reference.height_px;
  const FlipMap map = flip_ldr({width, height, planes[0], planes[1], planes[2]},
                               {width, height, planes[3], planes[4], planes[5]});
  return pool_flip(map.error).mean;
}

// What several rules measure of one pair, each once.
class Measured {
 public:
  Measured(const Rgb8Image& reference, const Rgb8Image& candidate)
      : reference_(reference), candidate_(candidate) {}

  double value(const OtherRule& rule) {
    switch (rule.measure) {
      case OtherMeasure::FuzzySum:
        if (fuzzy_ < 0.0) fuzzy_ = fuzzy_sum(reference_, candidate_);
        return fuzzy_;
      case OtherMeasure::BilinearPixels:
        return static_cast<double>(bilinear_mismatches(reference_, candidate_));
      case OtherMeasure::FlipMean:
        return mean_flip(reference_, candidate_);
      case OtherMeasure::ShareOver:
        return 100.0 * pixels_over(rule.smallest_code) / pixels();
      case OtherMeasure::PixelsOver:
        return pixels_over(rule.smallest_code);
      case OtherMeasure::BoxSimilarity:
        return box_similarity(reference_, candidate_);
      case OtherMeasure::SignalToNoise:
        return signal_to_noise_db();
      case OtherMeasure::PixelmatchRemaining:
        return static_cast<double>(pixelmatch().remaining);
      case OtherMeasure::PixelmatchAll:
        return static_cast<double>(pixelmatch().all);
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

 private:
  double pixels() const { return static_cast<double>(reference_.rgb.size() / 3); }

  const Differences& all_differences() {
    if (!differences_) differences_ = differences(reference_, candidate_);
    return *differences_;
  }
  double pixels_over(int smallest_code) {
    const auto& counts = all_differences().pixels;
    std::int64_t sum = 0;
    for (int code = smallest_code; code < 256; ++code)
      sum += counts[static_cast<std::size_t>(code)];
    return static_cast<double>(sum);
  }
  double signal_to_noise_db() {
    const auto squares = static_cast<double>(all_differences().squares);
    if (squares == 0.0) return std::numeric_limits<double>::infinity();
    return decibels(255.0 * 255.0 * (3.0 * pixels()) / squares);
  }
  const PixelmatchCounts& pixelmatch() {
    if (!pixelmatch_) pixelmatch_ = pixelmatch_counts(reference_, candidate_);
    return *pixelmatch_;
  }

  const Rgb8Image &reference_, &candidate_;
  double fuzzy_ = -1.0;  // not yet measured
  std::optional<Differences> differences_;
  std::optional<PixelmatchCounts> pixelmatch_;
};

}  // namespace

const std::vector<OtherRule>& other_rules() {
  static const std::vector<OtherRule> rules{
      {"conformance-fuzzy-0.05", "VK-GL-CTS (dEQP)",
       "sum of the fourth powers of colour distances that nothing within a pixel explains", 0.05,
       "", false, OtherMeasure::FuzzySum},
      {"conformance-fuzzy-0.02", "VK-GL-CTS (dEQP)", "the same with its stricter limit", 0.02, "",
       false, OtherMeasure::FuzzySum},
      {"conformance-bilinear", "VK-GL-CTS (dEQP)",
       "pixels without a like one (7/255) within a pixel, in either direction", 0.0, "pixels",
       false, OtherMeasure::BilinearPixels},
      {"flip-mean", "FLIP", "mean of the map, the limit of the authors' program", 0.05, "", false,
       OtherMeasure::FlipMean},
      // 4/255 = 0.01569 is below the limit of 0.016, 5/255 = 0.01961 above.
      {"blender", "Blender", "share of pixels that differ by more than 0.016", 1.0, "%", false,
       OtherMeasure::ShareOver, 5},
      // 5/255 = 0.01961 is above the limit of 0.0196 already.
      {"filament", "Filament", "share of pixels that differ by more than 0.0196", 0.1, "%", false,
       OtherMeasure::ShareOver, 5},
      {"anari-ssim", "ANARI-SDK (CTS)", "SSIM of windows of 7 x 7 pixels, mean of the channels",
       0.7, "", true, OtherMeasure::BoxSimilarity},
      {"anari-psnr", "ANARI-SDK (CTS)", "peak signal-to-noise ratio", 20.0, "dB", true,
       OtherMeasure::SignalToNoise},
      {"pixelmatch", "pixelmatch",
       "pixels of another colour (threshold 0.1) that do not look like a smoothed edge", 0.0,
       "pixels", false, OtherMeasure::PixelmatchRemaining},
      {"pixelmatch-include-aa", "pixelmatch", "pixels of another colour (threshold 0.1)", 0.0,
       "pixels", false, OtherMeasure::PixelmatchAll},
      // A millionth is less than any difference of 8-bit numbers.
      {"idiff", "OpenImageIO", "pixels that differ by more than 0.000001", 0.0, "pixels", false,
       OtherMeasure::PixelsOver, 1},
  };
  return rules;
}

const OtherRule* find_other_rule(const char* name) {
  for (const OtherRule& rule : other_rules()) {
    if (std::strcmp(rule.name, name) == 0) return &rule;
  }
  return nullptr;
}

OtherVerdict judge_by(const OtherRule& rule, const Rgb8Image& reference,
                      const Rgb8Image& candidate) {
  return judge_by(std::span(&rule, 1), reference, candidate).front();
}

std::vector<OtherVerdict> judge_by(std::span<const OtherRule> rules, const Rgb8Image& reference,
                                   const Rgb8Image& candidate) {
  require_judgeable(reference, candidate);
  Measured measured(reference, candidate);
  std::vector<OtherVerdict> verdicts;
  for (const OtherRule& rule : rules) {
    const double value = measured.value(rule);
    verdicts.push_back({value, rule.more_is_better ? value > rule.limit : value <= rule.limit});
  }
  return verdicts;
}

void require_judgeable(const Rgb8Image& reference, const Rgb8Image& candidate) {
  const int width = reference.width_px, height = reference.height_px;
  require(width == candidate.width_px && height == candidate.height_px && width >= 7 && height >= 7,
          "pictures must be of one size, at least 7 x 7, got {} x {} and {} x {}", width, height,
          candidate.width_px, candidate.height_px);
  const std::size_t bytes = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  require(reference.rgb.size() == bytes && candidate.rgb.size() == bytes,
          "pictures of {} x {} must have {} bytes, got {} and {}", width, height, bytes,
          reference.rgb.size(), candidate.rgb.size());
}

}  // namespace plumb::compare
