#include "audit/chart/scales.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

namespace plumb::audit::chart {
namespace {

// Of Okabe and Ito's colours those that are seen on white and on black paper alike.
constexpr std::array<const char*, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                              "#e69f00", "#56b4e9", "#8a6fd1"};
constexpr std::array<const char*, 8> kShapes{"circle",        "square",        "triangle-up",
                                             "diamond",       "cross",         "triangle-down",
                                             "triangle-left", "triangle-right"};
// Places of the methods that everybody has; others come after them.
constexpr std::array<const char*, 7> kPlaces{
    "chunked", "full",   "hybrid-slicing", "restricted-quadtree",
    "slicing", "stacks", "tessellation"};
constexpr std::array<const char*, 4> kDashes{"", "6 3", "2 2", "9 3 2 3"};

}  // namespace

std::vector<SeriesLook> looks_of(const RunTable& table) {
  std::vector<SeriesLook> looks;
  std::size_t method = 0, variant = 0, others = 0;
  for (std::size_t k = 0; k < table.series.size(); ++k) {
    const std::string& name = table.series[k].method;
    const bool same = k > 0 && name == table.series[k - 1].method;
    const auto place = std::find(kPlaces.begin(), kPlaces.end(), name);
    if (!same)
      method = place != kPlaces.end() ? static_cast<std::size_t>(place - kPlaces.begin())
                                      : kPlaces.size() + others++;
    variant = same ? variant + 1 : 0;
    looks.push_back({kColours[method % kColours.size()], kShapes[method % kShapes.size()],
                     kDashes[variant % kDashes.size()], variant == 0});
  }
  return looks;
}

std::vector<std::size_t> costs_there(const RunTable& table) {
  std::vector<std::size_t> there;
  for (std::size_t cost = 0; cost < kCosts.size(); ++cost) {
    if (std::any_of(table.runs.begin(), table.runs.end(),
                    [&](const Run& run) { return run.error_px && run.costs[cost]; }))
      there.push_back(cost);
  }
  return there;
}

std::size_t first_cost(const RunTable& table) {
  constexpr std::size_t kCpu = 0, kTriangles = 3;
  const std::vector<std::size_t> there = costs_there(table);
  const auto has = [&](std::size_t cost) {
    return std::find(there.begin(), there.end(), cost) != there.end();
  };
  const bool alone = std::any_of(table.runs.begin(), table.runs.end(),
                                 [](const Run& run) { return run.costs[kCpu] && !run.shared; });
  if (alone && has(kCpu)) return kCpu;
  return has(kTriangles) || there.empty() ? kTriangles : there.front();
}

report::OpenAxis popping_axis(const RunTable& table) {
  std::vector<double> values;
  for (const Run& run : table.runs)
    if (run.popping_px) values.push_back(*run.popping_px);
  return report::open_axis(values);
}

report::OpenAxis error_axis(const RunTable& table) {
  std::vector<double> values;
  for (const Run& run : table.runs)
    if (run.error_px) values.push_back(*run.error_px);
  return report::open_axis(values);
}

report::OpenAxis cost_axis(const RunTable& table, std::size_t cost) {
  std::vector<double> values;
  for (const Run& run : table.runs)
    if (run.error_px && run.costs[cost]) values.push_back(*run.costs[cost]);
  return report::open_axis(values);
}

std::vector<ClaimMeasure> claim_measures(const RunTable& table) {
  std::map<std::pair<std::string, std::string>, std::vector<double>> values;
  for (const Run& run : table.runs) {
    for (const ClaimedAndMeasured& claim : run.claims) {
      std::vector<double>& own = values[{claim.measure, claim.unit}];
      own.push_back(claim.claimed);
      own.push_back(claim.measured);
    }
  }
  std::vector<ClaimMeasure> measures;
  for (const auto& [key, own] : values)
    measures.push_back(
        {key.first, key.second, static_cast<int>(own.size() / 2), report::open_axis(own)});
  std::stable_sort(
      measures.begin(), measures.end(), [](const ClaimMeasure& a, const ClaimMeasure& b) {
        return std::tuple(a.unit != "px", -a.claims) < std::tuple(b.unit != "px", -b.claims);
      });
  return measures;
}

}  // namespace plumb::audit::chart
