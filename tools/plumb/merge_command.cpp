// plumb merge: parts of a sweep joined.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "audit/sweep/merge.h"
#include "audit/sweep/result_file.h"
#include "command.h"
#include "common_options.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "sweep_summary.h"

namespace plumb::tool {
namespace {

namespace sweep = audit::sweep;

struct MergeOptions {
  std::vector<std::string> parts;
  std::string output;
  bool json = false;
};

// Places of the scene's order before the last one there that no run has.
std::int64_t gaps(const std::vector<sweep::ResultLine>& lines) {
  return lines.empty() ? 0 : lines.back().index + 1 - static_cast<std::int64_t>(lines.size());
}

int run_merge(const MergeOptions& options, const Invocation& invocation) {
  if (options.output.empty()) input_error("merge needs -o: the file to be written");
  std::vector<sweep::NamedResults> parts;
  for (const std::string& part : options.parts)
    parts.push_back({part, sweep::read_results(part).lines});
  const std::vector<sweep::ResultLine> lines = sweep::merged(parts);
  if (options.output == "-") {
    if (options.json) input_error("-o - and --json cannot both have the standard output");
    std::cout << sweep::joined_text(lines);
    return 0;
  }
  write_file_atomically(options.output, sweep::joined_text(lines));
  const SweepSummary summary = summary_of(lines);
  if (options.json) {
    std::cout << summary_json(summary, "plumb.merge-summary/1", invocation.command_line(),
                              options.output);
    return 0;
  }
  std::cout << summary_text(summary);
  if (gaps(lines) > 0)
    std::cout << fmt::format(
        "{} runs before the last of these are missing: plumb sweep SCENE -o "
        "{} makes them\n",
        gaps(lines), options.output);
  std::cout << fmt::format("written to {}\n", options.output);
  return 0;
}

}  // namespace

Command merge_command() {
  Command command;
  command.name = "merge";
  command.summary = "Join the results of parts of a sweep, in the order of its scene";
  command.example =
      "printf '%s\\n' 'terrains = [\"generate:alpine?size=129\"]' 'methods = [\"slicing\"]' "
      "'tolerances_px = [1, 4]' 'width = 320' 'height = 180' > sweep.toml && plumb sweep "
      "sweep.toml "
      "--shard 1/2 -o part1.jsonl && plumb sweep sweep.toml --shard 2/2 -o part2.jsonl && plumb "
      "merge part1.jsonl part2.jsonl -o all.jsonl";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<MergeOptions>();
    options.arguments(values->parts, "RESULTS", "Files of plumb sweep, parts of the same scene");
    options.group("Output");
    add_output_option(options, values->output, "Write the joined results to this file");
    add_json_option(options, values->json);
    return [values](const Invocation& invocation) { return run_merge(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
