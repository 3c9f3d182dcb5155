#include "plan_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "text_table.h"

namespace plumb::tool {
namespace {

namespace chart = audit::chart;
namespace plan = audit::plan;
using Json = nlohmann::ordered_json;

std::string short_number(double value) { return fmt::format("{:.3g}", value); }

// Seconds as milliseconds, all else as it is counted.
std::string cost_text(double cost, const chart::CostKind& kind) {
  if (kind.is_time) return fmt::format("{:.3g} ms", 1e3 * cost);
  return cost < 1e6 ? fmt::format("{:.0f}", cost) : fmt::format("{:.3g} million", 1e-6 * cost);
}

std::string times_text(double cost, double best) {
  return best > 0.0 ? fmt::format("{:.3g} x", cost / best) : cost > 0.0 ? "more" : "1 x";
}

class PlanTable {
 public:
  PlanTable(const PlanSubject& subject, const plan::TerrainPlan& plan)
      : subject_(subject), plan_(plan) {}

  void add(const std::string& what, const plan::Worth& worth) {
    const plan::PlannedSetting& setting = plan_.settings[worth.candidate];
    const chart::CostKind& kind = chart::kCosts[subject_.options.cost];
    const double best = plan_.choice.best ? plan_.choice.best->cost : worth.cost;
    rows_.push_back({what, plan::name_of(subject_.table, setting), cost_text(worth.cost, kind),
                     times_text(worth.cost, best), short_number(worth.error),
                     plan_.views[worth.worst_view],
                     worth.triangles > 0.0 ? fmt::format("{:.0f}", worth.triangles) : "-"});
  }
  std::string text() const {
    return text_table({{""},
                       {"setting"},
                       {"cost of a view", true},
                       {"of the choice", true},
                       {"error, px", true},
                       {"worst view"},
                       {"triangles", true}},
                      rows_);
  }

 private:
  const PlanSubject& subject_;
  const plan::TerrainPlan& plan_;
  std::vector<std::vector<std::string>> rows_;
};

std::string view_list(const plan::TerrainPlan& plan) {
  std::string list;
  for (const std::size_t view : plan.held_out)
    list += (list.empty() ? "" : ", ") + plan.views[view];
  return list;
}

std::string held_out_text(const PlanSubject& subject, const plan::TerrainPlan& plan) {
  const plan::Choice& choice = plan.choice;
  if (!choice.best) return "";
  if (plan.held_out.empty()) return "No view was kept out of the search.\n";
  if (!choice.held_out)
    return fmt::format("Kept out of the search, and not measured of it: {}.\n", view_list(plan));
  const bool keeps = choice.held_out->error <= subject.options.error_px;
  return fmt::format("Kept out of the search: {}. The error there is {} px, {}.\n", view_list(plan),
                     short_number(choice.held_out->error),
                     keeps ? "kept too" : "OVER what was asked: the plan does not hold");
}

std::string terrain_text(const PlanSubject& subject, const plan::TerrainPlan& plan) {
  const chart::Terrain& terrain = subject.table.terrains[static_cast<std::size_t>(plan.terrain)];
  const plan::Choice& choice = plan.choice;
  std::string text =
      fmt::format("{} ({}): {} settings in {} views", terrain.name, terrain.kind,
                  choice.candidates + choice.incomplete, plan.views.size() - plan.held_out.size());
  if (choice.incomplete > 0)
    text += fmt::format(", {} of them without an error or that cost in all", choice.incomplete);
  text += "\n";
  PlanTable table(subject, plan);
  if (choice.best) table.add("take", *choice.best);
  if (choice.runner_up) table.add("runner-up", *choice.runner_up);
  for (const plan::Worth& worth : plan.otherwise) table.add("otherwise", worth);
  if (choice.nearest) table.add("nearest", *choice.nearest);
  text += table.text();
  if (!choice.best)
    text += fmt::format("Nothing keeps {} px here.\n", short_number(subject.options.error_px));
  return text + held_out_text(subject, plan);
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json worth_json(const PlanSubject& subject, const plan::TerrainPlan& plan,
                const plan::Worth& worth) {
  const plan::PlannedSetting& setting = plan.settings[worth.candidate];
  const chart::Series& series = subject.table.series[static_cast<std::size_t>(setting.series)];
  const double best = plan.choice.best ? plan.choice.best->cost : 0.0;
  return {{"method", series.method},
          {"variant", series.variant},
          {"parameters", series.parameters},
          {"tolerance", {{"value", setting.tolerance}, {"unit", series.unit}}},
          {"cost", worth.cost},
          {"times", best > 0.0 ? Json(worth.cost / best) : Json(nullptr)},
          {"error_px", number(worth.error)},
          {"worst_view", plan.views[worth.worst_view]},
          {"triangles", worth.triangles}};
}

Json terrain_json(const PlanSubject& subject, const plan::TerrainPlan& plan) {
  const chart::Terrain& terrain = subject.table.terrains[static_cast<std::size_t>(plan.terrain)];
  const plan::Choice& choice = plan.choice;
  const auto one = [&](const std::optional<plan::Worth>& worth) {
    return worth ? worth_json(subject, plan, *worth) : Json(nullptr);
  };
  Json json{{"name", terrain.name},          {"kind", terrain.kind},
            {"settings", choice.candidates}, {"incomplete", choice.incomplete},
            {"choice", one(choice.best)},    {"runner_up", one(choice.runner_up)},
            {"otherwise", Json::array()},    {"nearest", one(choice.nearest)}};
  for (const plan::Worth& worth : plan.otherwise)
    json["otherwise"].push_back(worth_json(subject, plan, worth));
  Json views = Json::array();
  for (const std::size_t view : plan.held_out) views.push_back(plan.views[view]);
  json["held_out"] = {
      {"views", views},
      {"error_px", choice.held_out ? number(choice.held_out->error) : Json(nullptr)}};
  json["shared_times"] = plan.shared_times;
  return json;
}

}  // namespace

std::string plan_text(const PlanSubject& subject) {
  std::string text =
      fmt::format("Cheapest by {} with an error of at most {} px\n",
                  chart::kCosts[subject.options.cost].name, short_number(subject.options.error_px));
  bool shared = false;
  for (const plan::TerrainPlan& plan : subject.plans) {
    text += "\n" + terrain_text(subject, plan);
    shared = shared || plan.shared_times;
  }
  if (shared)
    text += "\nThese times were taken while other runs used the machine (plumb sweep --time).\n";
  return text;
}

std::string plan_json(const PlanSubject& subject) {
  Json json{{"schema", "plumb.plan/1"},
            {"command", subject.command},
            {"error_px", subject.options.error_px},
            {"cost", chart::kCosts[subject.options.cost].key},
            {"met", plan::is_met(subject.plans, subject.options)},
            {"terrains", Json::array()}};
  for (const plan::TerrainPlan& plan : subject.plans)
    json["terrains"].push_back(terrain_json(subject, plan));
  return json.dump(2) + "\n";
}

}  // namespace plumb::tool
