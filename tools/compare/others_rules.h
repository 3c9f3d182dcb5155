// The rules by which other projects call two rendered pictures alike, to show what they miss.
#pragma once

#include <span>
#include <vector>

#include "image/colour_image.h"

namespace plumb::compare {

/// What is measured of a pair for a rule.
enum class OtherMeasure {
  FuzzySum,             // fuzzy_sum()
  BilinearPixels,       // bilinear_mismatches()
  FlipMean,             // flip_ldr(), its mean
  ShareOver,            // pixels a channel of which differs by `smallest_code` or more, percent
  PixelsOver,           // their number
  BoxSimilarity,        // box_similarity()
  SignalToNoise,        // of all channels together, peak 255
  PixelmatchRemaining,  // pixelmatch_counts(), without smoothed edges
  PixelmatchAll,        // pixelmatch_counts(), all of them
};

/// A rule, its limit and who judges by it.
struct OtherRule {
  const char* name;     // "conformance-fuzzy-0.05"
  const char* whose;    // the project that published it
  const char* meaning;  // for people, one line
  double limit;
  const char* unit;     // "%", "dB", "pixels"; empty: none
  bool more_is_better;  // then a value must lie above the limit; else it may be equal to it
  OtherMeasure measure;
  int smallest_code = 0;  // of ShareOver and PixelsOver, in 1/255
};

/// All of them, the same on every call.
const std::vector<OtherRule>& other_rules();
/// Null if there is no rule of that name.
const OtherRule* find_other_rule(const char* name);

struct OtherVerdict {
  double value = 0.0;  // infinite: the signal-to-noise ratio of equal pictures
  bool passes = false;
};

/// Judges a candidate by one rule, or by several that share what they measure (one map of FLIP, one
/// sum for two limits); verdicts in the order of the rules.
///
///   (1) Equal pictures pass every rule.
///   (2) A value decides alone: it passes if it is at most the limit, or above it where more is
///       better.
///   (3) Same bits on any machine and number of threads.
/// Throws std::invalid_argument as require_judgeable does.
/// Sources, equations and departures: docs/algorithms/others-rules.md.
OtherVerdict judge_by(const OtherRule& rule, const image::Rgb8Image& reference,
                      const image::Rgb8Image& candidate);
std::vector<OtherVerdict> judge_by(std::span<const OtherRule> rules,
                                   const image::Rgb8Image& reference,
                                   const image::Rgb8Image& candidate);

/// Throws std::invalid_argument unless both pictures are of one size, at least 7 x 7 (a window of
/// the smallest rule that has windows), with three bytes a pixel.
void require_judgeable(const image::Rgb8Image& reference, const image::Rgb8Image& candidate);

}  // namespace plumb::compare
