// plumb plan: the cheapest way to draw that measurably keeps an error.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "audit/plan/terrain_plan.h"
#include "audit/sweep/merge.h"
#include "audit/sweep/plan.h"
#include "audit/sweep/result_file.h"
#include "audit/sweep/runner.h"
#include "audit/sweep/scene.h"
#include "command.h"
#include "common_options.h"
#include "core/check.h"
#include "core/one_thread.h"
#include "core/parallel.h"
#include "plan_text.h"
#include "progress.h"
#include "version.h"

namespace plumb::tool {
namespace {

namespace chart = audit::chart;
namespace plan = audit::plan;
namespace sweep = audit::sweep;

constexpr int kTimedDraws = 3;

struct PlanCommandOptions {
  std::string scene, results;
  std::string error = "1px";
  std::string cost = "draw-cpu";
  int hold_out = 4;
  bool any_claims = false;
  bool json = false;
  int threads = 0;
};

// "draw-cpu" for "draw_cpu_s": words of the command line have hyphens, and no units of results.
std::string cost_word(const chart::CostKind& kind) {
  std::string word = kind.key;
  if (kind.is_time) word.resize(word.size() - 2);
  std::replace(word.begin(), word.end(), '_', '-');
  return word;
}

std::string cost_words() {
  std::string words;
  for (const chart::CostKind& kind : chart::kCosts)
    words += (words.empty() ? "" : ", ") + cost_word(kind);
  return words;
}

plan::PlanOptions plan_options(const PlanCommandOptions& options) {
  plan::PlanOptions result;
  const Tolerance error = parse_tolerance(options.error);
  if (error.unit != Unit::Pixel || !(error.value > 0.0))
    input_error("--error '{}': expected pixels above zero, as in 1px", options.error);
  result.error_px = error.value;
  result.hold_out = static_cast<std::size_t>(options.hold_out);
  result.claims_must_hold = !options.any_claims;
  for (result.cost = 0; result.cost < chart::kCosts.size(); ++result.cost) {
    if (options.cost == cost_word(chart::kCosts[result.cost])) return result;
  }
  input_error("--cost '{}': expected one of {}", options.cost, cost_words());
}

// Runs the scene: one run at a time where the cost is a time, else as many as there are threads.
std::string measured(const PlanCommandOptions& options, bool timed) {
  const ThreadLimit limit(timed ? 1 : options.threads);
  sweep::SweepScene scene = sweep::read_sweep_file(options.scene, audit::built_in_methods());
  Progress reading;
  reading.step("reading the terrains");
  const sweep::SweepPlan runs =
      sweep::plan_sweep(std::move(scene), audit::built_in_methods(), version_number());
  reading.finish();
  std::vector<std::size_t> wanted;
  for (std::size_t k = 0; k < runs.runs.size(); ++k) {
    if (runs.runs[k].skipped.empty()) wanted.push_back(k);
  }
  if (wanted.empty()) input_error("{}: no method of it draws any of its terrains", options.scene);
  sweep::RunnerOptions runner;
  runner.timed = timed;
  runner.threads = timed ? 1 : options.threads > 0 ? options.threads : available_threads();
  runner.draws = timed ? kTimedDraws : 1;
  ProgressBar progress("runs", wanted.size());
  std::vector<std::string> lines;
  sweep::run_sweep(runs, wanted, audit::built_in_methods(), runner, [&](const std::string& line) {
    lines.push_back(line);
    progress.advance();
  });
  progress.finish();
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return sweep::joined_text(
      sweep::resumed(runs, sweep::parse_results(text, options.scene).lines, {}).kept);
}

int run_plan(const PlanCommandOptions& options, const Invocation& invocation) {
  if (options.scene.empty() == options.results.empty())
    input_error("plan needs a SCENE to be measured, or --results of a sweep, one of the two");
  const plan::PlanOptions wanted = plan_options(options);
  const chart::RunTable table =
      options.results.empty()
          ? chart::parse_runs(measured(options, chart::kCosts[wanted.cost].is_time), options.scene)
          : chart::read_runs(options.results);
  const std::vector<plan::TerrainPlan> plans = plan::plans_of(table, wanted);
  const PlanSubject subject{table, plans, wanted, invocation.command_line()};
  std::cout << (options.json ? plan_json(subject) : plan_text(subject));
  return plan::is_met(plans, wanted) ? 0 : 1;
}

}  // namespace

Command plan_command() {
  Command command;
  command.name = "plan";
  command.summary =
      "Find the cheapest method, variant and tolerance that measurably keeps an error over the "
      "views of a scene (exit status 1 if none does)";
  command.example =
      "printf '%s\\n' 'terrains = [\"generate:alpine?size=129\"]' 'methods = [\"full\", "
      "\"restricted-quadtree\", \"tessellation\"]' 'tolerances_px = [0.5, 1, 2, 4]' 'cameras = "
      "[\"oblique\", \"valley\", \"top\"]' 'width = 320' 'height = 180' > scene.toml && plumb plan "
      "scene.toml --error 1px";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<PlanCommandOptions>();
    options.optional_argument(
        values->scene, "SCENE",
        "A TOML file as plumb sweep takes it: what there is to choose from, and views");
    options.group("Plan");
    options.text(values->error, "--error", "Npx", "Largest error that a view may have (1px)");
    options.text(values->cost, "--cost", "COST", "What shall be least (draw-cpu): " + cost_words());
    options.integer(values->hold_out, "--hold-out", "N",
                    "Keep one view of N out of the search, and measure the choice there; 0: none",
                    0, 10000);
    options.flag(values->any_claims, "--any-claims",
                 "Choose settings that broke a claim of their own too");
    options.text(values->results, "--results", "FILE",
                 "Choose by what plumb sweep measured, in place of runs of its own");
    options.group("Output");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation& invocation) { return run_plan(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
