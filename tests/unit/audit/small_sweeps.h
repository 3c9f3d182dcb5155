// Sweeps of a made-up method, small enough to be told by head.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "audit/method.h"
#include "audit/sweep/plan.h"
#include "audit/sweep/runner.h"
#include "core/check.h"
#include "mesh/full/full_detail.h"

namespace plumb::audit::sweep {

/// "exact" draws the full detail, in pixels alone, and cannot draw at a tolerance of 13; "refuses"
/// cannot be prepared. Both have the one variant "conservative".
inline MethodTable small_methods(std::atomic<int>* prepared = nullptr) {
  Method exact;
  exact.name = "exact";
  exact.variants = {"conservative"};
  exact.tolerance_units = {Unit::Pixel};
  exact.prepare = [prepared](const terrain::Heightfield& field, const MethodChoice&) {
    if (prepared != nullptr) ++*prepared;
    return adapt(mesh::full::prepare(field),
                 [](const auto& made, const Camera& camera, const Tolerance& tolerance) {
                   if (tolerance.value == 13.0) input_error("thirteen is no tolerance");
                   return mesh::full::draw(made, camera, tolerance);
                 });
  };
  Method refuses = exact;
  refuses.name = "refuses";
  refuses.prepare = [](const terrain::Heightfield&,
                       const MethodChoice&) -> std::unique_ptr<PreparedMethod> {
    input_error("not today");
  };
  return {exact, refuses};
}

inline const std::string kSmallSweep =
    R"(terrains = ["generate:plane?size=5", "generate:step?size=5"]
methods = ["exact"]
tolerances_px = [1, 2, 4]
cameras = ["oblique", "top"]
width = 16
height = 9
)";

inline SweepPlan small_plan(const std::string& text, const MethodTable& table,
                            const std::string& version = "1") {
  return plan_sweep(parse_sweep(text, "sweep.toml", table), table, version);
}

inline std::vector<std::size_t> all_runs(const SweepPlan& plan) { return shard_of(plan, 1, 1); }

/// The lines in the order in which they come.
inline std::vector<std::string> lines_of(const SweepPlan& plan,
                                         const std::vector<std::size_t>& runs,
                                         const MethodTable& table,
                                         const RunnerOptions& options = {}) {
  std::vector<std::string> lines;
  run_sweep(plan, runs, table, options, [&](const std::string& line) { lines.push_back(line); });
  return lines;
}

}  // namespace plumb::audit::sweep
