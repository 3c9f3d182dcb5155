#include "golden_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compare/comparison_words.h"
#include "core/check.h"
#include "golden_picture.h"
#include "image/image_files.h"

namespace plumb::tool {
namespace fs = std::filesystem;
namespace {

void require_reason(const GoldenManifest& manifest, const std::string& name) {
  const fs::path why = manifest.why(name);
  if (manifest.is_drawn(name) && (!fs::exists(why) || fs::file_size(why) == 0))
    input_error("{}: expected a few lines that say why the case is kept", why.string());
}

void missing(GoldenCheck& check, const std::string& message) {
  check.verdict = GoldenVerdict::Missing;
  check.message = message;
}

// What was looked for, and what to do: plumb cannot draw the picture, another program can.
std::string no_picture_message(const GoldenManifest& manifest, const fs::path& folder,
                               const std::string& name) {
  const std::vector<fs::path> kept = manifest.references(name);
  const std::string extension = kept.empty() ? ".png" : kept.front().extension().string();
  return fmt::format(
      "there is no picture of it in {}: let the program that draws it write {} (or another "
      "format), "
      "then check again; if it no longer draws it, take the case out of {}",
      folder.string(), (folder / (name + extension)).string(), manifest.path().string());
}

// The picture as it is now; without one the case is missing.
void take_picture(const GoldenManifest& manifest, const ActualFolder* actual, GoldenCheck& check) {
  const auto file = actual == nullptr ? std::nullopt : actual->find(check.name);
  if (file) {
    check.files.actual = *file;
    check.pair.candidate_name = file->string();
    check.pair.candidate = image::read_planes(*file);
  } else if (manifest.is_drawn(check.name)) {
    check.drawn = draw(audit::read_scene_file(manifest.scene(check.name).string()));
    check.pair.candidate_name = check.name + " as drawn now";
    check.pair.candidate = image::planes_of(*check.drawn);
  } else if (actual == nullptr) {
    input_error(
        "plumb does not draw it (there is no {}): name the folder of its pictures with "
        "--actual",
        manifest.scene(check.name).string());
  } else {
    missing(check, no_picture_message(manifest, actual->folder, check.name));
    return;
  }
  check.found = image::raw_checksum(check.pair.candidate);
}

void take_reference(const GoldenManifest& manifest, GoldenCheck& check) {
  const std::vector<fs::path> files = manifest.references(check.name);
  if (files.size() > 1)
    input_error("more than one reference: {} and {}", files[0].string(), files[1].string());
  if (files.empty()) {
    const fs::path ref = manifest.exr(check.name).parent_path();
    missing(check,
            fmt::format(
                "there is no reference, {}",
                (ref / (manifest.is_drawn(check.name) ? "picture.exr" : "picture.*")).string()));
    return;
  }
  check.files.golden = files.front();
  check.pair.reference_name = files.front().string();
  check.pair.reference = image::read_planes(files.front());
}

// The preview of a picture that plumb draws, whose reference has been found to be right.
bool preview_holds(const GoldenManifest& manifest, const GoldenCheck& check) {
  if (!manifest.is_drawn(check.name)) return true;
  return is_preview(manifest.png(check.name),
                    check.drawn ? *check.drawn : image::read_exr(check.files.golden));
}

void add_patches(GoldenCheck& check) {
  for (const compare::WorstPixel& worst : check.comparison->worst) {
    check.patches_golden.push_back(patch_at(check.pair.reference, worst.x, worst.y));
    check.patches_now.push_back(patch_at(check.pair.candidate, worst.x, worst.y));
  }
}

// What is different, in bits and, where the pictures allow it, in metrics.
void measure(const compare::Profile& profile, bool with_maps, GoldenCheck& check) {
  const image::PlaneImage &before = check.pair.reference, &now = check.pair.candidate;
  if (before.width_px == now.width_px && before.height_px == now.height_px) {
    check.channels = channel_differences(before, now);
    if (!check.channels.empty()) check.responsible = patch_responsible(before, now);
  }
  try {
    compare::require_comparable(check.pair);
  } catch (const InputError& error) {
    check.message += fmt::format("; {}", error.what());
    return;
  }
  compare::CompareOptions options;
  options.with_maps = with_maps;
  check.comparison = compare::compare_pictures(check.pair, profile, options);
  add_patches(check);
}

void judge_by_tolerance(GoldenCheck& check) {
  if (!check.comparison) return;
  switch (check.comparison->verdict) {
    case compare::CompareVerdict::Equal:
    case compare::CompareVerdict::Passes:
      check.verdict = GoldenVerdict::Within;
      break;
    case compare::CompareVerdict::Fails:
      break;
    case compare::CompareVerdict::None:
      check.verdict = GoldenVerdict::Failed;
      check.message = compare::verdict_sentence(*check.comparison);
  }
}

void judge(const GoldenManifest& manifest, const GoldenCase& golden, bool with_maps,
           GoldenCheck& check) {
  const std::uint64_t kept = image::raw_checksum(check.pair.reference);
  if (kept != check.expected) {
    check.verdict = GoldenVerdict::Stale;
    check.message = fmt::format(
        "{} has the checksum {}, the manifest says {}: it was changed by hand, or an "
        "update was interrupted",
        check.files.golden.string(), checksum_digits(kept), checksum_digits(check.expected));
  } else if (check.found == check.expected) {
    if (preview_holds(manifest, check)) return;
    check.verdict = GoldenVerdict::Stale;
    check.message = fmt::format("{} is not the preview of the picture beside it",
                                manifest.png(check.name).string());
    return;
  } else {
    check.verdict = GoldenVerdict::Differs;
    check.message = fmt::format("checksum {}, expected {}", checksum_digits(check.found),
                                checksum_digits(check.expected));
  }
  measure(profile_of(manifest, golden), with_maps, check);
  if (check.verdict == GoldenVerdict::Differs && !golden.bit_for_bit()) judge_by_tolerance(check);
}

}  // namespace

const char* name_of(GoldenVerdict verdict) {
  switch (verdict) {
    case GoldenVerdict::Same:
      return "same";
    case GoldenVerdict::Within:
      return "within tolerance";
    case GoldenVerdict::Differs:
      return "differs";
    case GoldenVerdict::Missing:
      return "missing";
    case GoldenVerdict::Stale:
      return "stale";
    case GoldenVerdict::Failed:
      return "failed";
  }
  return "?";
}

void GoldenCheck::drop_pixels() {
  pair.reference = pair.candidate = {};
  drawn.reset();
  if (comparison) comparison->maps = {};
}

GoldenCheck check_case(const GoldenManifest& manifest, const GoldenCase& golden,
                       const ActualFolder* actual, bool with_maps) {
  GoldenCheck check;
  check.name = golden.name;
  check.tolerance = golden.tolerance;
  check.expected = golden.checksum;
  try {
    profile_of(manifest, golden);  // a wrong one is found however the bits are
    require_reason(manifest, golden.name);
    take_picture(manifest, actual, check);
    if (check.has_picture()) take_reference(manifest, check);
    if (check.verdict == GoldenVerdict::Same) judge(manifest, golden, with_maps, check);
  } catch (const InputError& error) {
    check.verdict = GoldenVerdict::Failed;
    check.message = error.what();
  }
  return check;
}

}  // namespace plumb::tool
