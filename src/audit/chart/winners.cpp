#include "audit/chart/winners.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "audit/chart/summary.h"
#include "core/check.h"

namespace plumb::audit::chart {
namespace {

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

// The cheapest first; of equal ones the earlier series, then the smaller tolerance.
std::vector<Competitor> competitors(const OfKind& kind, std::size_t cost) {
  std::vector<Competitor> all;
  for (const auto& [setting, runs] : kind.settings) {
    const bool is_whole = std::none_of(
        runs.begin(), runs.end(), [](const auto& run) { return run.second->wrong_pixels > 0.0; });
    if (runs.size() < kind.views.size() || !is_whole) continue;
    Competitor one{setting.first, setting.second, 0.0, 0.0};
    std::vector<double> costs;
    for (const auto& [view, run] : runs) {
      one.worst_px = std::max(one.worst_px, *run->error_px);
      costs.push_back(*run->costs[cost]);
    }
    one.cost = median(std::move(costs));
    all.push_back(one);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Competitor& a, const Competitor& b) { return a.cost < b.cost; });
  return all;
}

std::vector<OfKind> by_kind(const RunTable& table, std::size_t cost) {
  const std::vector<std::string> kinds = kinds_of(table);
  std::vector<OfKind> all(kinds.size());
  for (const Run& run : table.runs) {
    if (!run.error_px || !run.costs[cost]) continue;
    const std::string& kind = table.terrains[static_cast<std::size_t>(run.terrain)].kind;
    OfKind& own =
        all[static_cast<std::size_t>(std::find(kinds.begin(), kinds.end(), kind) - kinds.begin())];
    const View view{run.terrain, run.camera, run.frame};
    own.views.insert(view);
    own.settings[{run.series, run.tolerance}].emplace(view, &run);
  }
  return all;
}

}  // namespace

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

std::vector<Cheapest> cheapest_of(const RunTable& table, std::size_t cost) {
  require(cost < kCosts.size(), "a cost must be one of {}, got {}", kCosts.size(), cost);
  const std::vector<OfKind> kinds = by_kind(table, cost);
  std::vector<Cheapest> cheapest;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    const std::vector<Competitor> sorted = competitors(kinds[kind], cost);
    for (const double limit : kErrorLimits) {
      std::set<int> seen;
      for (const Competitor& one : sorted) {
        if (one.worst_px > limit || !seen.insert(one.series).second) continue;
        cheapest.push_back({static_cast<int>(kind), limit, one.series, one.tolerance, one.cost});
      }
    }
  }
  return cheapest;
}

std::vector<Winner> winners_of(const RunTable& table, std::size_t cost) {
  const std::vector<Cheapest> cheapest = cheapest_of(table, cost);
  const int kinds = static_cast<int>(kinds_of(table).size());
  std::vector<Winner> winners;
  auto one = cheapest.begin();
  for (int kind = 0; kind < kinds; ++kind) {
    for (const double limit : kErrorLimits) {
      Winner winner{.kind = kind, .limit_px = limit};
      for (; one != cheapest.end() && one->kind == kind && one->limit_px == limit; ++one) {
        if (winner.series < 0) {
          winner.series = one->series;
          winner.tolerance = one->tolerance;
          winner.cost = one->cost;
        } else if (winner.second < 0) {
          winner.second = one->series;
          winner.times_cheaper = winner.cost > 0.0 ? one->cost / winner.cost : 0.0;
        }
      }
      winners.push_back(winner);
    }
  }
  return winners;
}

}  // namespace plumb::audit::chart
