#include "golden_bits.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/check.h"

namespace plumb::tool {
namespace {

using image::Plane;
using image::PlaneImage;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

double distance(float a, float b) {
  const double apart = std::abs(static_cast<double>(a) - static_cast<double>(b));
  return std::isfinite(apart) ? apart : kInfinity;
}

ChannelDifference difference_of(const Plane& reference, const Plane& picture, int width_px) {
  ChannelDifference found{reference.name};
  for (std::size_t k = 0; k < reference.values.size(); ++k) {
    const float a = reference.values[k], b = picture.values[k];
    if (same_bits(a, b)) continue;
    ++found.pixels;
    const double apart = distance(a, b);
    if (found.x >= 0 && apart <= found.largest) continue;
    const auto width = static_cast<std::size_t>(width_px);
    found.largest = apart;
    found.x = static_cast<int>(k % width);
    found.y = static_cast<int>(k / width);
    found.reference = a;
    found.picture = b;
  }
  return found;
}

ChannelDifference lacking(const std::string& channel, std::size_t size) {
  return {channel, static_cast<std::int64_t>(size), kInfinity};
}

// 1 at pixels where a channel that both have differs.
std::vector<char> differing(const PlaneImage& reference, const PlaneImage& picture) {
  std::vector<char> differs(picture.size(), 0);
  for (const Plane& plane : reference.planes) {
    const Plane* other = picture.find(plane.name);
    for (std::size_t k = 0; other != nullptr && k < differs.size(); ++k) {
      if (!same_bits(plane.values[k], other->values[k])) differs[k] = 1;
    }
  }
  return differs;
}

void require_one_size(const PlaneImage& a, const PlaneImage& b) {
  require(a.width_px == b.width_px && a.height_px == b.height_px,
          "pictures must be of one size, got {} x {} and {} x {}", a.width_px, a.height_px,
          b.width_px, b.height_px);
}

}  // namespace

std::vector<ChannelDifference> channel_differences(const PlaneImage& reference,
                                                   const PlaneImage& picture) {
  require_one_size(reference, picture);
  std::vector<ChannelDifference> differences;
  for (const Plane& plane : reference.planes) {
    const Plane* other = picture.find(plane.name);
    const ChannelDifference found = other == nullptr
                                        ? lacking(plane.name, picture.size())
                                        : difference_of(plane, *other, picture.width_px);
    if (found.pixels > 0) differences.push_back(found);
  }
  for (const Plane& plane : picture.planes) {
    if (reference.find(plane.name) == nullptr)
      differences.push_back(lacking(plane.name, picture.size()));
  }
  return differences;
}

std::string text_of(const std::vector<ChannelDifference>& channels) {
  std::string text;
  for (const ChannelDifference& each : channels) {
    text += fmt::format("  {}: {} pixels, ", each.channel, each.pixels);
    if (each.x < 0) {
      text += "in one picture alone\n";
    } else {
      text += fmt::format("{:.6g} at most, at ({}, {}): {}, golden {}\n", each.largest, each.x,
                          each.y, each.picture, each.reference);
    }
  }
  return text;
}

std::optional<PatchAt> patch_at(const PlaneImage& picture, int x, int y) {
  const Plane* id = picture.find("id");
  if (id == nullptr) return std::nullopt;
  const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
                         static_cast<std::size_t>(x);
  PatchAt patch{id->values.at(at)};
  if (const Plane* lod = picture.find("lod")) patch.lod = lod->values.at(at);
  return patch;
}

std::string text_of(const std::optional<PatchAt>& patch) {
  if (!patch) return "-";
  if (!(patch->id >= 0.0f)) return "none";
  return patch->lod ? fmt::format("{}, lod {}", patch->id, *patch->lod)
                    : fmt::format("{}", patch->id);
}

std::optional<PatchShare> patch_responsible(const PlaneImage& reference,
                                            const PlaneImage& picture) {
  require_one_size(reference, picture);
  const Plane* before = reference.find("id");
  const Plane* now = picture.find("id");
  if (before == nullptr && now == nullptr) return std::nullopt;
  const std::vector<char> differs = differing(reference, picture);
  using Key = std::pair<bool, float>;                          // of the reference; the patch
  std::map<Key, std::pair<std::int64_t, std::size_t>> counts;  // pixels, the first one
  std::int64_t all = 0;
  for (std::size_t k = 0; k < differs.size(); ++k) {
    if (differs[k] == 0) continue;
    ++all;
    const bool is_now = now != nullptr && now->values[k] >= 0.0f;
    if (!is_now && !(before != nullptr && before->values[k] >= 0.0f)) continue;
    auto& [pixels, first] = counts[{!is_now, is_now ? now->values[k] : before->values[k]}];
    if (pixels++ == 0) first = k;
  }
  std::optional<PatchShare> most;
  const auto width = static_cast<std::size_t>(picture.width_px);
  for (const auto& [key, count] : counts) {
    if (most && count.first <= most->pixels) continue;
    const PlaneImage& shown = key.first ? reference : picture;
    const auto patch = patch_at(shown, static_cast<int>(count.second % width),
                                static_cast<int>(count.second / width));
    most = PatchShare{*patch, !key.first, count.first, all};
  }
  return most;
}

}  // namespace plumb::tool
