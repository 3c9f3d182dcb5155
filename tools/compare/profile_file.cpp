// Profiles in TOML files.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "audit/toml_document.h"
#include "compare/profile.h"
#include "core/check.h"

namespace plumb::compare {
namespace {

namespace fs = std::filesystem;

double at_least_zero(const audit::TomlValue& value) {
  const double number = audit::number_in(value);
  if (!std::isfinite(number) || number < 0.0)
    input_error("{}: expected a number >= 0, got {}", value.where, number);
  return number;
}

double number_between(const audit::TomlValue& value, double least, double most) {
  const double number = audit::number_in(value);
  if (!(number >= least && number <= most))
    input_error("{}: expected a number from {} to {}, got {}", value.where, least, most, number);
  return number;
}

void read_options(const audit::TomlValue& table, MeasureOptions& options) {
  for (const auto& [key, value] : audit::table_in(table)) {
    if (key == "pixels_per_degree") {
      options.pixels_per_degree = number_between(value, 1.0, 1000.0);
    } else if (key == "shift_radius_px") {
      options.shift_radius_px = audit::whole_number_in(value, 0, 8);
    } else if (key == "shift_tolerance") {
      options.shift_tolerance = at_least_zero(value);
    } else if (key == "band_px") {
      options.band_px = audit::whole_number_in(value, 0, 64);
    } else if (key == "unexplained_above") {
      options.unexplained_above = at_least_zero(value);
    } else if (key == "isolated_above") {
      options.isolated_above = at_least_zero(value);
    } else if (key == "depth_above") {
      options.depth_above = at_least_zero(value);
    } else {
      audit::unknown_key(value, "[options]",
                         {"pixels_per_degree", "shift_radius_px", "shift_tolerance", "band_px",
                          "unexplained_above", "isolated_above", "depth_above"});
    }
  }
}

bool is_about_same(const Limit& a, const Limit& b) {
  return a.group == b.group && a.channel == b.channel && a.metric == b.metric &&
         a.threshold == b.threshold;
}

// Takes the place of an inherited limit; none where there is no bound.
void set_limit(Profile& profile, Limit limit, const std::optional<double>& bound) {
  std::erase_if(profile.limits, [&](const Limit& old) { return is_about_same(old, limit); });
  if (!bound) return;
  limit.bound = *bound;
  profile.limits.push_back(std::move(limit));
}

// A bound, or "none" to drop an inherited one.
std::optional<double> bound_in(const audit::TomlValue& value, const Metric& metric) {
  if (const auto* text = std::get_if<std::string>(&value.data)) {
    if (*text == "none") return std::nullopt;
    input_error("{}: expected a number, or \"none\" to drop an inherited limit", value.where);
  }
  const double bound = metric.more_is_better ? audit::number_in(value) : at_least_zero(value);
  if (!std::isfinite(bound)) input_error("{}: a limit must be finite, got {}", value.where, bound);
  return bound;
}

// { above = THRESHOLD, limit = BOUND }
void read_counted(const audit::TomlValue& entry, const Metric& metric, Limit limit,
                  Profile& profile) {
  std::optional<double> bound;
  bool has_limit = false;
  for (const auto& [key, value] : audit::table_in(entry)) {
    if (key == "above") {
      limit.threshold = at_least_zero(value);
    } else if (key == "limit") {
      bound = bound_in(value, metric);
      has_limit = true;
    } else {
      audit::unknown_key(value, metric.name, {"above", "limit"});
    }
  }
  if (!limit.threshold || !has_limit)
    input_error("{}: expected {{ above = THRESHOLD, limit = PER CENT }}", entry.where);
  set_limit(profile, limit, bound);
}

void read_group(const std::string& group, const std::string& channel, const audit::TomlValue& table,
                Profile& profile) {
  for (const auto& [key, value] : audit::table_in(table)) {
    const Metric* metric = find_metric(group, key);
    if (metric == nullptr) {
      std::vector<std::string> known;
      for (const Metric& each : metrics_of(group)) known.emplace_back(each.name);
      audit::unknown_key(value, "[" + group + "]", known);
    }
    const Limit limit{group, channel, metric->name};
    if (!metric->has_threshold) {
      set_limit(profile, limit, bound_in(value, *metric));
    } else if (const auto* list = std::get_if<audit::TomlList>(&value.data)) {
      for (const audit::TomlValue& entry : *list) read_counted(entry, *metric, limit, profile);
    } else {
      read_counted(value, *metric, limit, profile);
    }
  }
}

Profile inherited(const audit::TomlValue& value, const fs::path& beside, int depth);

Profile parse(const std::string& text, const fs::path& path, int depth) {
  const audit::TomlTable root = audit::parse_toml(text, path.string());
  Profile profile{path.string(), "", {}, {}};
  for (const auto& [key, value] : root) {
    if (key == "inherits") profile = inherited(value, path.parent_path(), depth);
  }
  profile.name = path.string();
  for (const auto& [key, value] : root) {
    if (key == "inherits") continue;
    const std::vector<std::string>& groups = metric_groups();
    if (key == "meaning") {
      profile.meaning = audit::word_in(value);
    } else if (key == "systematic") {
      profile.judges_systematic = audit::truth_in(value);
    } else if (key == "numbers") {
      profile.judges_numbers = audit::truth_in(value);
    } else if (key == "options") {
      read_options(value, profile.options);
    } else if (key == "channel") {
      for (const auto& [name, table] : audit::table_in(value))
        read_group("channel", name, table, profile);
    } else if (std::find(groups.begin(), groups.end(), key) != groups.end()) {
      read_group(key, "", value, profile);
    } else {
      std::vector<std::string> known{"inherits", "meaning", "systematic", "numbers", "options"};
      known.insert(known.end(), groups.begin(), groups.end());
      audit::unknown_key(value, "a profile", known);
    }
  }
  return profile;
}

Profile inherited(const audit::TomlValue& value, const fs::path& beside, int depth) {
  constexpr int kDeepest = 16;
  const std::string name = audit::word_in(value);
  if (depth >= kDeepest)
    input_error("{}: more than {} files inherit from one another", value.where, kDeepest);
  if (!name.ends_with(".toml")) return find_profile(name);
  const fs::path path = fs::path(name).is_absolute() ? fs::path(name) : beside / name;
  if (!fs::is_regular_file(path))
    input_error("{}: there is no profile '{}' to inherit from", value.where, path.string());
  return parse(audit::read_text_file(path.string(), "profile"), path, depth + 1);
}

}  // namespace

Profile parse_profile(const std::string& text, const fs::path& path) {
  return parse(text, path, 0);
}

}  // namespace plumb::compare
