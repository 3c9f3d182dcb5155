// What two pictures may differ by: limits, and how the numbers that they limit are measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/measurement.h"

namespace plumb::compare {

/// How metrics are measured that can be measured in more than one way.
struct MeasureOptions {
  double pixels_per_degree = 67.02064327658225;  // of FLIP, in [1, 1000]
  int shift_radius_px = 1;                       // of `unmatched`, in [0, 8]
  double shift_tolerance = 0.0;                  // of `unmatched`, every channel, as stored
  int band_px = 1;                               // of coverage, in [0, 64]
  double unexplained_above = 2.0 / 255.0;        // of `unexplained_share`, display numbers
  double isolated_above = 28.0 / 255.0;          // of `isolated_pixels`, display numbers
  double depth_above = 1e-3;  // of depth's `unexplained_share` and `isolated_pixels`, relative

  friend bool operator==(const MeasureOptions&, const MeasureOptions&) = default;
};

struct Profile {
  std::string name;     // of the built-in one, or the file's
  std::string meaning;  // one line
  MeasureOptions options;
  std::vector<Limit> limits;      // those of channels that the pictures lack judge nothing
  bool judges_systematic = true;  // a difference with a system fails, whatever its size
  bool judges_numbers = true;     // a NaN or an infinity in one picture alone fails

  friend bool operator==(const Profile&, const Profile&) = default;
};

/// "default", "exact", and one for each rule of others_rules.h; the first one is the default.
const std::vector<Profile>& built_in_profiles();

/// The built-in profile of that name, or a TOML file (docs/comparing.md). Throws InputError that
/// names the known ones, or the line of the file and what was expected there.
Profile find_profile(const std::string& name_or_path);
/// The same of a file's text; what it inherits from is looked up beside `path`.
Profile parse_profile(const std::string& text, const std::filesystem::path& path);
/// A file that reads back as the same profile.
std::string to_toml(const Profile& profile);

}  // namespace plumb::compare
