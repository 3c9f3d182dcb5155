// Each channel by itself, coverage, and numbers that are none.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/measuring.h"
#include "compare/others_rules.h"
#include "compare/plane_errors.h"
#include "compare/planted_defects.h"
#include "core/check.h"

namespace plumb::compare {
namespace {

void add_plain(const Measuring& m, const std::string& group, const std::string& channel,
               const PlaneErrors& errors, const image::Plane& reference,
               const image::Plane& candidate) {
  const auto add = [&](const char* metric, std::optional<double> value) {
    if (!m.wants(group, metric)) return;
    Measurement measurement{group, channel, metric, {}, value};
    if (errors.differing > 0 && std::string(metric) == "largest") {
      measurement.x = static_cast<int>(errors.worst % static_cast<std::size_t>(m.pair.width_px()));
      measurement.y = static_cast<int>(errors.worst / static_cast<std::size_t>(m.pair.width_px()));
    }
    m.add(std::move(measurement));
  };
  if (errors.compared > 0) {
    add("largest", errors.largest);
    add("mean", errors.mean);
    add("rmse", errors.root_mean_square);
    add("psnr", errors.psnr_db());
  }
  for (const double threshold : m.thresholds(group, channel)) {
    const std::size_t over = count_judged(m.pair, [&](std::size_t k) {
      return std::abs(double{candidate.values[k]} - double{reference.values[k]}) > threshold;
    });
    m.add({group, channel, "share_over", threshold, share_of(m.pair, over)});
  }
}

void count_numbers(const Measuring& m, const image::Plane& reference, const image::Plane& candidate,
                   const PlaneErrors& errors) {
  NumberCount& numbers = m.result.numbers;
  if (numbers.unlike == 0 && errors.unlike > 0) {
    const std::size_t k = errors.first_unlike;
    const auto width = static_cast<std::size_t>(m.pair.width_px());
    numbers.first = fmt::format("channel {} at ({}, {}): {}, the reference has {}", reference.name,
                                k % width, k / width, candidate.values[k], reference.values[k]);
  }
  numbers.alike += errors.alike;
  numbers.unlike += errors.unlike;
}

// Depth of sky is infinite; where one picture has sky and the other ground, coverage says so.
bool is_about_sky(const image::Plane& plane) { return plane.name == "Z"; }

PlaneErrors without_sky(const Measuring& m, const image::Plane& reference,
                        const image::Plane& candidate) {
  std::vector<std::uint8_t> mask(m.pair.size());
  const float sky = std::numeric_limits<float>::infinity();
  for (std::size_t k = 0; k < mask.size(); ++k) {
    const bool one_is_sky = (reference.values[k] == sky) != (candidate.values[k] == sky) &&
                            !std::isnan(reference.values[k]) && !std::isnan(candidate.values[k]);
    mask[k] = m.pair.judged(k) && !one_is_sky ? 1 : 0;
  }
  return plane_errors(reference.values, candidate.values, mask);
}

}  // namespace

void measure_coverage(const Measuring& m) {
  if (!m.wants_any("coverage", {"holes", "overshoot"})) return;
  const auto rule = sky_rule(m.pair.reference, m.pair.candidate);
  if (!rule) return;
  m.result.sky = rule;
  if (rule->kind == SkyRule::Kind::Number)
    m.result.notes.push_back(fmt::format("coverage: Z = {} is taken for sky", rule->number));
  const auto reference = shown_terrain(m.pair.reference, *rule),
             candidate = shown_terrain(m.pair.candidate, *rule);
  CoverageErrors errors = check_coverage(reference, candidate, m.pair.width_px(),
                                         m.pair.height_px(), m.profile.options.band_px);
  std::vector<float> map(m.pair.size(), 0.0f);
  std::optional<std::size_t> hole, overshoot;
  for (const std::size_t k : errors.wrong) {
    map[k] = reference[k] != 0 ? 1.0f : 2.0f;
    std::optional<std::size_t>& first = reference[k] != 0 ? hole : overshoot;
    if (!first) first = k;
  }
  m.add("coverage", "holes", static_cast<double>(errors.holes), hole);
  m.add("coverage", "overshoot", static_cast<double>(errors.overshoot), overshoot);
  m.keep_map({"coverage", "1: a hole; 2: terrain where sky must be", "", std::move(map), 0.0});
  m.result.coverage = std::move(errors);
}

void measure_channels(const Measuring& m) {
  for (const image::Plane& reference : m.pair.reference.planes) {
    const image::Plane& candidate = *m.pair.candidate.find(reference.name);
    const PlaneErrors errors = is_about_sky(reference) ? without_sky(m, reference, candidate)
                                                       : m.errors_of(reference.name);
    count_numbers(m, reference, candidate, errors);
    add_plain(m, "channel", reference.name, errors, reference, candidate);
    if (reference.name == "A") add_plain(m, "alpha", "", errors, reference, candidate);
  }
}

void measure_others(const Measuring& m) {
  std::vector<OtherRule> wanted;
  for (const OtherRule& rule : other_rules()) {
    const bool limited = std::any_of(
        m.profile.limits.begin(), m.profile.limits.end(),
        [&](const Limit& limit) { return limit.group == "others" && limit.metric == rule.name; });
    if (limited) wanted.push_back(rule);
  }
  if (wanted.empty() || colour_planes(m.pair.reference).empty()) return;
  constexpr int kLeastSide_px = 7;
  if (std::min(m.pair.width_px(), m.pair.height_px()) < kLeastSide_px)
    input_error("'{}': the rule {} needs pictures of at least {} x {} pixels",
                m.pair.candidate_name, wanted.front().name, kLeastSide_px, kLeastSide_px);
  for (const OtherRule& rule : wanted) {
    if (rule.name == std::string("idiff") && m.pair.reference.find("A") != nullptr)
      input_error(
          "'{}': the rule idiff compares alpha as well, which is not done here: expected "
          "pictures without it",
          m.pair.candidate_name);
  }
  const std::vector<OtherVerdict> verdicts =
      judge_by(wanted, bytes_of(m.pair.reference), bytes_of(m.pair.candidate));
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const bool finite = std::isfinite(verdicts[k].value);
    m.add({"others",
           "",
           wanted[k].name,
           {},
           finite ? std::optional(verdicts[k].value) : std::nullopt});
  }
}

}  // namespace plumb::compare
