#include "audit/chart/plain_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <tuple>

#include "audit/chart/camera_paths.h"
#include "audit/chart/scales.h"
#include "audit/chart/winners.h"
#include "core/check.h"
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

std::string plain_claim_chart(const RunTable& table) {
  const std::vector<ClaimMeasure> measures = claim_measures(table);
  require(!measures.empty(), "a chart of claims needs a claim");
  const ClaimMeasure& measure = measures.front();
  PlainPanel empty;
  empty.x_label = fmt::format("Claimed: at most this error ({}), {}", measure.name, measure.unit);
  empty.y_label = fmt::format("Measured error, {}", measure.unit);
  empty.x = empty.y = measure.axis;
  empty.diagonal = true;
  std::vector<PlainPanel> panels = panels_of(table, empty);
  for (const Run& run : table.runs) {
    for (const ClaimedAndMeasured& claim : run.claims) {
      if (claim.measure != measure.name || claim.unit != measure.unit) continue;
      series_of(panels, run.terrain, run.series)
          .points.push_back(
              {empty.x.place(claim.claimed), empty.y.place(claim.measured), run.command});
    }
  }
  return report::plain_svg(panels);
}

namespace {

struct Quantity {
  std::string title, label;
  OpenAxis axis;
  std::function<std::optional<double>(const Run&)> of;
};

std::vector<Quantity> quantities(const RunTable& table, std::size_t cost) {
  std::vector<Quantity> list{
      {"Measured error", "pixels", error_axis(table), [](const Run& run) { return run.error_px; }},
      {kCosts[cost].name, kCosts[cost].unit, cost_axis(table, cost),
       [cost](const Run& run) { return run.costs[cost]; }}};
  if (std::any_of(table.runs.begin(), table.runs.end(),
                  [](const Run& run) { return run.popping_px.has_value(); }))
    list.push_back(
        {"Popping", "pixels", popping_axis(table), [](const Run& run) { return run.popping_px; }});
  return list;
}

// The runs of one path at one tolerance, in the order of frames.
std::vector<const Run*> runs_of(const RunTable& table, const CameraPath& path, const Asked& asked) {
  std::vector<const Run*> runs;
  for (const Run& run : table.runs) {
    const Series& series = table.series[static_cast<std::size_t>(run.series)];
    if (run.on_path && run.error_px && run.terrain == path.terrain && run.camera == path.camera &&
        run.tolerance == asked.value && series.unit == asked.unit)
      runs.push_back(&run);
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Run* a, const Run* b) { return a->frame < b->frame; });
  return runs;
}

report::PlainCell cell_of(const RunTable& table, const std::vector<SeriesLook>& looks,
                          const Winner& winner) {
  if (winner.series < 0) return {{"none kept it", "in all views"}, ""};
  const Series& series = table.series[static_cast<std::size_t>(winner.series)];
  report::PlainCell cell{{series.method, series.name.substr(series.method.size()),
                          fmt::format("asked {:.3g} {}", winner.tolerance, series.unit),
                          fmt::format("{:.6g}", winner.cost)},
                         looks[static_cast<std::size_t>(winner.series)].colour};
  std::erase(cell.lines, "");
  return cell;
}

}  // namespace

std::string plain_path_chart(const RunTable& table, std::size_t cost, std::size_t path) {
  const CameraPath of = paths_of(table).at(path);
  const std::vector<Asked> all = asked_on_paths(table);
  const Asked asked = all.at(first_asked(all));
  std::vector<PlainPanel> panels;
  for (const Quantity& quantity : quantities(table, cost)) {
    PlainPanel panel;
    panel.title = fmt::format("{}, tolerance {:.6g} {}: {}", of.title, asked.value, asked.unit,
                              quantity.title);
    panel.x_label = "Frame of the path";
    panel.y_label = quantity.label;
    panel.x = of.frames;
    panel.y = quantity.axis;
    panel.series = empty_series(table);
    for (const Run* run : runs_of(table, of, asked))
      if (const auto value = quantity.of(*run))
        panel.series[static_cast<std::size_t>(run->series)].curve.push_back(
            {static_cast<double>(run->frame), quantity.axis.place(*value), run->command});
    panels.push_back(std::move(panel));
  }
  return report::plain_svg(panels, 1);
}

std::string plain_winner_chart(const RunTable& table, std::size_t cost) {
  report::PlainGrid grid;
  grid.title = fmt::format("Cheapest by: {}", kCosts[cost].name);
  grid.x_label = "Error in every view at most";
  for (const double limit : kErrorLimits) grid.columns.push_back(fmt::format("{:g} px", limit));
  for (const std::string& kind : kinds_of(table))
    grid.rows.push_back(kind.empty() ? "no kind" : kind);
  grid.cells.resize(grid.rows.size());
  const std::vector<SeriesLook> looks = looks_of(table);
  for (const Winner& winner : winners_of(table, cost))
    grid.cells[static_cast<std::size_t>(winner.kind)].push_back(cell_of(table, looks, winner));
  return report::plain_svg(grid);
}

}  // namespace plumb::audit::chart
