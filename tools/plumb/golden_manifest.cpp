#include "golden_manifest.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include "audit/toml_document.h"
#include "compare/folder_pairs.h"
#include "core/check.h"

namespace plumb::tool {
namespace fs = std::filesystem;
namespace {

constexpr const char* kHeading =
    "# Golden pictures: one entry a case. checksum is that of the raw float channels, before any\n"
    "# file format. Only `plumb golden add` and `plumb golden update` write here and in ref/.\n";

std::uint64_t checksum_in(const audit::TomlValue& value) {
  const std::string text = audit::word_in(value);
  std::uint64_t checksum = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), checksum, 16);
  if (text.size() != 16 || error != std::errc() || end != text.data() + text.size())
    input_error("{}: expected sixteen hexadecimal digits", value.where);
  return checksum;
}

void check_name(const std::string& name, const std::string& where) {
  constexpr const char* kAllowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  const bool allowed = !name.empty() && name.front() != '.' && name.front() != '-' &&
                       name.find_first_not_of(kAllowed) == std::string::npos;
  if (!allowed || name.ends_with(".toml"))
    input_error(
        "{}: a case's name has letters, digits, _, - and ., begins with neither of the "
        "last two and ends with no .toml, got '{}'",
        where, name);
}

GoldenCase case_in(const audit::TomlValue& entry) {
  GoldenCase found;
  std::set<std::string> missing{"name", "checksum", "tolerance", "why"};
  for (const auto& [key, value] : audit::table_in(entry)) {
    missing.erase(key);
    if (key == "name") {
      found.name = audit::word_in(value);
      check_name(found.name, value.where);
    } else if (key == "checksum") {
      found.checksum = checksum_in(value);
      found.checksum_line = value.line;
    } else if (key == "tolerance") {
      found.tolerance = audit::word_in(value);
    } else if (key == "why") {
      found.why = audit::word_in(value);
    } else {
      audit::unknown_key(value, "a case", {"name", "checksum", "tolerance", "why"});
    }
  }
  if (!missing.empty()) input_error("{}: a case needs {}", entry.where, fmt::join(missing, ", "));
  return found;
}

bool is_file(const std::string& tolerance) { return tolerance.ends_with(".toml"); }

// A path and the folders on the way to it.
void expect(const fs::path& folder, const fs::path& path, std::set<fs::path>& expected) {
  for (fs::path each = path.lexically_normal(); each != folder && each.has_relative_path();
       each = each.parent_path())
    expected.insert(each);
}

// A profile's file and those that it inherits from; whether it can be read is seen when it is used.
void expect_profile(const fs::path& folder, const fs::path& path, std::set<fs::path>& expected) {
  if (expected.contains(path) || !fs::is_regular_file(path)) return;
  expect(folder, path, expected);
  try {
    const std::string text = audit::read_text_file(path.string(), "profile");
    for (const auto& [key, value] : audit::parse_toml(text, path.string())) {
      const auto* base = std::get_if<std::string>(&value.data);
      if (key == "inherits" && base != nullptr && is_file(*base))
        expect_profile(folder, (path.parent_path() / *base).lexically_normal(), expected);
    }
  } catch (const InputError&) {
  }
}

// What may lie below the manifest's folder, as normal paths.
std::set<fs::path> expected_files(const GoldenManifest& manifest) {
  const fs::path folder = manifest.folder.lexically_normal();
  std::set<fs::path> expected{manifest.path().lexically_normal()};
  for (const GoldenCase& each : manifest.cases) {
    const std::string& name = each.name;
    expect(folder, manifest.why(name), expected);
    expect(folder, manifest.exr(name).parent_path(), expected);
    for (const fs::path& reference : manifest.references(name)) expect(folder, reference, expected);
    if (manifest.is_drawn(name)) {
      expect(folder, manifest.scene(name), expected);
      expect(folder, manifest.png(name), expected);
    }
    if (is_file(each.tolerance))
      expect_profile(folder, (folder / each.tolerance).lexically_normal(), expected);
  }
  return expected;
}

}  // namespace

std::string checksum_digits(std::uint64_t checksum) { return fmt::format("{:016x}", checksum); }

