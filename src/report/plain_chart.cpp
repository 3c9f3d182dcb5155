#include "report/plain_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/check.h"
#include "report/html_page.h"

namespace plumb::report {
namespace {

constexpr double kWidth = 960, kLeft = 70, kAbove = 34, kBelow = 58, kLegendRow = 20;

// Of one size around (0, 0).
const std::string& path_of(const std::string& shape) {
  static const std::map<std::string, std::string> kPaths{
      {"circle", "M-4.5,0a4.5,4.5 0 1,0 9,0a4.5,4.5 0 1,0 -9,0Z"},
      {"square", "M-4,-4h8v8h-8Z"},
      {"triangle-up", "M0,-5L5,4h-10Z"},
      {"triangle-down", "M0,5L5,-4h-10Z"},
      {"triangle-left", "M-5,0L4,-5v10Z"},
      {"triangle-right", "M5,0L-4,-5v10Z"},
      {"diamond", "M0,-5.5L5,0L0,5.5L-5,0Z"},
      {"cross", "M-1.7,-5h3.4v3.3h3.3v3.4h-3.3v3.3h-3.4v-3.3h-3.3v-3.4h3.3Z"}};
  const auto found = kPaths.find(shape);
  return found != kPaths.end() ? found->second : kPaths.at("circle");
}

// Where a panel's axes lie in the picture.
struct Place {
  const PlainPanel& panel;
  double left, top, width, height;

  double x(double at) const {
    return left + width * (at - panel.x.low) / (panel.x.high - panel.x.low);
  }
  double y(double at) const {
    return top + height * (1.0 - (at - panel.y.low) / (panel.y.high - panel.y.low));
  }
};

std::string text_at(double x, double y, const std::string& text, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, more,
                     escape_html(text));
}

std::string shade(double x0, double y0, double x1, double y1) {
  return fmt::format(
      "<rect class=\"apart\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", x0,
      y0, x1 - x0, y1 - y0);
}

// Zero and infinity are set apart from the logarithmic part.
std::string places_apart(const Place& at) {
  std::string svg;
  const double right = at.left + at.width, bottom = at.top + at.height;
  const OpenAxis &x = at.panel.x, &y = at.panel.y;
  if (x.zero_at) svg += shade(at.left, at.top, at.x(0.5 * (*x.zero_at + x.first)), bottom);
  if (x.infinite_at) svg += shade(at.x(0.5 * (*x.infinite_at + x.last)), at.top, right, bottom);
  if (y.zero_at) svg += shade(at.left, at.y(0.5 * (*y.zero_at + y.first)), right, bottom);
  if (y.infinite_at) svg += shade(at.left, at.top, right, at.y(0.5 * (*y.infinite_at + y.last)));
  return svg;
}

std::string line(double x0, double y0, double x1, double y1, const char* kind) {
  return fmt::format("<path class=\"{}\" d=\"M{:.1f},{:.1f}L{:.1f},{:.1f}\"/>\n", kind, x0, y0, x1,
                     y1);
}

std::string axes_of(const Place& at) {
  const double right = at.left + at.width, bottom = at.top + at.height;
  std::string svg = places_apart(at);
  for (const OpenTick& tick : at.panel.x.ticks) {
    svg += line(at.x(tick.at), at.top, at.x(tick.at), bottom, "grid");
    svg += text_at(at.x(tick.at), bottom + 17, tick.text, " text-anchor=\"middle\"");
  }
  for (const OpenTick& tick : at.panel.y.ticks) {
    svg += line(at.left, at.y(tick.at), right, at.y(tick.at), "grid");
    svg += text_at(at.left - 6, at.y(tick.at) + 4, tick.text, " text-anchor=\"end\"");
  }
  svg += text_at(at.left, at.top - 12, at.panel.title, " class=\"title\"");
  svg +=
      text_at(at.left + 0.5 * at.width, bottom + 38, at.panel.x_label, " text-anchor=\"middle\"");
  const double x = at.left - 50, y = at.top + 0.5 * at.height;
  return svg +
         text_at(
             x, y, at.panel.y_label,
             fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 {:.1f} {:.1f})\"", x, y));
}

std::string title_of(const std::string& label) {
  return label.empty() ? "" : fmt::format("<title>{}</title>", escape_html(label));
}

std::string joined(const Place& at, const std::vector<PlainPoint>& points, bool steps) {
  std::string path;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (steps && k > 0) path += fmt::format("H{:.1f}", at.x(points[k].x));
    path +=
        fmt::format("{}{:.1f},{:.1f}", k == 0 ? "M" : "L", at.x(points[k].x), at.y(points[k].y));
  }
  return path;
}

std::string marker(const PlainSeries& series, double x, double y, double scale,
                   const std::string& more) {
  return fmt::format("<path d=\"{}\" transform=\"translate({:.1f} {:.1f}) scale({})\"{}",
                     path_of(series.shape), x, y, scale, more);
}

std::string large_marker(const PlainSeries& series, double x, double y, const std::string& label) {
  const std::string paint =
      fmt::format(" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\">{}</path>\n",
                  series.filled ? series.colour : "#fff", series.filled ? "#fff" : series.colour,
                  series.filled ? 0.8 : 1.8, title_of(label));
  return marker(series, x, y, 1.0, paint);
}

