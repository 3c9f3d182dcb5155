#include "report/scatter_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "report/html_page.h"

namespace plumb::report {
namespace {

constexpr double kWidth = 640, kLeft = 84, kRight = 616;
constexpr double kFirstRow = 46, kLegendRow = 20, kLegendColumn = 266;  // of the legend
constexpr double kPanelHeight = 200;

// As people of any colour vision can tell them apart (of Okabe and Ito's, those that a line on
// white can have); markers do the same in print.
constexpr std::array<const char*, ScatterChart::kMostSeries> kColours{
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#000000"};

// Of one size around (0, 0): disc, square, triangle, diamond, triangle on its tip, cross.
constexpr std::array<const char*, ScatterChart::kMostSeries> kMarkers{
    "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0Z",
    "M-3.5,-3.5h7v7h-7Z",
    "M0,-4.8L4.6,3.4h-9.2Z",
    "M0,-5.2L4.4,0L0,5.2L-4.4,0Z",
    "M0,4.8L4.6,-3.4h-9.2Z",
    "M-1.3,-4.5h2.6v3.2h3.2v2.6h-3.2v3.2h-2.6v-3.2h-3.2v-2.6h3.2Z"};

// The title's line and the plot's upper and lower side, pixels from the top of the picture.
struct Frame {
  double title, top, bottom;
};

std::string text_at(double x, double y, const std::string& text, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, more,
                     escape_html(text));
}

std::string line(double x0, double y0, double x1, double y1, const std::string& kind) {
  return fmt::format(
      "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind, x0,
      y0, x1, y1);
}

std::string grid_of(const ChartAxis& x, const ChartAxis& y, const Frame& frame) {
  std::string svg;
  for (int tick = x.low; tick <= x.high; ++tick) {
    const double at = x.tick_px(tick);
    svg += line(at, frame.top, at, frame.bottom, "grid");
    svg += text_at(at, frame.bottom + 20, x.tick_text(tick), " text-anchor=\"middle\"");
  }
  for (int tick = y.low; tick <= y.high; ++tick) {
    const double at = y.tick_px(tick);
    svg += line(kLeft, at, kRight, at, "grid");
    svg += text_at(kLeft - 8, at + 4, y.tick_text(tick), " text-anchor=\"end\"");
  }
  return svg;
}

std::string labels_of(const ScatterChart& chart, const Frame& frame) {
  const double middle_x = 0.5 * (kLeft + kRight), middle_y = 0.5 * (frame.top + frame.bottom);
  return text_at(middle_x, frame.title, chart.title, " text-anchor=\"middle\" class=\"title\"") +
         text_at(middle_x, frame.bottom + 48, chart.x_label, " text-anchor=\"middle\"") +
         text_at(
             20, middle_y, chart.y_label,
             fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 20 {:.1f})\"", middle_y));
}

void check_value(double value, AxisKind kind, const char* what) {
  require(std::isfinite(value) && (kind == AxisKind::Linear || value > 0.0),
          "a chart's {} must be finite, and above zero along a logarithmic axis, got {}", what,
          value);
}

// Every point's x and y, checked.
struct Values {
  std::vector<double> xs, ys;
};

Values values_of(const ScatterChart& chart) {
  require(chart.series.size() <= ScatterChart::kMostSeries,
          "a chart must have at most {} series, got {}", ScatterChart::kMostSeries,
          chart.series.size());
  require(!chart.diagonal || chart.x_axis == chart.y_axis,
          "a chart with a diagonal must have axes of one kind");
  Values values;
  const auto add = [&](const std::vector<ChartPoint>& points) {
    for (const ChartPoint& p : points) {
      check_value(p.x, chart.x_axis, "points");
      check_value(p.y, chart.y_axis, "points");
      values.xs.push_back(p.x);
      values.ys.push_back(p.y);
    }
  };
  add(chart.points);
  for (const ChartSeries& series : chart.series) add(series.points);
  if (chart.limit) {
    check_value(*chart.limit, chart.y_axis, "limit");
    values.ys.push_back(*chart.limit);
  }
  if (chart.diagonal) {
    values.xs.insert(values.xs.end(), values.ys.begin(), values.ys.end());
    values.ys = values.xs;
  }
  return values;
}

std::string marker(std::size_t of_series, double x, double y, const std::string& within) {
  return fmt::format("<path d=\"{}\" transform=\"translate({:.1f} {:.1f})\">{}</path>\n",
                     kMarkers[of_series], x, y, within);
}

std::string title_of(const ChartPoint& point) {
  return fmt::format("<title>{}</title>", escape_html(point.label));
}

