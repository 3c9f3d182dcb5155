#include "audit/profile_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "audit/toml_document.h"
#include "core/check.h"
#include "core/number_text.h"

namespace plumb::audit {
namespace {

using slicing::CostProfile;

void require_speed(double speed, const std::string& where) {
  if (!(speed >= 1.0) || !std::isfinite(speed))
    input_error("{}: expected a speed of at least 1 a second, got {}", where, speed);
}

// Results name their profile: a name stands for its speeds.
void require_name(const CostProfile& profile, const std::string& where) {
  if (profile.name.empty() || profile.name.find(',') != std::string::npos)
    input_error("{}: expected a name without a comma, got '{}'", where, profile.name);
  for (const CostProfile& known : known_profiles()) {
    if (profile.name == known.name && to_text(profile) != to_text(known))
      input_error("{}: '{}' is the profile {}, and no other", where, known.name, to_text(known));
  }
}

CostProfile read_profile_file(const std::string& path) {
  CostProfile profile;
  profile.name = std::filesystem::path(path).stem().string();
  std::replace(profile.name.begin(), profile.name.end(), ',', '_');
  bool vertices = false, pixels = false;
  for (const TomlEntry& entry : parse_toml(read_text_file(path, "profile"), path)) {
    if (entry.key == "name") {
      profile.name = word_in(entry.value);
    } else if (entry.key == "vertices_per_s") {
      profile.vertices_per_s = number_in(entry.value);
      require_speed(profile.vertices_per_s, entry.value.where);
      vertices = true;
    } else if (entry.key == "pixels_per_s") {
      profile.pixels_per_s = number_in(entry.value);
      require_speed(profile.pixels_per_s, entry.value.where);
      pixels = true;
    } else {
      unknown_key(entry.value, "a profile", {"name", "vertices_per_s", "pixels_per_s"});
    }
  }
  if (!vertices || !pixels)
    input_error("{}: a profile needs vertices_per_s and pixels_per_s", path);
  require_name(profile, path);
  return profile;
}

CostProfile read_profile_text(const std::string& text) {
  const std::size_t first = text.find(','), second = text.find(',', first + 1);
  if (second == std::string::npos)
    input_error("profile '{}': expected NAME,VERTICES_PER_S,PIXELS_PER_S", text);
  CostProfile profile;
  profile.name = text.substr(0, first);
  const auto speed = [&](const std::string& part) {
    const auto value = parse_number(part);
    if (!value) input_error("profile '{}': expected a number, got '{}'", text, part);
    require_speed(*value, "profile '" + text + "'");
    return *value;
  };
  profile.vertices_per_s = speed(text.substr(first + 1, second - first - 1));
  profile.pixels_per_s = speed(text.substr(second + 1));
  require_name(profile, "profile '" + text + "'");
  return profile;
}

}  // namespace

const std::vector<CostProfile>& known_profiles() {
  static const std::vector<CostProfile> profiles{CostProfile{}};
  return profiles;
}

CostProfile parse_profile(const std::string& text) {
  std::string names;
  for (const CostProfile& known : known_profiles()) {
    if (known.name == text) return known;
    names += (names.empty() ? "" : ", ") + known.name;
  }
  if (text.ends_with(".toml")) return read_profile_file(text);
  if (text.find(',') != std::string::npos) return read_profile_text(text);
  input_error("profile '{}': expected {}, a .toml file or NAME,VERTICES_PER_S,PIXELS_PER_S", text,
              names);
}

std::string to_text(const CostProfile& profile) {
  return fmt::format("{},{},{}", profile.name, toml_number(profile.vertices_per_s),
                     toml_number(profile.pixels_per_s));
}

std::string to_toml(const CostProfile& profile, const std::vector<std::string>& comments) {
  std::string text;
  for (const std::string& comment : comments) text += "# " + comment + "\n";
  return text + fmt::format("name = {}\nvertices_per_s = {}\npixels_per_s = {}\n",
                            toml_text(profile.name), toml_number(profile.vertices_per_s),
                            toml_number(profile.pixels_per_s));
}

}  // namespace plumb::audit
