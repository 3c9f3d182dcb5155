// What a plan of a sweep's results says, terrain by terrain.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "audit/chart/run_table.h"
#include "audit/plan/choice.h"

namespace plumb::audit::plan {

struct PlanOptions {
  double error_px = 1.0;     // that every view must keep, > 0
  std::size_t cost = 0;      // row of chart::kCosts
  std::size_t hold_out = 4;  // of so many views one is kept out of the search; below 2: none
  bool claims_must_hold = true;
};

/// A method, variant and parameters at one tolerance.
struct PlannedSetting {
  int series = 0;  // row of the table
  double tolerance = 0.0;
};

struct TerrainPlan {
  int terrain = 0;                       // row of the table
  std::vector<std::string> views;        // names: "oblique", "flight frame 3"
  std::vector<std::size_t> held_out;     // of these
  std::vector<PlannedSetting> settings;  // the candidates of `choice`
  Choice choice;                         // of settings
  /// What the choice would have cost otherwise, of those that keep the error: the finest setting of
  /// the best one's own method, and `full`, which draws everything.
  std::vector<Worth> otherwise;
  bool shared_times = false;  // the cost is a time, and other runs used the machine meanwhile
};

/// One plan a terrain, in the order of the table. What is measured is the error of
/// docs/formats/sweep-results.md; a run that failed or was skipped is no measurement.
///
/// Throws std::invalid_argument for an error that is not above zero and a cost that there is not.
std::vector<TerrainPlan> plans_of(const chart::RunTable& table, const PlanOptions& options);

/// Every terrain has a choice, and the views held out keep the error too.
bool is_met(const std::vector<TerrainPlan>& plans, const PlanOptions& options);

/// "tessellation, published, at 2 px".
std::string name_of(const chart::RunTable& table, const PlannedSetting& setting);

}  // namespace plumb::audit::plan
