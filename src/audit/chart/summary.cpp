#include "audit/chart/summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/check.h"

namespace plumb::audit::chart {
namespace {

std::optional<double> median_of(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(median(values));
}

void mark_fronts(std::span<Setting> of_terrain) {
  for (std::size_t cost = 0; cost < kCosts.size(); ++cost) {
    std::vector<ErrorAndCost> points;
    for (const Setting& s : of_terrain)
      points.push_back({s.error_px.value_or(NAN), s.costs[cost].value_or(NAN)});
    for (const int row : pareto_front(points))
      of_terrain[static_cast<std::size_t>(row)].on_front[cost] = true;
  }
}

Setting summarised(const std::vector<const Run*>& runs) {
  Setting setting;
  setting.terrain = runs.front()->terrain;
  setting.series = runs.front()->series;
  setting.tolerance = runs.front()->tolerance;
  std::vector<double> values;
  for (const Run* run : runs) {
    setting.shared |= run->shared;
    if (run->error_px) values.push_back(*run->error_px);
  }
  setting.error_px = median_of(values);
  setting.runs = static_cast<int>(values.size());
  for (std::size_t cost = 0; cost < kCosts.size(); ++cost) {
    values.clear();
    for (const Run* run : runs)
      if (run->error_px && run->costs[cost]) values.push_back(*run->costs[cost]);
    setting.costs[cost] = median_of(values);
  }
  return setting;
}

}  // namespace

std::vector<int> pareto_front(std::span<const ErrorAndCost> points) {
  std::vector<int> rows;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (std::isfinite(points[k].error) && std::isfinite(points[k].cost))
      rows.push_back(static_cast<int>(k));
  const auto at = [&](int row) -> const ErrorAndCost& {
    return points[static_cast<std::size_t>(row)];
  };
  std::sort(rows.begin(), rows.end(), [&](int a, int b) {
    return std::tuple(at(a).error, at(a).cost, a) < std::tuple(at(b).error, at(b).cost, b);
  });
  std::vector<int> front;
  for (const int row : rows) {
    const bool first = front.empty();
    const bool cheaper = first || at(row).cost < at(front.back()).cost;
    const bool same =
        !first && at(row).cost == at(front.back()).cost && at(row).error == at(front.back()).error;
    if (cheaper || same) front.push_back(row);
  }
  return front;
}

double median(std::vector<double> values) {
  require(!values.empty(), "a median needs a value, got none");
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  if (values.size() % 2 == 1) return values[middle];
  return 0.5 * values[middle - 1] + 0.5 * values[middle];
}

std::vector<Setting> settings_of(const RunTable& table) {
  std::map<std::tuple<int, int, double>, std::vector<const Run*>> groups;
  for (const Run& run : table.runs)
    groups[{run.terrain, run.series, run.tolerance}].push_back(&run);
  std::vector<Setting> settings;
  for (const auto& [key, runs] : groups) settings.push_back(summarised(runs));
  for (std::size_t begin = 0, end = 0; begin < settings.size(); begin = end) {
    while (end < settings.size() && settings[end].terrain == settings[begin].terrain) ++end;
    mark_fronts(std::span(settings).subspan(begin, end - begin));
  }
  return settings;
}

}  // namespace plumb::audit::chart