std::string dashes(const PlainSeries& series) {
  return series.dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", series.dash);
}

std::string panel_svg(const Place& at) {
  std::string svg = axes_of(at);
  if (at.panel.diagonal) {
    const double low = std::max(at.panel.x.low, at.panel.y.low),
                 high = std::min(at.panel.x.high, at.panel.y.high);
    svg += line(at.x(low), at.y(low), at.x(high), at.y(high), "same");
  }
  if (!at.panel.front.empty())
    svg += fmt::format("<path class=\"front\" d=\"{}\"/>\n", joined(at, at.panel.front, true));
  for (const PlainSeries& series : at.panel.series)
    for (const PlainPoint& p : series.points)
      svg += marker(series, at.x(p.x), at.y(p.y), 0.5,
                    fmt::format(" fill=\"{}\" fill-opacity=\".45\">{}</path>\n", series.colour,
                                title_of(p.label)));
  for (const PlainSeries& series : at.panel.series) {
    if (series.curve.size() > 1)
      svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n",
                         joined(at, series.curve, false), series.colour, dashes(series));
    for (const PlainPoint& p : series.curve)
      svg += large_marker(series, at.x(p.x), at.y(p.y), p.label);
  }
  return svg;
}

std::string legend_of(const std::vector<PlainSeries>& series, double top) {
  std::string svg;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const double x = kLeft + 290 * static_cast<double>(k % 3),
                 y = top + kLegendRow * static_cast<double>(k / 3);
    svg += fmt::format("<path d=\"M{:.1f},{:.1f}h30\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n", x,
                       y, series[k].colour, dashes(series[k]));
    svg += large_marker(series[k], x + 15, y, "");
    svg += text_at(x + 38, y + 4, series[k].name);
  }
  return svg;
}

std::string file_of(double height_px, const std::string& body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" font-family=\"sans-serif\" font-size=\"12\">\n<style>.grid{{stroke:#e3e5e8}} "
      ".same{{stroke:#777;stroke-dasharray:6 4}} "
      ".front{{fill:none;stroke:#5b616b;stroke-opacity:.35;stroke-width:7;stroke-linejoin:round}} "
      ".apart{{fill:#5b616b;fill-opacity:.1}} .title{{font-size:14px;font-weight:bold}}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{2}</svg>\n",
      kWidth, height_px, body);
}

}  // namespace

std::string plain_svg(const std::vector<PlainPanel>& panels, int columns) {
  require(!panels.empty() && columns >= 1, "a picture needs a panel and a column, got {} and {}",
          panels.size(), columns);
  const std::size_t across = std::min(static_cast<std::size_t>(columns), panels.size());
  const double each = kWidth / static_cast<double>(across), height = across > 1 ? 270 : 400;
  std::string body;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Place at{panels[k], each * static_cast<double>(k % across) + kLeft,
                   static_cast<double>(k / across) * (kAbove + height + kBelow) + kAbove,
                   each - kLeft - 20, height};
    body += panel_svg(at);
  }
  const double rows = static_cast<double>((panels.size() + across - 1) / across);
  const double below = rows * (kAbove + height + kBelow);
  const std::vector<PlainSeries>& series = panels.front().series;
  return file_of(below + kLegendRow * static_cast<double>((series.size() + 2) / 3) + 12,
                 body + legend_of(series, below + 8));
}

std::string plain_svg(const PlainGrid& grid) {
  constexpr double kRowHeight = 64, kTop = 74;
  const double left = 110, each = (kWidth - left - 12) / static_cast<double>(grid.columns.size());
  std::string body = text_at(12, 22, grid.title, " class=\"title\"");
  body += text_at(left, 44, grid.x_label);
  for (std::size_t c = 0; c < grid.columns.size(); ++c)
    body += text_at(left + each * static_cast<double>(c) + 8, kTop - 8, grid.columns[c]);
  require(grid.rows.size() == grid.cells.size(), "a grid of {} rows needs as many names, got {}",
          grid.cells.size(), grid.rows.size());
  for (std::size_t r = 0; r < grid.rows.size(); ++r) {
    const double y = kTop + kRowHeight * static_cast<double>(r);
    require(grid.cells[r].size() == grid.columns.size(), "a row needs {} cells, got {}",
            grid.columns.size(), grid.cells[r].size());
    body += text_at(12, y + 26, grid.rows[r], " class=\"title\"");
    for (std::size_t c = 0; c < grid.columns.size(); ++c) {
      const PlainCell& cell = grid.cells[r][c];
      const double x = left + each * static_cast<double>(c);
      body += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
          "stroke=\"#e3e5e8\"/>\n",
          x, y, each, kRowHeight);
      if (!cell.colour.empty())
        body += fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"5\" height=\"{:.1f}\" fill=\"{}\"/>\n", x, y,
            kRowHeight, cell.colour);
      for (std::size_t k = 0; k < cell.lines.size(); ++k)
        body += text_at(x + 9, y + 16 + 14 * static_cast<double>(k), cell.lines[k],
                        " font-size=\"10.5\"");
    }
  }
  return file_of(kTop + kRowHeight * static_cast<double>(grid.rows.size()) + 12, body);
}

}  // namespace plumb::report
