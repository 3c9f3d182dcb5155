#include "report/scatter_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/reproducible_math.h"
#include "report/html_page.h"

namespace plumb::report {
namespace {

constexpr double kWidth = 640, kHeight = 480;
constexpr double kLeft = 84, kRight = 616, kTop = 48, kBottom = 412;

// Whole decades, and where a value lies between them.
struct Axis {
  int low = 0, high = 1;  // powers of ten
  double begin = 0.0, end = 1.0;

  double place(double value) const {
    const double decades = reproducible_log(value) / reproducible_log(10.0);
    return begin + (end - begin) * (decades - low) / (high - low);
  }
};

Axis axis_of(const std::vector<double>& values, double begin, double end) {
  Axis axis{0, 1, begin, end};
  if (values.empty()) return axis;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double ten = reproducible_log(10.0);
  axis.low = static_cast<int>(std::floor(reproducible_log(*least) / ten + 1e-9));
  axis.high =
      std::max(axis.low + 1, static_cast<int>(std::ceil(reproducible_log(*most) / ten - 1e-9)));
  return axis;
}

std::string text_at(double x, double y, const std::string& text, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, more,
                     escape_html(text));
}

std::string line(double x0, double y0, double x1, double y1, const std::string& kind) {
  return fmt::format(
      "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind, x0,
      y0, x1, y1);
}

std::string decade(int power) {
  if (power >= 0 && power <= 4) return fmt::format("{:.0f}", reproducible_pow(10.0, power));
  if (power < 0 && power >= -4)
    return fmt::format("{:.{}f}", reproducible_pow(10.0, power), -power);
  return fmt::format("1e{}", power);
}

std::string grid_of(const Axis& x, const Axis& y) {
  std::string svg;
  for (int power = x.low; power <= x.high; ++power) {
    const double at = x.begin + (x.end - x.begin) * (power - x.low) / (x.high - x.low);
    svg += line(at, kTop, at, kBottom, "grid");
    svg += text_at(at, kBottom + 20, decade(power), " text-anchor=\"middle\"");
  }
  for (int power = y.low; power <= y.high; ++power) {
    const double at = y.begin + (y.end - y.begin) * (power - y.low) / (y.high - y.low);
    svg += line(kLeft, at, kRight, at, "grid");
    svg += text_at(kLeft - 8, at + 4, decade(power), " text-anchor=\"end\"");
  }
  return svg;
}

std::string labels_of(const ScatterChart& chart) {
  const double middle_x = 0.5 * (kLeft + kRight), middle_y = 0.5 * (kTop + kBottom);
  return text_at(middle_x, 26, chart.title, " text-anchor=\"middle\" class=\"title\"") +
         text_at(middle_x, kHeight - 20, chart.x_label, " text-anchor=\"middle\"") +
         text_at(
             20, middle_y, chart.y_label,
             fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 20 {:.1f})\"", middle_y));
}

}  // namespace

std::string to_svg(const ScatterChart& chart) {
  std::vector<double> xs, ys;
  for (const ChartPoint& p : chart.points) {
    require(std::isfinite(p.x) && p.x > 0.0 && std::isfinite(p.y) && p.y > 0.0,
            "a chart's points must be finite and above zero, got ({}, {})", p.x, p.y);
    xs.push_back(p.x);
    ys.push_back(p.y);
  }
  if (chart.diagonal) {
    xs.insert(xs.end(), ys.begin(), ys.end());
    ys = xs;
  }
  const Axis x = axis_of(xs, kLeft, kRight), y = axis_of(ys, kBottom, kTop);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" font-family=\"sans-serif\" font-size=\"13\">\n",
      kWidth, kHeight);
  svg +=
      "<style>.grid{stroke:#d8dade} .same{stroke:#888;stroke-dasharray:6 4} .title{font-size:15px}"
      " circle{fill:#1f6f8b;fill-opacity:.6}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  svg += grid_of(x, y) + labels_of(chart);
  if (chart.diagonal) svg += line(kLeft, kBottom, kRight, kTop, "same");
  for (const ChartPoint& p : chart.points) {
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"><title>{}</title></circle>\n",
                       x.place(p.x), y.place(p.y), escape_html(p.label));
  }
  return svg + "</svg>\n";
}

}  // namespace plumb::report
