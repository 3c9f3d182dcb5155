#include "golden_picture.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

#include "audit/picture.h"
#include "audit/scene_picture.h"
#include "core/check.h"
#include "image/image_files.h"
#include "image/srgb.h"
#include "version.h"

namespace plumb::tool {
namespace fs = std::filesystem;
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string size_text(const image::AovImage& image) {
  return fmt::format("{} x {} pixels", image.width_px, image.height_px);
}

bool preview_is(const fs::path& png, const image::AovImage& picture) {
  return fs::exists(png) && image::read_png(png) == image::to_srgb8(audit::preview_of(picture));
}

void compare(const GoldenManifest& manifest, GoldenCheck& check) {
  const fs::path exr = manifest.exr(check.name);
  if (!fs::exists(exr)) {
    check.verdict = GoldenVerdict::Missing;
    check.message = fmt::format("there is no {}", exr.string());
    return;
  }
  const image::AovImage reference = image::read_exr(exr);
  const bool right_size = reference.width_px == check.picture.width_px &&
                          reference.height_px == check.picture.height_px;
  if (right_size) check.channels = channel_differences(reference, check.picture);
  if (check.found != check.expected) {
    check.verdict = GoldenVerdict::Differs;
    check.message = fmt::format("checksum {}, expected {}", checksum_digits(check.found),
                                checksum_digits(check.expected));
    if (!right_size)
      check.message +=
          fmt::format("; {}, expected {}", size_text(check.picture), size_text(reference));
  } else if (!right_size || !check.channels.empty()) {
    check.verdict = GoldenVerdict::Stale;
    check.message = fmt::format("{} is not the picture of the manifest's checksum", exr.string());
  } else if (!preview_is(manifest.png(check.name), reference)) {
    check.verdict = GoldenVerdict::Stale;
    check.message = fmt::format("{} is not the preview of the picture beside it",
                                manifest.png(check.name).string());
  }
}

}  // namespace

const char* name_of(GoldenVerdict verdict) {
  switch (verdict) {
    case GoldenVerdict::Same:
      return "same";
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

std::vector<ChannelDifference> channel_differences(const image::AovImage& reference,
                                                   const image::AovImage& picture) {
  require(reference.width_px == picture.width_px && reference.height_px == picture.height_px,
          "pictures must be of one size, got {} and {}", size_text(reference), size_text(picture));
  std::vector<ChannelDifference> differences;
  for (const image::Channel& channel : image::channels()) {
    const std::vector<float>& a = reference.*channel.values;
    const std::vector<float>& b = picture.*channel.values;
    ChannelDifference found{channel.name};
    if (a.size() != b.size()) {
      found.pixels = static_cast<std::int64_t>(picture.size());
      found.largest = kInfinity;
    }
    for (std::size_t k = 0; k < a.size() && a.size() == b.size(); ++k) {
      if (std::bit_cast<std::uint32_t>(a[k]) == std::bit_cast<std::uint32_t>(b[k])) continue;
      ++found.pixels;
      const double apart = std::abs(static_cast<double>(a[k]) - static_cast<double>(b[k]));
      found.largest = std::isfinite(apart) ? std::max(found.largest, apart) : kInfinity;
    }
    if (found.pixels > 0) differences.push_back(found);
  }
  return differences;
}

std::string text_of(const std::vector<ChannelDifference>& channels) {
  std::string text;
  for (const ChannelDifference& each : channels)
    text +=
        fmt::format("  {}: {} pixels, {:.6g} at most\n", each.channel, each.pixels, each.largest);
  return text;
}

audit::Scene read_scene_or_picture(const std::string& path) {
  if (!path.ends_with(".exr")) return audit::read_scene_file(path);
  const image::AovImage picture = image::read_exr(path);
  const auto found = picture.metadata.find("scene");
  const std::string* text =
      found == picture.metadata.end() ? nullptr : std::get_if<std::string>(&found->second);
  if (text == nullptr) input_error("{}: its header holds no scene: it was not drawn by one", path);
  return audit::parse_scene(*text, path + " (header)");
}

image::AovImage draw(const audit::Scene& scene) {
  return audit::draw_scene(scene, audit::built_in_methods(), version_number()).picture;
}

GoldenCheck check_case(const GoldenManifest& manifest, const GoldenCase& golden) {
  GoldenCheck check;
  check.name = golden.name;
  check.expected = golden.checksum;
  try {
    const fs::path why = manifest.why(golden.name);
    if (!fs::exists(why) || fs::file_size(why) == 0)
      input_error("{}: expected a few lines that say why the case is kept", why.string());
    check.picture = draw(audit::read_scene_file(manifest.scene(golden.name).string()));
    check.found = image::raw_checksum(check.picture);
    compare(manifest, check);
  } catch (const InputError& error) {
    check.verdict = GoldenVerdict::Failed;
    check.message = error.what();
  }
  return check;
}

void write_reference(const GoldenManifest& manifest, const std::string& name,
                     const image::AovImage& picture) {
  const fs::path folder = manifest.exr(name).parent_path();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) input_error("cannot make the folder '{}': {}", folder.string(), error.message());
  image::write_exr(manifest.exr(name), picture);
  image::write_png(manifest.png(name), audit::preview_of(picture));
}

}  // namespace plumb::tool
