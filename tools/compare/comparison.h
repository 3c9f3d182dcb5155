// All that is said of two pictures: what was measured, what is wrong, and the verdict.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/coverage_check.h"
#include "compare/diagnosis.h"
#include "compare/measurement.h"
#include "compare/picture_pair.h"
#include "compare/profile.h"

namespace plumb::compare {

/// A limit, and what was measured against it.
struct Judgement {
  Limit limit;
  Measurement measured;
  bool holds = true;
};

/// A number for each pixel, for a heat map; NaN: none there, or masked.
struct ErrorMap {
  std::string name;     // "colour difference", "FLIP", "depth"
  std::string meaning;  // one sentence
  std::string unit;
  std::vector<float> values;      // one entry a pixel
  std::optional<double> limit{};  // of the profile, where a limit speaks of single pixels
};

/// A pixel to look at, with both values.
struct WorstPixel {
  int x = 0, y = 0;
  std::string what;  // "colour", "depth", "hole", ...: the map that it is worst in
  double value = 0.0;
  std::string unit;
  std::string reference, candidate;  // the numbers there, all channels of the group
};

/// NaN and infinities of all channels.
struct NumberCount {
  std::int64_t alike = 0;   // the same in both
  std::int64_t unlike = 0;  // in one alone, or not the same
  std::string first;        // "channel Z at (3, 5): nan, reference 12.5"; empty if none is unlike
};

struct MaskReport {
  std::int64_t masked = 0;        // pixels
  std::int64_t would_differ = 0;  // of these, where any channel differs
  /// Of these, pixels that alone break a limit of a single pixel (largest differences, holes):
  /// they pass because of the mask only.
  std::int64_t would_fail = 0;
};

enum class CompareVerdict {
  Equal,   // every number
  Passes,  // differs within the profile
  Fails,
  None,  // the profile has no limit that can be judged on these channels
};
const char* name_of(CompareVerdict verdict);  // "equal", "passes", "fails", "none"

struct Comparison {
  std::string reference_name, candidate_name;
  int width_px = 0, height_px = 0;
  std::string encoding;               // "sRGB, 8 bits", "linear, floats"
  std::vector<std::string> channels;  // in the file's order
  std::string profile;                // its name
  std::vector<Measurement> measurements;
  std::vector<Judgement> judgements;
  std::vector<std::string> not_judged;  // limits of channels that are not there, by name
  std::vector<Diagnosis> systematic;
  std::optional<CoverageErrors> coverage;
  std::optional<SkyRule> sky;  // by which coverage was judged
  NumberCount numbers;
  std::optional<MaskReport> mask;
  std::vector<ErrorMap> maps;
  std::vector<WorstPixel> worst;     // at most `most_listed`, what breaks a limit first
  std::vector<std::string> notes;    // what differs in the headers: cameras, terrains
  std::vector<std::string> reasons;  // why it fails, one sentence each, most telling first

  CompareVerdict verdict = CompareVerdict::Equal;
  bool passes() const {
    return verdict == CompareVerdict::Equal || verdict == CompareVerdict::Passes;
  }
};

struct CompareOptions {
  int most_listed = 20;    // worst pixels
  bool with_maps = true;   // keep them
  bool everything = true;  // measure all metrics, not those alone that the profile limits
};

/// Throws InputError as require_comparable does. The same bits on any machine and number of
/// threads.
Comparison compare_pictures(const PicturePair& pair, const Profile& profile,
                            const CompareOptions& options = {});

}  // namespace plumb::compare
