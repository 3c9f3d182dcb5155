// The list of golden pictures: which there are, what their bits are, and why they are kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "compare/profile.h"

namespace plumb::tool {

/// One case, a folder of the manifest's folder. Drawn by plumb:
///   scene.toml        what is drawn (audit/scene.h)
///   ref/picture.exr   every channel, ref/picture.png a preview of it
///   why.md            what would go unnoticed without the case
/// or by another program:
///   ref/picture.EXT   the picture as that program wrote it, in any format of compare::is_picture
///   why.md            may be missing
struct GoldenCase {
  std::string name;            // of the folder: letters, digits, _ - and ., no . at its beginning
  std::uint64_t checksum = 0;  // image::raw_checksum of the picture
  int checksum_line = 0;       // where the manifest says it
  std::string why;             // one sentence
  std::string tolerance = "none";  // bit for bit; or a profile: its name, or a file (.toml)

  bool bit_for_bit() const { return tolerance == "none"; }
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
  /// Whether plumb draws the case: it has a scene.
  bool is_drawn(const std::string& name) const { return std::filesystem::exists(scene(name)); }
  /// The files that may be the reference of a case, those that are there: picture.exr where plumb
  /// draws it, else every picture.EXT, of which there should be one.
  std::vector<std::filesystem::path> references(const std::string& name) const;
};

/// Reads FOLDER/manifest.toml, a list of [[case]] with name, checksum (sixteen hexadecimal digits),
/// tolerance ("none": bit for bit; or a profile) and why. Throws InputError, one line with the
/// place, for anything else, unknown keys and names that come twice among it.
GoldenManifest read_manifest(const std::filesystem::path& folder);
GoldenManifest parse_manifest(const std::string& text, const std::filesystem::path& folder);

/// What may differ in a case; a file is looked for in the manifest's folder. The first built-in
/// profile where the case is bit for bit: it measures, and does not decide. Throws InputError as
/// compare::find_profile does.
compare::Profile profile_of(const GoldenManifest& manifest, const GoldenCase& golden);

/// What lies in the folder without being named by a case or a tolerance, sorted.
std::vector<std::string> stray_files(const GoldenManifest& manifest);

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