std::string series_svg(const ChartSeries& series, std::size_t number, const ChartAxis& x,
                       const ChartAxis& y) {
  std::string svg = fmt::format("<g class=\"series-{}\">\n", number);
  if (series.joined && series.points.size() > 1) {
    std::vector<ChartPoint> sorted = series.points;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
    svg += "<polyline points=\"";
    for (std::size_t k = 0; k < sorted.size(); ++k)
      svg += fmt::format("{}{:.1f},{:.1f}", k > 0 ? " " : "", x.place_px(sorted[k].x),
                         y.place_px(sorted[k].y));
    svg += "\"/>\n";
  }
  for (const ChartPoint& p : series.points)
    svg += marker(number, x.place_px(p.x), y.place_px(p.y), title_of(p));
  return svg + "</g>\n";
}

std::string chart_svg(const ScatterChart& chart, const Frame& frame) {
  const Values values = values_of(chart);
  const ChartAxis x = axis_around(chart.x_axis, values.xs, kLeft, kRight),
                  y = axis_around(chart.y_axis, values.ys, frame.bottom, frame.top);
  std::string svg = grid_of(x, y, frame) + labels_of(chart, frame);
  if (chart.diagonal) svg += line(kLeft, frame.bottom, kRight, frame.top, "same");
  if (chart.limit) {
    const double at = y.place_px(*chart.limit);
    svg += line(kLeft, at, kRight, at, "same");
    const double label = at - frame.top < 18.0 ? at + 13.0 : at - 9.0;  // clear of the title
    if (!chart.limit_label.empty()) svg += text_at(kLeft + 6, label, chart.limit_label);
  }
  for (const ChartPoint& p : chart.points)
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\">{}</circle>\n", x.place_px(p.x),
                       y.place_px(p.y), title_of(p));
  for (std::size_t k = 0; k < chart.series.size(); ++k) svg += series_svg(chart.series[k], k, x, y);
  return svg;
}

// Two names a row, from `top` down.
std::string legend_of(const ScatterChart& chart, double top) {
  std::string svg;
  int shown = 0;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    if (chart.series[k].name.empty()) continue;
    const double x = kLeft + kLegendColumn * (shown % 2), y = top + kLegendRow * (shown / 2);
    svg += fmt::format("<g class=\"series-{}\">", k);
    if (chart.series[k].joined)
      svg += fmt::format("<polyline points=\"{0:.1f},{2:.1f} {1:.1f},{2:.1f}\"/>", x, x + 24, y);
    svg += marker(k, x + 12, y, "") + "</g>\n";
    svg += text_at(x + 32, y + 4, chart.series[k].name);
    ++shown;
  }
  return svg;
}

double legend_height(const ScatterChart& chart) {
  const auto named = std::ranges::count_if(
      chart.series, [](const ChartSeries& series) { return !series.name.empty(); });
  return kLegendRow * static_cast<double>((named + 1) / 2);
}

std::string page_of(const ScatterChart& first, double height_px, const std::string& body) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" font-family=\"sans-serif\" font-size=\"13\">\n",
      kWidth, height_px);
  svg +=
      "<style>.grid{stroke:#d8dade} .same{stroke:#888;stroke-dasharray:6 4} .title{font-size:15px}"
      " circle{fill:#1f6f8b;fill-opacity:.6}";
  if (!first.series.empty()) svg += " polyline{fill:none;stroke-width:1.5}";
  for (std::size_t k = 0; k < first.series.size(); ++k)
    svg += fmt::format(" .series-{0} path{{fill:{1}}} .series-{0} polyline{{stroke:{1}}}", k,
                       kColours[k]);
  return svg + "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" + body +
         "</svg>\n";
}

bool same_names(const ScatterChart& a, const ScatterChart& b) {
  return std::ranges::equal(a.series, b.series, {}, &ChartSeries::name, &ChartSeries::name);
}

}  // namespace

std::string to_svg(const ScatterChart& chart) {
  const double legend = legend_height(chart);
  const std::string body =
      chart_svg(chart, {26, 48 + legend, 412 + legend}) + legend_of(chart, kFirstRow);
  return page_of(chart, 480 + legend, body);
}

std::string svg_of_panels(std::span<const ScatterChart> panels) {
  require(!panels.empty(), "a picture of panels must have at least one");
  const double legend = legend_height(panels.front());
  std::string body = legend_of(panels.front(), panels.front().title.empty() ? 20 : kFirstRow);
  double top = legend;
  for (const ScatterChart& panel : panels) {
    require(same_names(panel, panels.front()), "panels must have series of the same names");
    const bool is_first = &panel == &panels.front();
    const double title = top + 26 - (is_first ? legend : 0.0);
    top += panel.title.empty() ? 20 : 44;
    body += chart_svg(panel, {title, top, top + kPanelHeight});
    top += kPanelHeight + (panel.x_label.empty() ? 28 : 64);
  }
  return page_of(panels.front(), top, body);
}

}  // namespace plumb::report
