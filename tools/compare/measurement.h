// One number that was measured of two pictures, and the limits that such numbers may have.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plumb::compare {

/// What there is to be measured of a group of channels.
struct Metric {
  const char* name;     // "flip_mean"
  const char* unit;     // "px", "dB", "%", "deg"; empty: the channel's own number, or none
  bool more_is_better;  // PSNR, SSIM
  bool has_threshold;   // counts what lies above a threshold, which must be named
  const char* meaning;  // for people, one line
};

/// Groups of channels: "colour" (R G B or Y), "alpha" (A), "depth" (Z), "position" (P.X P.Y P.Z),
/// "normal" (N.X N.Y N.Z), "id", "lod", "coverage" (of depth, else of alpha), and "channel" (each
/// channel by itself); "others": what others' rules measure of the colours, as 8-bit sRGB.
const std::vector<std::string>& metric_groups();
/// What can be measured of a group; nothing for an unknown one.
std::span<const Metric> metrics_of(const std::string& group);
/// Null if there is no such metric.
const Metric* find_metric(const std::string& group, const std::string& name);

/// A metric of these two pictures.
struct Measurement {
  std::string group;    // one of metric_groups()
  std::string channel;  // its name, where the group is "channel"; else empty
  std::string metric;
  std::optional<double> threshold = {};
  std::optional<double> value = {};  // none: the PSNR of equal pictures, which is infinite
  int x = -1, y = -1;                // worst pixel, if there is one

  const Metric& info() const;
  /// "colour.flip_mean", "channel.N.X.largest", "colour.share_over(0.02)".
  std::string name() const;
};

/// What a number may be at most (at least, where more is better).
struct Limit {
  std::string group, channel, metric;  // channel "*": each channel
  std::optional<double> threshold = {};
  double bound = 0.0;

  bool is_about(const Measurement& measurement) const;
  bool holds(const Measurement& measurement) const;
  friend bool operator==(const Limit&, const Limit&) = default;
};

}  // namespace plumb::compare
