// A plan for people, and as JSON.
#pragma once

#include <string>
#include <vector>

#include "audit/plan/terrain_plan.h"

namespace plumb::tool {

struct PlanSubject {
  const audit::chart::RunTable& table;
  const std::vector<audit::plan::TerrainPlan>& plans;
  const audit::plan::PlanOptions& options;
  std::string command;  // that makes the plan again
};

/// For each terrain a table: what to take, the runner-up and what the choice would have cost
/// otherwise; then the views held out, and what is wrong with the plan.
std::string plan_text(const PlanSubject& subject);

/// One JSON object, schema "plumb.plan/1":
///
/// met       every terrain has a choice that keeps the error in the views held out too
/// terrains  each with `choice`, `runner_up`, `otherwise` (a list), `nearest` (null unless nothing
///           keeps the error) and `held_out` (views, and the choice's largest error there, null
///           where none is held out); a setting has method, variant, parameters, tolerance, cost
///           (mean over the views), times (its cost over the choice's; null where that is zero),
///           error_px, worst_view, triangles
std::string plan_json(const PlanSubject& subject);

}  // namespace plumb::tool
