#include "report/histogram_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/reproducible_math.h"
#include "report/heat_scale.h"
#include "report/html_page.h"

namespace plumb::report {
namespace {

constexpr double kWidth = 640, kHeight = 320;
constexpr double kLeft = 84, kRight = 616, kTop = 44, kBottom = 252;

// Light and dark; a picture within a page follows the viewer's choice by itself.
constexpr const char* kStyle =
    "<style>.paper{fill:#fff} text{fill:#1b1d21} .grid{stroke:#d8dade} .bar{fill:#1f6f8b} "
    ".over{fill:#c8321f} .limit{stroke:#c8321f;stroke-width:2;stroke-dasharray:6 4} "
    ".limit-text{fill:#a32314} .title{font-size:15px}\n"
    "@media (prefers-color-scheme: dark){.paper{fill:#1d2024} text{fill:#e7e8ea} "
    ".grid{stroke:#383c43} .bar{fill:#58a6c4} .over{fill:#ff7466} .limit{stroke:#ff7466} "
    ".limit-text{fill:#ffaca5}}</style>\n";

std::string text_at(double x, double y, const std::string& text, const std::string& more) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, more,
                     escape_html(text));
}

std::string line(double x0, double y0, double x1, double y1, const char* kind) {
  return fmt::format(
      "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind, x0,
      y0, x1, y1);
}

double decades_of(double count) { return reproducible_log(count) / reproducible_log(10.0); }

// Counts run from half of one, so that a single pixel is a bar, to a whole decade.
struct CountAxis {
  int decades = 1;

  double place(double count) const {
    const double low = decades_of(0.5);
    return kBottom + (kTop - kBottom) * (decades_of(count) - low) / (decades - low);
  }
};

CountAxis count_axis(const Histogram& histogram) {
  const std::int64_t most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
  CountAxis axis;
  for (double top = 10.0; top < static_cast<double>(most); top *= 10.0) ++axis.decades;
  return axis;
}

double place_of(const Histogram& histogram, double value) {
  return kLeft + (kRight - kLeft) * std::min(value / histogram.high, 1.0);
}

std::string grid_of(const HistogramChart& chart, const CountAxis& axis) {
  std::string svg;
  double count = 1.0;
  for (int power = 0; power <= axis.decades; ++power, count *= 10.0) {
    const double y = axis.place(count);
    svg += line(kLeft, y, kRight, y, "grid");
    svg += text_at(kLeft - 8, y + 4,
                   power < 6 ? fmt::format("{:.0f}", count) : fmt::format("1e{}", power),
                   " text-anchor=\"end\"");
  }
  for (const Tick& tick : scale_ticks({0.0, chart.histogram.high, false, {}}, 7)) {
    const double x = place_of(chart.histogram, tick.value);
    svg += line(x, kBottom, x, kBottom + 5, "grid");
    svg += text_at(x, kBottom + 20, tick.label + (chart.unit.empty() ? "" : " " + chart.unit),
                   " text-anchor=\"middle\"");
  }
  return svg;
}

std::string bars_of(const HistogramChart& chart, const CountAxis& axis) {
  const Histogram& histogram = chart.histogram;
  const double bins = static_cast<double>(histogram.counts.size());
  std::string svg;
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    const std::int64_t count = histogram.counts[bin];
    if (count == 0) continue;
    const double low = histogram.high * static_cast<double>(bin) / bins;
    const double high = histogram.high * static_cast<double>(bin + 1) / bins;
    const double x = place_of(histogram, low), y = axis.place(static_cast<double>(count));
    svg += fmt::format(
        "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{}"
        "</title></rect>\n",
        chart.limit && low >= *chart.limit ? "over" : "bar", x, y,
        place_of(histogram, high) - x - 0.5, kBottom - y,
        escape_html(fmt::format("{:.4g} to {:.4g} {}: {}", low, high, chart.unit, count)));
  }
  return svg;
}

std::string limit_of(const HistogramChart& chart) {
  if (!chart.limit || !(*chart.limit >= 0.0) || *chart.limit > chart.histogram.high) return "";
  const double x = place_of(chart.histogram, *chart.limit);
  const bool at_right = x > 0.5 * (kLeft + kRight);
  return line(x, kTop, x, kBottom, "limit") +
         text_at(
             at_right ? x - 6 : x + 6, kTop + 12, fmt::format("limit {:.4g}", *chart.limit),
             fmt::format(" class=\"limit-text\" text-anchor=\"{}\"", at_right ? "end" : "start"));
}

std::string labels_of(const HistogramChart& chart) {
  const double middle_x = 0.5 * (kLeft + kRight), middle_y = 0.5 * (kTop + kBottom);
  return text_at(middle_x, 26, chart.title, " text-anchor=\"middle\" class=\"title\"") +
         text_at(middle_x, kHeight - 20, chart.x_label, " text-anchor=\"middle\"") +
         text_at(
             20, middle_y, "pixels",
             fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 20 {:.1f})\"", middle_y));
}

}  // namespace

Histogram histogram_of(std::span<const float> values, int bins) {
  require(bins >= 1, "a histogram needs a bin or more, got {}", bins);
  Histogram histogram;
  histogram.counts.assign(static_cast<std::size_t>(bins), 0);
  float largest = 0.0f;
  for (const float value : values) {
    if (std::isfinite(value)) largest = std::max(largest, value);
  }
  if (largest > 0.0f) histogram.high = double{largest};
  for (const float value : values) {
    if (std::isnan(value)) {
      ++histogram.no_value;
    } else if (!(value > 0.0f)) {
      ++histogram.zero;
    } else if (std::isinf(value)) {
      ++histogram.infinite;
    } else {
      const int bin = static_cast<int>(double{value} / histogram.high * bins);
      ++histogram.counts[static_cast<std::size_t>(std::min(bin, bins - 1))];
    }
  }
  return histogram;
}

std::string to_svg(const HistogramChart& chart) {
  const Histogram& histogram = chart.histogram;
  require(!histogram.counts.empty(), "a histogram needs a bin or more, got {}", 0);
  require(std::isfinite(histogram.high) && histogram.high > 0.0,
          "a histogram's end must be finite and above zero, got {}", histogram.high);
  for (const std::int64_t count : histogram.counts)
    require(count >= 0, "a histogram's counts must be >= 0, got {}", count);
  const CountAxis axis = count_axis(histogram);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 "
             "{0} {1}\" font-family=\"sans-serif\" font-size=\"13\">\n",
             kWidth, kHeight) +
         kStyle + "<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n" +
         grid_of(chart, axis) + bars_of(chart, axis) + limit_of(chart) + labels_of(chart) +
         "</svg>\n";
}

}  // namespace plumb::report
