// plumb sweep: methods, variants, tolerances and views, each run a line of results.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <set>
#include <string_view>

#include "audit/sweep/merge.h"
#include "audit/sweep/plan.h"
#include "audit/sweep/result_file.h"
#include "audit/sweep/runner.h"
#include "audit/sweep/scene.h"
#include "command.h"
#include "common_options.h"
#include "core/check.h"
#include "core/number_text.h"
#include "core/one_thread.h"
#include "core/parallel.h"
#include "progress.h"
#include "sweep_summary.h"
#include "version.h"

namespace plumb::tool {
namespace {

namespace sweep = audit::sweep;

struct SweepOptions {
  std::string scene, output, shard;
  int repeat = 0;  // 0: not said
  int threads = 0;
  bool timed = false, prune = false, retry = false, json = false;
};

struct Shard {
  int part = 1, parts = 1;
};

Shard parse_shard(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto part = parse_integer(std::string_view(text).substr(0, slash));
    const auto parts = parse_integer(std::string_view(text).substr(slash + 1));
    if (part && parts && *part >= 1 && *part <= *parts && *parts <= 1'000'000)
      return {static_cast<int>(*part), static_cast<int>(*parts)};
  }
  input_error("--shard '{}': expected I/N, part I of N, with I from 1 to N", text);
}

sweep::RunnerOptions runner_options(const SweepOptions& options) {
  constexpr int kTimedDraws = 5;
  sweep::RunnerOptions runner;
  runner.timed = options.timed;
  runner.threads = options.timed ? 1 : options.threads > 0 ? options.threads : available_threads();
  runner.draws = options.repeat > 0 ? options.repeat : options.timed ? kTimedDraws : 1;
  return runner;
}

void require_consistent(const SweepOptions& options) {
  if (options.output.empty())
    input_error("sweep needs -o: the file that gets a line for each run, and is gone on with");
  if (options.output == "-")
    input_error("-o -: a sweep goes on with what stands in its file, expected a file's name");
  if (options.timed && options.threads > 1)
    input_error("--time runs one at a time on one thread: leave --threads out");
}

// What the file holds and the scene has no use for: an error, unless it is to be taken out.
void refuse_others(const SweepOptions& options, const sweep::Resumed& resumed, std::size_t lines) {
  if (options.prune) return;
  if (!resumed.others.empty())
    input_error(
        "{}: {} of its {} runs are none of {} by plumb {} (the first: {}): name another file, or "
        "--prune takes them out",
        options.output, resumed.others.size(), lines, options.scene, version_number(),
        resumed.others.front().run);
  const auto timed = std::find_if(resumed.stale.begin(), resumed.stale.end(),
                                  [](const auto& line) { return line.status == "done"; });
  if (timed != resumed.stale.end())
    input_error(
        "{}: it has runs that were timed while others ran (the first: {}): name another file, or "
        "--prune takes them out, to be run again",
        options.output, timed->run);
}

struct Outcome {
  std::vector<sweep::ResultLine> lines;
  std::size_t ran = 0;
};

// Runs what the file lacks of `wanted`, and puts the file into the plan's order.
Outcome complete(const SweepOptions& options, const sweep::SweepPlan& plan,
                 const std::vector<std::size_t>& wanted) {
  sweep::ResultFile file(options.output);
  const sweep::RerunOptions rerun{options.retry, options.timed};
  sweep::Resumed resumed = sweep::resumed(plan, file.lines(), rerun);
  refuse_others(options, resumed, file.lines().size());
  std::set<std::string> kept;
  for (const sweep::ResultLine& line : resumed.kept) kept.insert(line.key);
  if (kept.size() < file.lines().size()) file.replace(std::move(resumed.kept));
  std::vector<std::size_t> missing;
  std::size_t to_draw = 0;
  for (const std::size_t run : wanted) {
    if (kept.contains(plan.runs[run].key)) continue;
    missing.push_back(run);
    to_draw += plan.runs[run].skipped.empty() ? 1 : 0;
  }
  ProgressBar progress("runs", to_draw);
  sweep::run_sweep(plan, missing, audit::built_in_methods(), runner_options(options),
                   [&](const std::string& line) {
                     file.append(line);
                     if (file.lines().back().status != "skipped") progress.advance();
                   });
  progress.finish();
  std::vector<sweep::ResultLine> ordered = sweep::resumed(plan, file.lines(), {}).kept;
  if (sweep::joined_text(ordered) != sweep::joined_text(file.lines())) file.replace(ordered);
  return {std::move(ordered), missing.size()};
}

int run_sweep_command(const SweepOptions& options, const Invocation& invocation) {
  require_consistent(options);
  const Shard shard = parse_shard(options.shard);
  const ThreadLimit limit(options.timed ? 1 : options.threads);
  sweep::SweepScene scene = sweep::read_sweep_file(options.scene, audit::built_in_methods());
  Progress progress;
  progress.step("reading the terrains");
  const sweep::SweepPlan plan =
      sweep::plan_sweep(std::move(scene), audit::built_in_methods(), version_number());
  progress.finish();
  const Outcome outcome = complete(options, plan, sweep::shard_of(plan, shard.part, shard.parts));
  const SweepSummary summary = summary_of(outcome.lines);
  if (options.json) {
    std::cout << summary_json(summary, "plumb.sweep-summary/1", invocation.command_line(),
                              options.output);
  } else {
    std::cout << summary_text(summary)
              << fmt::format("written to {}: {} of {} runs of the scene, {} of them now\n",
                             options.output, outcome.lines.size(), plan.runs.size(), outcome.ran);
  }
  return summary.failed > 0 ? 1 : 0;
}

}  // namespace

Command sweep_command() {
  Command command;
  command.name = "sweep";
  command.summary =
      "Audit methods, variants, tolerances and views of a scene, a line of results each; goes on "
      "where it was stopped (exit status 1 if a run failed)";
  command.example =
      "printf '%s\\n' 'terrains = [\"generate:alpine?size=129\"]' 'methods = "
      "[\"restricted-quadtree\", \"slicing\"]' 'tolerances_px = [1, 4]' 'width = 320' 'height = "
      "180' > sweep.toml && plumb sweep sweep.toml -o results.jsonl";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<SweepOptions>();
    options.argument(values->scene, "SCENE", "A TOML file: terrains, methods, tolerances, cameras");
    options.group("Sweep");
    options.text(values->shard, "--shard", "I/N", "Run part I of N alone; plumb merge joins parts");
    options.flag(values->timed, "--time",
                 "Run one at a time on one thread, so that times mean something");
    options.integer(values->repeat, "--repeat", "N",
                    "Draw each run N times; times are the median (1; with --time 5)", 1, 10000);
    options.flag(values->retry, "--retry", "Run again what failed before");
    options.flag(values->prune, "--prune",
                 "Take lines out of the file that belong to another scene or version of plumb, or, "
                 "with --time, were timed while others ran");
    options.group("Output");
    add_output_option(options, values->output,
                      "Append a line for each run to this file, and go on with what it has");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return
        [values](const Invocation& invocation) { return run_sweep_command(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
