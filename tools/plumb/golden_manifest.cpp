#include "golden_manifest.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include "audit/toml_document.h"
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
  constexpr const char* kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789_";
  if (name.empty() || name.find_first_not_of(kAllowed) != std::string::npos)
    input_error("{}: a case's name has a-z, 0-9 and _, got '{}'", where, name);
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
      if (audit::word_in(value) != "none")
        input_error("{}: expected \"none\", bit for bit", value.where);
    } else if (key == "why") {
      found.why = audit::word_in(value);
    } else {
      audit::unknown_key(value, "a case", {"name", "checksum", "tolerance", "why"});
    }
  }
  if (!missing.empty()) input_error("{}: a case needs {}", entry.where, fmt::join(missing, ", "));
  return found;
}

// What may lie below the manifest's folder.
std::set<fs::path> expected_files(const GoldenManifest& manifest) {
  std::set<fs::path> expected{manifest.path()};
  for (const GoldenCase& each : manifest.cases) {
    const std::string& name = each.name;
    expected.insert({manifest.folder / name, manifest.scene(name), manifest.why(name),
                     manifest.exr(name).parent_path(), manifest.exr(name), manifest.png(name)});
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

void require_tidy(const GoldenManifest& manifest) {
  const std::set<fs::path> expected = expected_files(manifest);
  std::vector<std::string> strays;
  for (fs::recursive_directory_iterator each(manifest.folder), end; each != end; ++each) {
    if (expected.contains(each->path())) continue;
    strays.push_back(fs::relative(each->path(), manifest.folder).string());
    each.disable_recursion_pending();
  }
  std::sort(strays.begin(), strays.end());
  if (!strays.empty())
    input_error("{}: no case names {}", manifest.path().string(), fmt::join(strays, ", "));
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
  return fmt::format("{}\n[[case]]\nname = {}\nchecksum = \"{}\"\ntolerance = \"none\"\nwhy = {}\n",
                     before, audit::toml_text(added.name), checksum_digits(added.checksum),
                     audit::toml_text(added.why));
}

}  // namespace plumb::tool
