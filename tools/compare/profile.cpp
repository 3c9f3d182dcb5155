#include "compare/profile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "audit/toml_document.h"
#include "compare/others_rules.h"
#include "core/check.h"

namespace plumb::compare {
namespace {

Profile exact() {
  Profile profile{"exact", "Every number of every channel is the same.", {}, {}};
  profile.limits.push_back({"channel", "*", "largest", {}, 0.0});
  return profile;
}

// The numbers are measured: docs/comparing.md has the tables that they come from.
Profile tolerant() {
  Profile profile{"default",
                  "What another driver or processor may do to a picture passes; cracks, pinholes, "
                  "missing tiles, shifts and other levels of detail do not.",
                  {},
                  {}};
  profile.limits = {{"coverage", "", "holes", {}, 0.0},
                    {"coverage", "", "overshoot", {}, 0.0},
                    {"colour", "", "isolated_largest", {}, 64.0 / 255.0},
                    {"colour", "", "isolated_pixels", {}, 15.0},
                    {"colour", "", "unexplained_share", {}, 0.25},
                    {"depth", "", "unexplained_share", {}, 0.5},
                    {"depth", "", "isolated_pixels", {}, 10.0},
                    {"normal", "", "unmatched_share", {}, 5.0}};
  return profile;
}

}  // namespace

namespace {

std::vector<Profile> all_profiles() {
  std::vector<Profile> profiles{tolerant(), exact()};
  for (const OtherRule& rule : other_rules()) {
    Profile profile{rule.name, fmt::format("{}: {}", rule.whose, rule.meaning), {}, {}};
    profile.limits.push_back({"others", "", rule.name, {}, rule.limit});
    profile.judges_systematic = profile.judges_numbers = false;
    profiles.push_back(std::move(profile));
  }
  return profiles;
}

}  // namespace

const std::vector<Profile>& built_in_profiles() {
  static const std::vector<Profile> profiles = all_profiles();
  return profiles;
}

Profile find_profile(const std::string& name_or_path) {
  std::vector<std::string> names;
  for (const Profile& profile : built_in_profiles()) {
    if (profile.name == name_or_path) return profile;
    names.push_back(profile.name);
  }
  if (!name_or_path.ends_with(".toml"))
    input_error("there is no profile '{}'; there are {}, and files that end in .toml", name_or_path,
                fmt::join(names, ", "));
  return parse_profile(audit::read_text_file(name_or_path, "profile"), name_or_path);
}

namespace {

// Quoted where a point would make it two keys.
std::string key_of(const std::string& metric) {
  return metric.find('.') == std::string::npos ? metric : audit::toml_text(metric);
}

std::string option_lines(const MeasureOptions& options) {
  const auto line = [](const char* name, double value) {
    return fmt::format("{} = {}\n", name, audit::toml_number(value));
  };
  return line("pixels_per_degree", options.pixels_per_degree) +
         fmt::format("shift_radius_px = {}\n", options.shift_radius_px) +
         line("shift_tolerance", options.shift_tolerance) +
         fmt::format("band_px = {}\n", options.band_px) +
         line("unexplained_above", options.unexplained_above) +
         line("isolated_above", options.isolated_above) + line("depth_above", options.depth_above);
}

}  // namespace

std::string to_toml(const Profile& profile) {
  std::string text = fmt::format("meaning = {}\nsystematic = {}\nnumbers = {}\n",
                                 audit::toml_text(profile.meaning), profile.judges_systematic,
                                 profile.judges_numbers);
  text += "\n[options]\n" + option_lines(profile.options);
  std::map<std::string, std::vector<std::string>> tables;
  std::map<std::string, std::map<std::string, std::vector<std::string>>> counts;
  for (const Limit& limit : profile.limits) {
    const std::string table =
        limit.group == "channel" ? "channel." + audit::toml_text(limit.channel) : limit.group;
    if (limit.threshold) {
      counts[table][limit.metric].push_back(fmt::format("{{ above = {}, limit = {} }}",
                                                        audit::toml_number(*limit.threshold),
                                                        audit::toml_number(limit.bound)));
    } else {
      tables[table].push_back(
          fmt::format("{} = {}", key_of(limit.metric), audit::toml_number(limit.bound)));
    }
  }
  for (const auto& [table, metrics] : counts) {
    for (const auto& [metric, entries] : metrics)
      tables[table].push_back(fmt::format("{} = [{}]", metric, fmt::join(entries, ", ")));
  }
  for (const auto& [table, lines] : tables)
    text += fmt::format("\n[{}]\n{}\n", table, fmt::join(lines, "\n"));
  return text;
}

}  // namespace plumb::compare
