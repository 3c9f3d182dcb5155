#include "compare/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace plumb::compare {

double rounded_outwards(double value, bool more_is_better) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  double unit = 1.0;  // of the second digit
  while (std::abs(value) / unit >= 100.0) unit *= 10.0;
  while (std::abs(value) / unit < 10.0) unit /= 10.0;
  const double steps = value / unit;
  return (more_is_better ? std::floor(steps) : std::ceil(steps)) * unit;
}

Calibrator::Calibrator(Profile base) : base_(std::move(base)) {
  for (const Limit& limit : base_.limits) {
    CalibratedLimit calibrated{limit, 0.0, "", limit.bound};
    const Metric* metric = find_metric(limit.group, limit.metric);
    if (metric != nullptr && metric->more_is_better)
      calibrated.reached = std::numeric_limits<double>::infinity();
    found_.limits.push_back(std::move(calibrated));
  }
}

void Calibrator::add(const PicturePair& pair) {
  const Comparison comparison =
      compare_pictures(pair, base_, {.most_listed = 0, .with_maps = false, .everything = false});
  ++found_.pairs;
  for (const Diagnosis& each : comparison.systematic)
    found_.hopeless.push_back(pair.candidate_name + ": " + each.text);
  if (comparison.numbers.unlike > 0)
    found_.hopeless.push_back(pair.candidate_name + ": " + comparison.numbers.first);
  for (const Judgement& each : comparison.judgements) {
    if (!each.measured.value) continue;  // equal
    for (CalibratedLimit& limit : found_.limits) {
      if (!(limit.limit == each.limit)) continue;
      limit.measured = true;
      const bool worse = each.measured.info().more_is_better ? *each.measured.value < limit.reached
                                                             : *each.measured.value > limit.reached;
      if (!worse) continue;
      limit.reached = *each.measured.value;
      limit.worst_pair = pair.candidate_name;
    }
  }
}

Calibration Calibrator::finish() const {
  if (found_.pairs == 0) input_error("there is no pair to calibrate by");
  Calibration result = found_;
  result.proposed = base_;
  result.proposed.name = "calibrated";
  result.proposed.meaning = "The tightest limits that passed every pair they were calibrated by.";
  result.proposed.limits.clear();
  for (CalibratedLimit& each : result.limits) {
    const Metric* metric = find_metric(each.limit.group, each.limit.metric);
    const bool more = metric != nullptr && metric->more_is_better;
    // What no pair had says nothing: the limit stays.
    if (each.measured && std::isfinite(each.reached))
      each.limit.bound = rounded_outwards(each.reached, more);
    result.proposed.limits.push_back(each.limit);
  }
  return result;
}

}  // namespace plumb::compare
