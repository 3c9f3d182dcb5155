#include "audit/chart/summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
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

// A picture that was asked of every method.
using View = std::tuple<int, int, int>;  // terrain, camera, frame

// One series at one tolerance over all terrains of a kind.
struct Competitor {
  int series = 0;
  double tolerance = 0.0;
  double worst_px = 0.0;  // over the views
  double cost = 0.0;      // median over the views
};

struct OfKind {
  std::set<View> views;
  std::map<std::pair<int, double>, std::map<View, const Run*>> settings;
};

std::vector<Competitor> competitors(const OfKind& kind, std::size_t cost) {
  std::vector<Competitor> all;
  for (const auto& [setting, runs] : kind.settings) {
    if (runs.size() < kind.views.size()) continue;
    Competitor one{setting.first, setting.second, 0.0, 0.0};
    std::vector<double> costs;
    for (const auto& [view, run] : runs) {
      one.worst_px = std::max(one.worst_px, *run->error_px);
      costs.push_back(*run->costs[cost]);
    }
    one.cost = median(std::move(costs));
    all.push_back(one);
  }
  // The cheapest first; the map's order settles ties.
  std::stable_sort(all.begin(), all.end(),
                   [](const Competitor& a, const Competitor& b) { return a.cost < b.cost; });
  return all;
}

Winner winner_at(double limit_px, int kind, const std::vector<Competitor>& sorted) {
  Winner winner{.kind = kind, .limit_px = limit_px};
  for (const Competitor& one : sorted) {
    if (one.worst_px > limit_px) continue;
    if (winner.series < 0) {
      winner.series = one.series;
      winner.tolerance = one.tolerance;
      winner.cost = one.cost;
    } else if (one.series != winner.series) {
      winner.second = one.series;
      winner.times_cheaper = winner.cost > 0.0 ? one.cost / winner.cost : 0.0;
      break;
    }
  }
  return winner;
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

std::vector<std::string> kinds_of(const RunTable& table) {
  std::vector<std::string> kinds;
  const auto add = [&](const std::string& kind) {
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
  };
  for (const char* usual : {"smooth", "alpine", "urban", "caves"})
    for (const Terrain& terrain : table.terrains)
      if (terrain.kind == usual) add(usual);
  for (const Terrain& terrain : table.terrains) add(terrain.kind);
  return kinds;
}

std::vector<Winner> winners_of(const RunTable& table, std::size_t cost) {
  require(cost < kCosts.size(), "a cost must be one of {}, got {}", kCosts.size(), cost);
  const std::vector<std::string> kinds = kinds_of(table);
  std::vector<OfKind> by_kind(kinds.size());
  for (const Run& run : table.runs) {
    if (!run.error_px || !run.costs[cost]) continue;
    const std::string& kind = table.terrains[static_cast<std::size_t>(run.terrain)].kind;
    OfKind& own = by_kind[static_cast<std::size_t>(std::find(kinds.begin(), kinds.end(), kind) -
                                                   kinds.begin())];
    const View view{run.terrain, run.camera, run.frame};
    own.views.insert(view);
    own.settings[{run.series, run.tolerance}].emplace(view, &run);
  }
  std::vector<Winner> winners;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    const std::vector<Competitor> sorted = competitors(by_kind[kind], cost);
    for (const double limit : kErrorLimits)
      winners.push_back(winner_at(limit, static_cast<int>(kind), sorted));
  }
  return winners;
}

}  // namespace plumb::audit::chart
