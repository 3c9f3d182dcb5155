// The list of golden pictures: which there are, what their bits are, and why they are kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb::tool {

/// One case, a folder of the manifest's folder:
///   scene.toml        what is drawn (audit/scene.h)
///   ref/picture.exr   every channel, ref/picture.png a preview of it
///   why.md            what would go unnoticed without the case
struct GoldenCase {
  std::string name;            // of the folder: a-z, 0-9 and _
  std::uint64_t checksum = 0;  // image::raw_checksum of the picture
  int checksum_line = 0;       // where the manifest says it
  std::string why;             // one sentence

  friend bool operator==(const GoldenCase&, const GoldenCase&) = default;
};

struct GoldenManifest {
  std::filesystem::path folder;
  std::string text;  // of the manifest itself
  std::vector<GoldenCase> cases;

  std::filesystem::path path() const { return folder / "manifest.toml"; }
  std::filesystem::path scene(const std::string& name) const {
    return folder / name / "scene.toml";
  }
  std::filesystem::path why(const std::string& name) const { return folder / name / "why.md"; }
  std::filesystem::path exr(const std::string& name) const {
    return folder / name / "ref" / "picture.exr";
  }
  std::filesystem::path png(const std::string& name) const {
    return folder / name / "ref" / "picture.png";
  }
};

/// Reads FOLDER/manifest.toml, a list of [[case]] with name, checksum (sixteen hexadecimal digits),
/// tolerance ("none": bit for bit) and why. Throws InputError, one line with the place, for
/// anything else, unknown keys and names that come twice among it.
GoldenManifest read_manifest(const std::filesystem::path& folder);
GoldenManifest parse_manifest(const std::string& text, const std::filesystem::path& folder);

/// Throws InputError that lists what lies in the folder without being named by a case.
void require_tidy(const GoldenManifest& manifest);

/// Throws InputError that lists the known names.
const GoldenCase& find_case(const GoldenManifest& manifest, const std::string& name);

/// The manifest's text with another checksum for a case, comments and all else as they were.
std::string with_checksum(const GoldenManifest& manifest, const std::string& name,
                          std::uint64_t checksum);
/// The manifest's text with a case more. Throws InputError for a name that is not allowed or is
/// there, or for a sentence that is empty or more than a line.
std::string with_case(const GoldenManifest& manifest, const GoldenCase& added);

/// Sixteen hexadecimal digits.
std::string checksum_digits(std::uint64_t checksum);

}  // namespace plumb::tool
