// A golden case, held against its reference: bits first, metrics after.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "golden_actual.h"
#include "golden_bits.h"
#include "golden_manifest.h"
#include "image/aov_image.h"

namespace plumb::tool {

enum class GoldenVerdict {
  Same,     // bit for bit
  Within,   // not the same bits, but within the case's tolerance
  Differs,  // from the reference
  Missing,  // no reference, or another program's folder has no picture of the case
  Stale,    // the files in ref/ show something else than the manifest says
  Failed,   // could not be drawn, read or judged
};
/// "same", "within tolerance", "differs", "missing", "stale", "failed".
const char* name_of(GoldenVerdict verdict);

/// Where a person finds the pictures; empty: there is none.
struct GoldenFiles {
  std::filesystem::path golden, actual, difference, page;
};

struct GoldenCheck {
  std::string name, tolerance;
  GoldenVerdict verdict = GoldenVerdict::Same;
  std::string message;                      // one line: what is wrong
  std::uint64_t expected = 0, found = 0;    // checksums; found 0: there is no picture
  std::vector<ChannelDifference> channels;  // of pictures of one size
  /// By the case's profile; a case that is bit for bit is measured by the first built-in one, which
  /// decides nothing. None where the bits are equal or the pictures cannot be compared.
  std::optional<compare::Comparison> comparison;
  /// Patch at each of comparison->worst, in the reference and now.
  std::vector<std::optional<PatchAt>> patches_golden, patches_now;
  std::optional<PatchShare> responsible;
  GoldenFiles files;

  /// The pictures, with what messages call them. Emptied by drop_pixels.
  compare::PicturePair pair;
  std::optional<image::AovImage> drawn;  // where plumb drew it now

  bool passes() const { return verdict == GoldenVerdict::Same || verdict == GoldenVerdict::Within; }
  bool has_picture() const { return pair.candidate.size() > 0; }
  /// Frees all pixels and maps: what is left is what is to be said.
  void drop_pixels();
};

/// Draws the case, or where `actual` has a picture of it takes that one, and compares. With equal
/// bits nothing is measured. Errors in its files are the verdict Failed.
///
/// actual     null: another program's cases are Failed
/// with_maps  keeps the comparison's maps, for a report
GoldenCheck check_case(const GoldenManifest& manifest, const GoldenCase& golden,
                       const ActualFolder* actual, bool with_maps);

}  // namespace plumb::tool
