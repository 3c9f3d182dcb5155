#include "compare/measurement.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/others_rules.h"
#include "core/check.h"

namespace plumb::compare {
namespace {

constexpr Metric kColour[] = {
    {"largest", "", false, false, "largest difference of a channel, numbers as stored"},
    {"mean", "", false, false, "mean absolute difference, all channels"},
    {"rmse", "", false, false, "root mean square difference, all channels"},
    {"psnr", "dB", true, false, "peak signal-to-noise ratio, peak 1; none where nothing differs"},
    {"ssim", "", true, false, "structural similarity of the luma, mean of all windows"},
    {"ssim_least", "", true, false, "structural similarity of the worst window"},
    {"share_over", "%", false, true, "pixels with a channel that differs by more than a threshold"},
    {"flip_mean", "", false, false, "FLIP, mean"},
    {"flip_first_quartile", "", false, false, "FLIP, first quartile, weighted by the error"},
    {"flip_median", "", false, false, "FLIP, median, weighted by the error"},
    {"flip_third_quartile", "", false, false, "FLIP, third quartile, weighted by the error"},
    {"flip_largest", "", false, false, "FLIP, largest"},
    {"unmatched_share", "%", false, false, "pixels without a like one nearby in the other picture"},
    {"unexplained_share", "%", false, false,
     "pixels that no shift by a quarter of a pixel explains"},
    {"isolated_pixels", "px", false, false,
     "pixels that stand out of the other picture's 3 x 3 around, and of its contrast there"},
    {"isolated_largest", "", false, false, "by how much the worst of these stands out"}};
constexpr Metric kPlain[] = {
    {"largest", "", false, false, "largest difference"},
    {"mean", "", false, false, "mean absolute difference"},
    {"rmse", "", false, false, "root mean square difference"},
    {"psnr", "dB", true, false, "peak signal-to-noise ratio, peak 1; none where nothing differs"},
    {"share_over", "%", false, true, "pixels that differ by more than a threshold"}};
constexpr Metric kDepth[] = {
    {"relative_largest", "", false, false, "largest difference, divided by the reference's depth"},
    {"relative_mean", "", false, false, "mean of that"},
    {"relative_p99", "", false, false, "99th percentile of that"},
    {"unexplained_share", "%", false, false,
     "pixels whose depth no shift by a quarter of a pixel explains"},
    {"isolated_pixels", "px", false, false,
     "pixels nearer or farther than all 3 x 3 around in the other picture, and than its relief"}};
constexpr Metric kPosition[] = {
    {"largest_px", "px", false, false, "largest distance of the points seen, at their depth"},
    {"mean_px", "px", false, false, "mean of that"},
    {"p99_px", "px", false, false, "99th percentile of that"}};
constexpr Metric kNormal[] = {
    {"largest_deg", "deg", false, false, "largest angle between the normals"},
    {"mean_deg", "deg", false, false, "mean of that"},
    {"p99_deg", "deg", false, false, "99th percentile of that"},
    {"unmatched_share", "%", false, false,
     "pixels whose normal is none of the 3 x 3 around in the other picture, within two degrees"}};
constexpr Metric kNames[] = {{"differing_share", "%", false, false, "pixels that show another one"},
                             {"confused_pairs", "", false, false,
                              "pairs (this one, that one) that take each other's place"}};
constexpr Metric kCoverage[] = {
    {"holes", "px", false, false, "sky where the reference leaves no choice but terrain"},
    {"overshoot", "px", false, false, "terrain where it leaves no choice but sky"}};

std::vector<Metric> metrics_of_others() {
  std::vector<Metric> metrics;
  for (const OtherRule& rule : other_rules())
    metrics.push_back({rule.name, rule.unit, rule.more_is_better, false, rule.meaning});
  return metrics;
}

}  // namespace

const std::vector<std::string>& metric_groups() {
  static const std::vector<std::string> groups{"colour", "alpha", "depth",    "position", "normal",
                                               "id",     "lod",   "coverage", "channel",  "others"};
  return groups;
}

std::span<const Metric> metrics_of(const std::string& group) {
  if (group == "colour") return kColour;
  if (group == "alpha" || group == "channel") return kPlain;
  if (group == "depth") return kDepth;
  if (group == "position") return kPosition;
  if (group == "normal") return kNormal;
  if (group == "id" || group == "lod") return kNames;
  if (group == "coverage") return kCoverage;
  if (group == "others") {
    static const std::vector<Metric> others = metrics_of_others();
    return others;
  }
  return {};
}

const Metric* find_metric(const std::string& group, const std::string& name) {
  const std::span<const Metric> all = metrics_of(group);
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Metric& m) { return name == m.name; });
  return found == all.end() ? nullptr : &*found;
}

const Metric& Measurement::info() const {
  const Metric* found = find_metric(group, metric);
  require(found != nullptr, "there is no metric '{}' of '{}'", metric, group);
  return *found;
}

std::string Measurement::name() const {
  std::string text = group + "." + (channel.empty() ? "" : channel + ".") + metric;
  if (threshold) text += fmt::format("({:.6g})", *threshold);
  return text;
}

bool Limit::is_about(const Measurement& measurement) const {
  return group == measurement.group && (channel == "*" || channel == measurement.channel) &&
         metric == measurement.metric && threshold == measurement.threshold;
}

bool Limit::holds(const Measurement& measurement) const {
  if (!measurement.value) return true;  // equal pictures
  if (!measurement.info().more_is_better) return *measurement.value <= bound;
  const bool strict = group == "others";  // as those rules say it
  return strict ? *measurement.value > bound : *measurement.value >= bound;
}

}  // namespace plumb::compare
