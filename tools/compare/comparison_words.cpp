#include "compare/comparison_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::compare {
namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string failing_sentence(const Comparison& c) {
  const auto broken = std::count_if(c.judgements.begin(), c.judgements.end(),
                                    [](const Judgement& judgement) { return !judgement.holds; });
  std::vector<std::string> parts;
  if (broken > 0)
    parts.push_back(fmt::format("{} of {} limits broken", broken, c.judgements.size()));
  if (!c.systematic.empty())
    parts.push_back(
        counted(c.systematic.size(), "systematic difference", "systematic differences"));
  if (c.numbers.unlike > 0)
    parts.push_back(fmt::format("{} NaN or infinite in one picture alone", c.numbers.unlike));
  return fmt::format("{} is not what {} is, by the profile '{}'{}{}.", c.candidate_name,
                     c.reference_name, c.profile, parts.empty() ? "" : ": ",
                     fmt::join(parts, ", "));
}

}  // namespace

const char* verdict_label(CompareVerdict verdict) {
  switch (verdict) {
    case CompareVerdict::Equal:
      return "EQUAL";
    case CompareVerdict::Passes:
      return "PASSES";
    case CompareVerdict::Fails:
      return "FAILS";
    case CompareVerdict::None:
      return "NO VERDICT";
  }
  return "?";
}

std::string verdict_sentence(const Comparison& c) {
  const std::string where = c.mask && c.mask->masked > 0 ? " wherever the mask judges" : "";
  switch (c.verdict) {
    case CompareVerdict::Equal:
      return fmt::format("{} and {} are the same in every number of {}{}.", c.candidate_name,
                         c.reference_name, counted(c.channels.size(), "channel", "channels"),
                         where);
    case CompareVerdict::Passes:
      return fmt::format("{} differs from {} within {} of the profile '{}'{}.", c.candidate_name,
                         c.reference_name, counted(c.judgements.size(), "limit", "limits"),
                         c.profile, where);
    case CompareVerdict::Fails:
      return failing_sentence(c);
    case CompareVerdict::None:
      return fmt::format("The profile '{}' has no limit that can be judged on {}.", c.profile,
                         fmt::join(c.channels, " "));
  }
  return "";
}

ChannelTable channel_table(const Comparison& comparison) {
  ChannelTable table;
  const auto place = [](std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    const auto at = static_cast<std::size_t>(found - names.begin());
    if (at == names.size()) names.push_back(name);
    return at;
  };
  for (const Measurement& m : comparison.measurements) {
    if (m.group != "channel") continue;
    const std::string own = "channel." + m.channel + ".";
    const std::size_t column = place(table.metrics, m.name().substr(own.size()));
    const std::size_t row = place(table.channels, m.channel);
    table.values.resize(std::max(table.values.size(), row + 1));
    table.values[row].resize(std::max(table.values[row].size(), column + 1), "-");
    table.values[row][column] = value_text(m);
  }
  for (std::vector<std::string>& row : table.values) row.resize(table.metrics.size(), "-");
  return table;
}

const char* name_of(Systematic kind) {
  switch (kind) {
    case Systematic::Offset:
      return "offset";
    case Systematic::Gain:
      return "gain";
    case Systematic::LinearAsSrgb:
      return "linear-as-srgb";
    case Systematic::SrgbAsLinear:
      return "srgb-as-linear";
    case Systematic::Gamma:
      return "gamma";
    case Systematic::FlippedY:
      return "flipped-y";
    case Systematic::FlippedX:
      return "flipped-x";
    case Systematic::Shift:
      return "shift";
    case Systematic::FieldOfViewAxis:
      return "field-of-view-axis";
    case Systematic::DepthScale:
      return "depth-scale";
    case Systematic::WindowDepth:
      return "window-depth";
    case Systematic::DistanceAsDepth:
      return "distance-as-depth";
  }
  return "?";
}

std::string short_number(double value, const std::string& unit) {
  const std::string behind = unit.empty() ? "" : " " + unit;
  if (std::isnan(value)) return "nan" + behind;
  if (std::isinf(value)) return (value > 0 ? "inf" : "-inf") + behind;
  const bool whole = value == std::floor(value) && std::fabs(value) < 1e15;
  return (whole ? fmt::format("{:.0f}", value + 0.0) : fmt::format("{:.4g}", value)) + behind;
}

std::string value_text(const Measurement& measurement) {
  return measurement.value ? short_number(*measurement.value, measurement.info().unit) : "infinite";
}

std::string bound_text(const Limit& limit, const Metric& metric) {
  return (metric.more_is_better ? "at least " : "at most ") +
         short_number(limit.bound, metric.unit);
}

std::string pixel_text(int x, int y) { return x < 0 ? "-" : fmt::format("({}, {})", x, y); }

double use_of(const Judgement& judgement) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Measurement& m = judgement.measured;
  if (!m.value) return 0.0;
  const bool more = m.info().more_is_better;
  const double part = more ? judgement.limit.bound : *m.value;
  const double whole = more ? *m.value : judgement.limit.bound;
  const double share = part / whole;  // nan: 0 / 0 or inf / inf
  if (judgement.holds) return share > 0.0 ? std::min(share, 1.0) : 0.0;
  return share > 1.0 ? share : kInfinite;
}

std::string use_text(const Judgement& judgement) {
  const double use = use_of(judgement);
  if (!std::isfinite(use)) return "inf";
  return 100.0 * use >= 1000.0 && use < 1e6 ? fmt::format("{:.0f} %", 100.0 * use)
                                            : fmt::format("{:.3g} %", 100.0 * use);
}

const Judgement* tightest(const Comparison& comparison) {
  const std::vector<const Judgement*> all = by_use(comparison);
  return all.empty() ? nullptr : all.front();
}

std::vector<const Judgement*> by_use(const Comparison& comparison) {
  std::vector<const Judgement*> all;
  for (const Judgement& judgement : comparison.judgements) all.push_back(&judgement);
  std::stable_sort(all.begin(), all.end(), [](const Judgement* a, const Judgement* b) {
    return use_of(*a) > use_of(*b);  // above one where it is broken, and nowhere else
  });
  return all;
}

}  // namespace plumb::compare
