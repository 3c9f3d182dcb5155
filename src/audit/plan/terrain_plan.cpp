#include "audit/plan/terrain_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace plumb::audit::plan {
namespace {

constexpr std::size_t kTriangles = 3;  // of chart::kCosts

// Of one terrain: the table's runs by setting and view.
struct Sorted {
  std::map<std::pair<int, int>, std::size_t> views;        // camera and frame
  std::map<std::pair<int, double>, std::size_t> settings;  // series and tolerance
};

std::string view_name(const chart::RunTable& table, const chart::Run& run) {
  const std::string& camera = table.cameras[static_cast<std::size_t>(run.camera)];
  return run.frame > 0 ? fmt::format("{} frame {}", camera, run.frame) : camera;
}

// Views and settings get their numbers in the order of the table.
Sorted sort_into(TerrainPlan& plan, const chart::RunTable& table) {
  Sorted sorted;
  for (const chart::Run& run : table.runs) {
    if (run.terrain != plan.terrain) continue;
    if (sorted.views.try_emplace({run.camera, run.frame}, plan.views.size()).second)
      plan.views.push_back(view_name(table, run));
    if (sorted.settings.try_emplace({run.series, run.tolerance}, plan.settings.size()).second)
      plan.settings.push_back({run.series, run.tolerance});
  }
  return sorted;
}

std::vector<Candidate> candidates_of(TerrainPlan& plan, const Sorted& sorted,
                                     const chart::RunTable& table, std::size_t cost) {
  std::vector<Candidate> candidates;
  for (const PlannedSetting& setting : plan.settings)
    candidates.push_back({name_of(table, setting), {}});
  for (const chart::Run& run : table.runs) {
    if (run.terrain != plan.terrain || !run.error_px || !run.costs[cost]) continue;
    plan.shared_times = plan.shared_times || (chart::kCosts[cost].is_time && run.shared);
    candidates[sorted.settings.at({run.series, run.tolerance})].measurements.push_back(
        {sorted.views.at({run.camera, run.frame}), *run.error_px, *run.costs[cost],
         run.costs[kTriangles].value_or(0.0), run.verdict != "broken"});
  }
  return candidates;
}

// The finest setting of the best one's series that keeps the error, and the baseline that draws
// everything.
std::vector<Worth> alternatives(const TerrainPlan& plan, const chart::RunTable& table) {
  std::vector<Worth> result;
  const Choice& choice = plan.choice;
  if (!choice.best) return result;
  const int series = plan.settings[choice.best->candidate].series;
  const Worth* finest = nullptr;
  const Worth* full = nullptr;
  for (const Worth& worth : choice.fitting) {
    const PlannedSetting& setting = plan.settings[worth.candidate];
    const bool is_finer =
        finest == nullptr || setting.tolerance < plan.settings[finest->candidate].tolerance;
    if (setting.series == series && is_finer) finest = &worth;
    if (full == nullptr && table.series[static_cast<std::size_t>(setting.series)].method == "full")
      full = &worth;
  }
  if (finest != nullptr && finest->candidate != choice.best->candidate) result.push_back(*finest);
  if (full != nullptr && full->candidate != choice.best->candidate) result.push_back(*full);
  return result;
}

// The first series of the same method and variant: its parameters, and the unit of its tolerance,
// make no other way to draw.
std::size_t family_of(const chart::RunTable& table, int series) {
  const chart::Series& own = table.series[static_cast<std::size_t>(series)];
  const auto first =
      std::find_if(table.series.begin(), table.series.end(), [&](const chart::Series& other) {
        return other.method == own.method && other.variant == own.variant;
      });
  return static_cast<std::size_t>(first - table.series.begin());
}

TerrainPlan plan_of(int terrain, const chart::RunTable& table, const PlanOptions& options) {
  TerrainPlan plan;
  plan.terrain = terrain;
  const Sorted sorted = sort_into(plan, table);
  const std::vector<Candidate> candidates = candidates_of(plan, sorted, table, options.cost);
  if (plan.views.empty()) return plan;
  plan.held_out = views_held_out(plan.views.size(), options.hold_out);
  Search search;
  search.error = options.error_px;
  search.views = plan.views.size();
  search.held_out = plan.held_out;
  search.claims_must_hold = options.claims_must_hold;
  for (const PlannedSetting& setting : plan.settings)
    search.family.push_back(family_of(table, setting.series));
  plan.choice = choose(candidates, search);
  plan.otherwise = alternatives(plan, table);
  return plan;
}

}  // namespace

std::vector<TerrainPlan> plans_of(const chart::RunTable& table, const PlanOptions& options) {
  if (!(options.error_px > 0.0)) throw std::invalid_argument("error_px must be above zero");
  if (options.cost >= chart::kCosts.size()) throw std::invalid_argument("there is no such cost");
  std::vector<TerrainPlan> plans;
  for (std::size_t terrain = 0; terrain < table.terrains.size(); ++terrain)
    plans.push_back(plan_of(static_cast<int>(terrain), table, options));
  return plans;
}

bool is_met(const std::vector<TerrainPlan>& plans, const PlanOptions& options) {
  return std::all_of(plans.begin(), plans.end(), [&](const TerrainPlan& plan) {
    const Choice& choice = plan.choice;
    return choice.best && (!choice.held_out || choice.held_out->error <= options.error_px);
  });
}

std::string name_of(const chart::RunTable& table, const PlannedSetting& setting) {
  const chart::Series& series = table.series[static_cast<std::size_t>(setting.series)];
  std::string name = fmt::format("{}, {}", series.method, series.variant);
  if (!series.parameters.empty()) name += fmt::format(" ({})", series.parameters);
  return name + fmt::format(", at {} {}", setting.tolerance, series.unit);
}

}  // namespace plumb::audit::plan
