#include "audit/chart/plain_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "audit/chart/chart_data.h"
#include "report/plain_chart.h"

namespace plumb::audit::chart {
namespace {

using report::OpenAxis;
using report::PlainPanel;
using report::PlainPoint;
using report::PlainSeries;

std::vector<PlainSeries> empty_series(const RunTable& table) {
  std::vector<PlainSeries> list;
  const std::vector<SeriesLook> looks = looks_of(table);
  for (std::size_t k = 0; k < table.series.size(); ++k)
    list.push_back({.name = table.series[k].name,
                    .colour = looks[k].colour,
                    .shape = looks[k].shape,
                    .dash = looks[k].dash,
                    .filled = looks[k].filled});
  return list;
}

std::string title_of(const Terrain& terrain) {
  if (terrain.kind.empty() || terrain.kind == terrain.name) return terrain.name;
  return fmt::format("{} ({})", terrain.name, terrain.kind);
}

std::vector<PlainPanel> panels_of(const RunTable& table, const PlainPanel& empty) {
  std::vector<PlainPanel> panels;
  for (const Terrain& terrain : table.terrains) {
    panels.push_back(empty);
    panels.back().title = title_of(terrain);
    panels.back().series = empty_series(table);
  }
  return panels;
}

PlainSeries& series_of(std::vector<PlainPanel>& panels, int terrain, int series) {
  return panels[static_cast<std::size_t>(terrain)].series[static_cast<std::size_t>(series)];
}

}  // namespace

std::string plain_cost_chart(const RunTable& table, const std::vector<Setting>& settings,
                             std::size_t cost) {
  PlainPanel empty;
  empty.x_label = "Measured error, pixels (largest of the picture)";
  empty.y_label = kCosts[cost].name;
  empty.x = error_axis(table);
  empty.y = cost_axis(table, cost);
  std::vector<PlainPanel> panels = panels_of(table, empty);
  for (const Run& run : table.runs) {
    if (!run.error_px || !run.costs[cost]) continue;
    series_of(panels, run.terrain, run.series)
        .points.push_back(
            {empty.x.place(*run.error_px), empty.y.place(*run.costs[cost]), run.command});
  }
  for (const Setting& s : settings) {
    if (!s.error_px || !s.costs[cost]) continue;
    const PlainPoint point{empty.x.place(*s.error_px), empty.y.place(*s.costs[cost]), ""};
    series_of(panels, s.terrain, s.series).curve.push_back(point);
    if (s.on_front[cost]) panels[static_cast<std::size_t>(s.terrain)].front.push_back(point);
  }
  for (PlainPanel& panel : panels)
    std::sort(panel.front.begin(), panel.front.end(), [](const PlainPoint& a, const PlainPoint& b) {
      return std::tuple(a.x, -a.y) < std::tuple(b.x, -b.y);
    });
  return report::plain_svg(panels);
}

}  // namespace plumb::audit::chart
