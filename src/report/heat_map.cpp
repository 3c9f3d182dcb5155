#include "report/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"
#include "report/bitmap_font.h"

namespace plumb::report {
namespace {

constexpr Rgb kPaper{250, 250, 250};
constexpr Rgb kInk{24, 24, 28};

// A word or a few of a legend, with a swatch of colour before it where it explains one.
struct Item {
  std::string text;
  std::optional<Rgb> swatch;
};

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

std::vector<Item> caption_items(const HeatSummary& summary, const HeatMapOptions& options) {
  std::vector<Item> items;
  if (!options.title.empty()) items.push_back({options.title, {}});
  items.push_back(
      {summary.finite == 0
           ? std::string("no values")
           : "max " + with_unit(fmt::format("{:.4g}", summary.largest_finite), options.unit),
       {}});
  return items;
}

std::vector<Item> key_items(const HeatSummary& summary, const HeatScale& scale,
                            const HeatMapOptions& options) {
  std::vector<Item> items;
  if (scale.limit) {
    items.push_back(
        {fmt::format("over {}: {}", with_unit(fmt::format("{:.4g}", *scale.limit), options.unit),
                     summary.over_limit),
         kOverLimitColour});
  }
  if (summary.infinite > 0)
    items.push_back(
        {fmt::format("{}: {}", options.infinite_name, summary.infinite), options.infinite_colour});
  if (summary.no_value > 0)
    items.push_back({fmt::format("no value: {}", summary.no_value), kNoValueColour});
  return items;
}

// Writes downwards, line by line; with no image it only measures.
class LegendWriter {
 public:
  LegendWriter(RgbImage* image, int width, int scale)
      : image_(image), width_(width), scale_(scale), y_(margin()) {}

  int margin() const { return 4 * scale_; }
  int bottom() const { return y_; }

  // Items side by side, a new line where one does not fit.
  void items(const std::vector<Item>& list) {
    if (list.empty()) return;
    const int line = kTextLineHeight * scale_;
    int x = margin();
    for (const Item& item : list) {
      const int swatch = item.swatch ? 10 * scale_ : 0;
      const int needed = swatch + text_width_px(item.text, scale_);
      if (x > margin() && x + needed > width_ - margin()) {
        x = margin();
        y_ += line;
      }
      if (image_ && item.swatch)
        image_->fill(x, y_, kGlyphRows * scale_, kGlyphRows * scale_, *item.swatch);
      if (image_) draw_text(*image_, x + swatch, y_, item.text, kInk, scale_);
      x += needed + 3 * kGlyphAdvance * scale_;
    }
    y_ += line;
  }

  void bar(const HeatScale& scale, const std::string& unit) {
    const int x0 = margin(), columns = std::max(1, width_ - 2 * margin()), rows = 8 * scale_;
    if (image_) {
      for (int x = 0; x < columns; ++x) {
        const double position = columns > 1 ? static_cast<double>(x) / (columns - 1) : 0.0;
        image_->fill(x0 + x, y_, 1, rows, scale_colour(position));
      }
      ticks(scale, unit, x0, columns, y_ + rows);
    }
    y_ += rows + 3 * scale_ + kTextLineHeight * scale_ + 2 * scale_;
  }

 private:
  void ticks(const HeatScale& scale, const std::string& unit, int x0, int columns, int y) {
    const int widest_label = kGlyphAdvance * (9 + static_cast<int>(unit.size())) * scale_;
    const std::vector<Tick> list = scale_ticks(scale, std::max(2, columns / widest_label + 1));
    int free_from = 0;
    for (const Tick& tick : list) {
      const int x = x0 + static_cast<int>(
                             std::floor(scale_position(scale, tick.value) * (columns - 1) + 0.5));
      image_->fill(x, y, scale_, 2 * scale_, kInk);
      const std::string label = with_unit(tick.label, unit);
      const int wide = text_width_px(label, scale_);
      const int left = std::max(std::min(x - wide / 2, width_ - margin() - wide), margin());
      if (left < free_from) continue;  // its neighbour's label is in the way
      draw_text(*image_, left, y + 3 * scale_, label, kInk, scale_);
      free_from = left + wide + kGlyphAdvance * scale_;
    }
  }

  RgbImage* image_;
  int width_, scale_, y_;
};

int write_legend(RgbImage* image, int width, const HeatSummary& summary, const HeatScale& scale,
                 const HeatMapOptions& options) {
  const int text_scale =
      options.text_scale > 0 ? options.text_scale : std::clamp(width / 400, 1, 6);
  LegendWriter writer(image, width, text_scale);
  writer.items(caption_items(summary, options));
  writer.bar(scale, options.unit);
  writer.items(key_items(summary, scale, options));
  return writer.bottom() + writer.margin() - 2 * text_scale;
}

void require_size(int width, int height, std::span<const double> values) {
  require(width >= 1 && height >= 1, "a picture needs a pixel or more, got {} x {}", width, height);
  require(values.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
          "a picture of {} x {} needs as many values, got {}", width, height, values.size());
}

}  // namespace

HeatScale heat_scale(std::span<const double> values, const HeatMapOptions& options) {
  require(std::isfinite(options.low) && options.low >= 0.0,
          "a heat map's low end must be finite and >= 0, got {}", options.low);
  require(options.high == 0.0 || (std::isfinite(options.high) && options.high > options.low),
          "a heat map's high end must be finite and above its low end {}, got {}", options.low,
          options.high);
  HeatScale scale{options.low, options.high, options.logarithmic, options.limit};
  if (scale.limit && !std::isfinite(*scale.limit)) scale.limit.reset();
  if (scale.high == 0.0 && scale.limit) scale.high = *scale.limit;
  if (scale.high == 0.0) scale.high = summarise(values, {}).largest_finite;
  if (scale.logarithmic && scale.low == 0.0 && scale.high > 0.0) scale.low = scale.high / 1000.0;
  if (!(scale.high > scale.low)) {
    if (scale.logarithmic && scale.low == 0.0) scale.low = 0.001;
    scale.high = scale.low + 1.0;
  }
  return scale;
}

RgbImage heat_picture(int width, int height, std::span<const double> values,
                      const HeatMapOptions& options) {
  require_size(width, height, values);
  const HeatScale scale = heat_scale(values, options);
  RgbImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double value = values[image.offset(x, y) / 3];
      const bool is_infinite = std::isinf(value) && value > 0.0;
      image.set(x, y, is_infinite ? options.infinite_colour : heat_colour(scale, value));
    }
  }
  return image;
}

RgbImage heat_legend(int width, std::span<const double> values, const HeatMapOptions& options) {
  require(width >= 1, "a legend needs a pixel or more, got {}", width);
  const HeatScale scale = heat_scale(values, options);
  const HeatSummary summary = summarise(values, scale.limit);
  RgbImage image(width, write_legend(nullptr, width, summary, scale, options), kPaper);
  write_legend(&image, width, summary, scale, options);
  return image;
}

RgbImage heat_map(int width, int height, std::span<const double> values,
                  const HeatMapOptions& options) {
  RgbImage picture = heat_picture(width, height, values, options);
  const RgbImage legend = heat_legend(width, values, options);
  picture.rgb.insert(picture.rgb.end(), legend.rgb.begin(), legend.rgb.end());
  picture.height += legend.height;
  return picture;
}

}  // namespace plumb::report
