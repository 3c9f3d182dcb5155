// What the measurements of a comparison share: the pictures, how to measure, and where it goes.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/plane_errors.h"
#include "core/parallel.h"

namespace plumb::compare {

struct Measuring {
  const PicturePair& pair;
  const Profile& profile;
  const CompareOptions& options;
  Comparison& result;

  /// Whether a metric is wanted: all are, or a limit speaks of it.
  bool wants(const std::string& group, const char* metric) const;
  bool wants_any(const std::string& group, std::initializer_list<const char*> metrics) const;
  /// Thresholds of `share_over` that limits name for the group (and channel), and zero where all is
  /// wanted.
  std::vector<double> thresholds(const std::string& group, const std::string& channel = "") const;
  void add(const std::string& group, const char* metric, std::optional<double> value,
           std::optional<std::size_t> worst_pixel = {}) const;
  void add(Measurement measurement) const;
  /// Keeps a map (where maps are kept), with NaN where the mask is, and its worst pixels.
  void keep_map(ErrorMap map) const;
  /// How the candidate's channel of a name differs from the reference's; worked out once.
  const PlaneErrors& errors_of(const std::string& channel) const;
  /// The bound that the profile sets for a metric, if any.
  std::optional<double> bound(const std::string& group, const char* metric) const;

  mutable std::map<std::string, PlaneErrors> errors = {};  // that errors_of worked out
};

/// Of finite numbers; NaN are left out.
struct Spread {
  double largest = 0.0, mean = 0.0, p99 = 0.0;  // p99: nearest rank
  std::size_t count = 0, worst = 0;
};
Spread spread_of(std::span<const float> values);

/// How many judged pixels k are wanted(k).
template <class Wanted>
std::size_t count_judged(const PicturePair& pair, const Wanted& wanted) {
  return parallel_ordered_reduce(
      static_cast<std::int64_t>(pair.size()), 65536, std::size_t{0},
      [&](std::int64_t begin, std::int64_t end, std::size_t count) {
        for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
          count += pair.judged(k) && wanted(k) ? 1u : 0u;
        return count;
      },
      [](std::size_t a, std::size_t b) { return a + b; });
}

/// Per cent of the pixels that are judged.
double share_of(const PicturePair& pair, std::size_t pixels);

void measure_colour(const Measuring& measuring);
void measure_depth(const Measuring& measuring);
void measure_positions(const Measuring& measuring);
void measure_normals(const Measuring& measuring);
void measure_names(const Measuring& measuring);  // id and lod
void measure_coverage(const Measuring& measuring);
void measure_channels(const Measuring& measuring);  // each by itself, alpha, and NaN

void measure_others(const Measuring& measuring);  // only what limits speak of

}  // namespace plumb::compare
