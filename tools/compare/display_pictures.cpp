#include "compare/display_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "audit/audit_pictures.h"
#include "core/check.h"
#include "core/parallel.h"
#include "report/heat_map.h"

namespace plumb::compare {
namespace {

// Grey as no colour of a scale is, and lighter than what stands for no value.
constexpr report::Rgb kSkyColour{196, 204, 214};

using Channels = std::array<std::vector<float>, 3>;

std::uint8_t code_of(float display) {
  if (!(display > 0.0f)) return 0;
  return static_cast<std::uint8_t>(std::min(display, 1.0f) * 255.0f + 0.5f);
}

image::Rgb8Image coded(const Channels& display, int width_px, int height_px) {
  image::Rgb8Image picture{width_px, height_px, {}};
  picture.rgb.resize(3 * display[0].size());
  parallel_for(static_cast<std::int64_t>(display[0].size()), 65536, [&](std::int64_t at) {
    const auto k = static_cast<std::size_t>(at);
    for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * k + c] = code_of(display[c][k]);
  });
  return picture;
}

// The channel that stands for a picture without colours: depth, or the first one.
const image::Plane& shown_plane(const image::PlaneImage& picture, const std::string& name) {
  const image::Plane* plane = picture.find(name);
  require(plane != nullptr, "one of the pictures has no channel '{}'", name);
  return *plane;
}

std::string shown_name(const PicturePair& pair) {
  require(!pair.reference.planes.empty(), "a picture without a channel cannot be shown{}", "");
  return pair.reference.find("Z") != nullptr ? "Z" : pair.reference.planes.front().name;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  bool empty() const { return low > high; }
  void add(const std::vector<float>& values) {
    for (const float value : values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, double{value});
      high = std::max(high, double{value});
    }
  }
};

Range common_range(const PicturePair& pair, const std::string& name) {
  Range range;
  range.add(shown_plane(pair.reference, name).values);
  range.add(shown_plane(pair.candidate, name).values);
  return range;
}

// 0 at the range's low end, 1 at its high one; +inf beyond, NaN and -inf black.
std::vector<float> between(const std::vector<float>& values, const Range& range) {
  std::vector<float> display(values.size());
  const double width = range.high > range.low ? range.high - range.low : 1.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    display[k] = std::isfinite(values[k])
                     ? static_cast<float>((double{values[k]} - range.low) / width)
                     : (values[k] > 0.0f ? 1.0f : 0.0f);
  }
  return display;
}

Channels grey(std::vector<float> display) { return {display, display, std::move(display)}; }

Channels colours(const image::PlaneImage& picture) {
  std::vector<std::vector<float>> display = display_colour(picture);
  require(display.size() == 3, "one of the pictures has {} colour channels", display.size());
  return {std::move(display[0]), std::move(display[1]), std::move(display[2])};
}

// What the difference picture subtracts.
std::pair<Channels, Channels> display_channels(const PicturePair& pair) {
  if (!colour_planes(pair.reference).empty())
    return {colours(pair.reference), colours(pair.candidate)};
  const std::string name = shown_name(pair);
  const Range range = common_range(pair, name);
  return {grey(between(shown_plane(pair.reference, name).values, range)),
          grey(between(shown_plane(pair.candidate, name).values, range))};
}

DisplayPair heat_pair(const PicturePair& pair, const std::string& name, const Range& range) {
  report::HeatMapOptions options;
  options.title = "channel " + name;
  options.unit = "";
  options.infinite_name = "sky (infinite)";
  options.infinite_colour = kSkyColour;
  options.text_scale = report::kPageLegendTextScale;
  if (!range.empty()) options.low = range.low;
  if (range.high > options.low) options.high = range.high;
  options.logarithmic = options.low > 0.0 && options.high > 50.0 * options.low;
  const auto values_of = [&](const image::PlaneImage& picture) {
    const std::vector<float>& values = shown_plane(picture, name).values;
    return std::vector<double>(values.begin(), values.end());
  };
  const std::vector<double> reference = values_of(pair.reference);
  return {
      audit::rgb8_of(report::heat_picture(pair.width_px(), pair.height_px(), reference, options)),
      audit::rgb8_of(report::heat_picture(pair.width_px(), pair.height_px(),
                                          values_of(pair.candidate), options)),
      fmt::format("Channel {}, both pictures on one scale.", name),
      audit::rgb8_of(report::heat_legend(report::kPageLegendWidthPx, reference, options))};
}

double largest_difference(const PicturePair& pair, const Channels& a, const Channels& b) {
  double largest = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < a[c].size(); ++k) {
      if (pair.judged(k)) largest = std::max(largest, std::fabs(double{b[c][k]} - double{a[c][k]}));
    }
  }
  return largest;
}

// The strongest power of two that the largest difference survives, at most 64.
double gain_for(double largest) {
  double gain = 1.0;
  while (gain < 64.0 && 2.0 * gain * largest <= 1.0) gain *= 2.0;
  return gain;
}

}  // namespace

DisplayPair display_pair(const PicturePair& pair) {
  if (!colour_planes(pair.reference).empty()) {
    const bool linear = pair.reference.encoding == image::Encoding::Linear;
    return {coded(colours(pair.reference), pair.width_px(), pair.height_px()),
            coded(colours(pair.candidate), pair.width_px(), pair.height_px()),
            linear ? "Linear light, shown as sRGB; above one it is white." : "Colours as stored.",
            {}};
  }
  const std::string name = shown_name(pair);
  const Range range = common_range(pair, name);
  if (name == "Z" && (range.empty() || range.low >= 0.0)) return heat_pair(pair, name, range);
  const auto [reference, candidate] = display_channels(pair);
  return {coded(reference, pair.width_px(), pair.height_px()),
          coded(candidate, pair.width_px(), pair.height_px()),
          range.empty() ? fmt::format("Channel {}, which has no finite number.", name)
                        : fmt::format("Channel {}: black is {:.4g}, white {:.4g}.", name, range.low,
                                      range.high),
          {}};
}

DifferencePicture difference_picture(const PicturePair& pair) {
  const auto channels = display_channels(pair);
  const Channels &a = channels.first, &b = channels.second;
  const double largest = largest_difference(pair, a, b);
  DifferencePicture difference{{pair.width_px(), pair.height_px(), {}}, gain_for(largest), {}};
  difference.picture.rgb.resize(3 * pair.size());
  parallel_for(static_cast<std::int64_t>(pair.size()), 65536, [&](std::int64_t at) {
    const auto k = static_cast<std::size_t>(at);
    if (!pair.judged(k)) return;  // black
    for (std::size_t c = 0; c < 3; ++c) {
      const double apart = difference.gain * (double{b[c][k]} - double{a[c][k]});
      difference.picture.rgb[3 * k + c] =
          static_cast<std::uint8_t>(std::floor(128.5 + 127.0 * std::clamp(apart, -1.0, 1.0)));
    }
  });
  difference.note =
      largest == 0.0
          ? "Candidate minus reference: nothing that can be shown differs."
          : fmt::format(
                "Candidate minus reference, {:.0f} times as strong; grey is equal, brighter "
                "means that the candidate has more.",
                difference.gain);
  return difference;
}

}  // namespace plumb::compare
