// A golden case, drawn again and held against its reference.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "audit/scene.h"
#include "golden_manifest.h"
#include "image/aov_image.h"

namespace plumb::tool {

/// What is different in a channel, by its bits.
struct ChannelDifference {
  std::string channel;
  std::int64_t pixels = 0;
  double largest = 0.0;  // +inf where one of two numbers is not finite, or only one has the channel
};

/// Channels in which two pictures of the same size differ; none if every bit is equal.
std::vector<ChannelDifference> channel_differences(const image::AovImage& reference,
                                                   const image::AovImage& picture);

enum class GoldenVerdict {
  Same,     // bit for bit
  Differs,  // from the manifest's checksum
  Missing,  // no reference picture
  Stale,    // drawn as the manifest says, but the files in ref/ show something else
  Failed,   // could not be drawn or read
};
const char* name_of(GoldenVerdict verdict);  // "same", "differs", "missing", "stale", "failed"

struct GoldenCheck {
  std::string name;
  GoldenVerdict verdict = GoldenVerdict::Same;
  std::string message;  // one line: what is wrong
  std::uint64_t expected = 0, found = 0;
  std::vector<ChannelDifference> channels;
  image::AovImage picture;  // as drawn now
};

/// Draws the case and compares it: checksum first, channels after. Errors in its files are the
/// verdict Failed.
GoldenCheck check_case(const GoldenManifest& manifest, const GoldenCase& golden);

/// The scene of a scene file, or of the header of a picture (.exr) that plumb made. Throws
/// InputError.
audit::Scene read_scene_or_picture(const std::string& path);

/// The picture of a scene, with the methods that come with plumb. Throws InputError.
image::AovImage draw(const audit::Scene& scene);

/// Writes ref/picture.exr and ref/picture.png of a case. Throws InputError.
void write_reference(const GoldenManifest& manifest, const std::string& name,
                     const image::AovImage& picture);

/// Differences as text, a line a channel: "  Z: 12 pixels, 0.5 at most".
std::string text_of(const std::vector<ChannelDifference>& channels);

}  // namespace plumb::tool