GoldenManifest parse_manifest(const std::string& text, const fs::path& folder) {
  GoldenManifest manifest{folder, text, {}};
  std::set<std::string> names;
  for (const auto& [key, value] : audit::parse_toml(text, manifest.path().string())) {
    if (key != "case") audit::unknown_key(value, "a manifest", {"case"});
    for (const audit::TomlValue& entry : audit::tables_in(value)) {
      manifest.cases.push_back(case_in(entry));
      if (!names.insert(manifest.cases.back().name).second)
        input_error("{}: a second case '{}'", entry.where, manifest.cases.back().name);
    }
  }
  return manifest;
}

GoldenManifest read_manifest(const fs::path& folder) {
  const std::string path = (folder / "manifest.toml").string();
  return parse_manifest(audit::read_text_file(path, "manifest"), folder);
}

std::vector<fs::path> GoldenManifest::references(const std::string& name) const {
  std::vector<fs::path> found;
  if (is_drawn(name)) {
    if (fs::is_regular_file(exr(name))) found.push_back(exr(name));
    return found;
  }
  const fs::path ref = exr(name).parent_path();
  if (!fs::is_directory(ref)) return found;
  for (const fs::directory_entry& each : fs::directory_iterator(ref)) {
    if (each.path().stem() == "picture" && each.is_regular_file() &&
        compare::is_picture(each.path()))
      found.push_back(each.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

compare::Profile profile_of(const GoldenManifest& manifest, const GoldenCase& golden) {
  if (golden.bit_for_bit()) return compare::built_in_profiles().front();
  if (!is_file(golden.tolerance)) return compare::find_profile(golden.tolerance);
  return compare::find_profile((manifest.folder / golden.tolerance).string());
}

std::vector<std::string> stray_files(const GoldenManifest& manifest) {
  const std::set<fs::path> expected = expected_files(manifest);
  std::vector<std::string> strays;
  for (fs::recursive_directory_iterator each(manifest.folder), end; each != end; ++each) {
    if (expected.contains(each->path().lexically_normal())) continue;
    strays.push_back(each->path().lexically_relative(manifest.folder).string());
    each.disable_recursion_pending();
  }
  std::sort(strays.begin(), strays.end());
  return strays;
}

const GoldenCase& find_case(const GoldenManifest& manifest, const std::string& name) {
  std::vector<std::string> names;
  for (const GoldenCase& each : manifest.cases) {
    if (each.name == name) return each;
    names.push_back(each.name);
  }
  input_error("{}: there is no case '{}'; there are {}", manifest.path().string(), name,
              names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")));
}

std::string with_checksum(const GoldenManifest& manifest, const std::string& name,
                          std::uint64_t checksum) {
  const GoldenCase& changed = find_case(manifest, name);
  std::istringstream lines(manifest.text);
  std::string result;
  int number = 0;
  for (std::string line; std::getline(lines, line); result += line + "\n") {
    if (++number != changed.checksum_line) continue;
    const std::string old = checksum_digits(changed.checksum);
    const std::size_t at = line.find(old);
    if (at == std::string::npos)
      input_error("{}, line {}: expected the checksum as \"{}\"", manifest.path().string(), number,
                  old);
    line.replace(at, old.size(), checksum_digits(checksum));
  }
  return result;
}

std::string with_case(const GoldenManifest& manifest, const GoldenCase& added) {
  check_name(added.name, manifest.path().string());
  for (const GoldenCase& each : manifest.cases) {
    if (each.name == added.name)
      input_error("{}: there is a case '{}' already", manifest.path().string(), added.name);
  }
  if (added.why.empty() || added.why.find('\n') != std::string::npos)
    input_error("case '{}': expected one sentence that says why it is kept", added.name);
  const std::string before = manifest.text.empty() ? kHeading : manifest.text;
  return fmt::format("{}\n[[case]]\nname = {}\nchecksum = \"{}\"\ntolerance = {}\nwhy = {}\n",
                     before, audit::toml_text(added.name), checksum_digits(added.checksum),
                     audit::toml_text(added.tolerance), audit::toml_text(added.why));
}

}  // namespace plumb::tool
