#include "golden_bits.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

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

// The picture has a channel id.
PatchAt patch_of(const PlaneImage& picture, std::size_t pixel) {
  PatchAt patch{picture.find("id")->values.at(pixel)};
  if (const Plane* lod = picture.find("lod")) patch.lod = lod->values.at(pixel);
  return patch;
}

using Owner = std::tuple<bool, float, float>;  // of the reference; patch; level, -1: none
struct Count {
  std::int64_t pixels = 0;
  PatchAt patch;
};

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
  if (picture.find("id") == nullptr) return std::nullopt;
  const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
                         static_cast<std::size_t>(x);
  return patch_of(picture, at);
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
  std::map<Owner, Count> counts;
  std::int64_t all = 0;
  for (std::size_t k = 0; k < differs.size(); ++k) {
    if (differs[k] == 0) continue;
    ++all;
    const bool is_now = now != nullptr && now->values[k] >= 0.0f;
    if (!is_now && !(before != nullptr && before->values[k] >= 0.0f)) continue;
    const PatchAt patch = patch_of(is_now ? picture : reference, k);
    const float lod = patch.lod.value_or(-1.0f);
    Count& count = counts[{!is_now, patch.id, lod >= 0.0f ? lod : -1.0f}];
    if (count.pixels++ == 0) count.patch = patch;
  }
  std::optional<PatchShare> most;
  for (const auto& [owner, count] : counts) {
    if (!most || count.pixels > most->pixels)
      most = PatchShare{count.patch, !std::get<bool>(owner), count.pixels, all};
  }
  return most;
}

}  // namespace plumb::tool
