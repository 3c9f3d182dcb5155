// In what two pictures differ, by their bits: what no rounding and no tolerance hides.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/plane_image.h"

namespace plumb::tool {

/// What is different in a channel.
struct ChannelDifference {
  std::string channel;
  std::int64_t pixels = 0;
  double largest = 0.0;  // +inf where one of two numbers is not finite, or only one has the channel
  /// Where the largest is, the first of several, and the numbers there; -1 without such a pixel.
  int x = -1, y = -1;
  float reference = 0.0f, picture = 0.0f;
};

/// Channels in which two pictures of the same size differ, those of the reference first; none if
/// every bit is equal. Throws std::invalid_argument if the sizes differ.
std::vector<ChannelDifference> channel_differences(const image::PlaneImage& reference,
                                                   const image::PlaneImage& picture);

/// Differences as text, a line a channel: "  Z: 12 pixels, 0.5 at most, at (3, 4): 12.5, golden
/// 12".
std::string text_of(const std::vector<ChannelDifference>& channels);

/// Patch and level at a pixel, by the channels id and lod.
struct PatchAt {
  float id = -1.0f;               // -1: nothing is seen there
  std::optional<float> lod = {};  // none without such a channel

  friend bool operator==(const PatchAt&, const PatchAt&) = default;
};
/// None where there is no channel id. The pixel must be there.
std::optional<PatchAt> patch_at(const image::PlaneImage& picture, int x, int y);
/// "12, lod 3", "none" where nothing is seen, "-" without such a channel.
std::string text_of(const std::optional<PatchAt>& patch);

/// The patch, at one of its levels, in which most of the pixels lie that differ in any channel.
struct PatchShare {
  PatchAt patch;
  bool is_now = true;       // of the picture; else of the reference, where the picture shows none
  std::int64_t pixels = 0;  // of these
  std::int64_t of = 0;
};
/// The first of several; none where neither picture has patches at these pixels.
std::optional<PatchShare> patch_responsible(const image::PlaneImage& reference,
                                            const image::PlaneImage& picture);

}  // namespace plumb::tool
