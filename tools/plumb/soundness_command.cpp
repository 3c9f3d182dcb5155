// plumb soundness: random scenes by one seed, and whether every conservative claim holds in them.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "audit/method.h"
#include "audit/soundness/soundness.h"
#include "command.h"
#include "common_options.h"
#include "core/parallel.h"
#include "progress.h"
#include "soundness_text.h"

namespace plumb::tool {
namespace {

namespace soundness = audit::soundness;

struct SoundnessOptions {
  int draws = 1000, seed = 1, first = 0;
  std::string method;
  bool commands = false, json = false;
  int threads = 0;
};

// What would be audited, and nothing else: a line for each case.
int list_commands(const soundness::Draws& draws) {
  for (std::int64_t k = draws.first; k < draws.first + draws.count; ++k)
    std::cout
        << soundness::audit_command(
               soundness::draw_case(audit::built_in_methods(), draws.seed, k, draws.only).scene)
        << "\n";
  return 0;
}

int run_soundness(const SoundnessOptions& options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  const soundness::Draws draws{static_cast<std::uint64_t>(options.seed), options.first,
                               options.draws, options.method};
  if (options.commands) return list_commands(draws);
  const audit::MethodTable& table = audit::built_in_methods();
  Progress progress;
  const auto results = soundness::run_cases(table, draws, [&](std::int64_t done) {
    progress.step(fmt::format("{} of {} draws", done, draws.count));
  });
  progress.finish();
  const soundness::Summary summary = soundness::summary_of(table, results);
  std::cout << (options.json ? soundness_json(summary, draws, invocation.command_line())
                             : soundness_text(summary));
  return summary.failures.empty() ? 0 : 1;
}

}  // namespace

Command soundness_command() {
  Command command;
  command.name = "soundness";
  command.summary =
      "Audit methods in random scenes, and tell whether every conservative claim holds in all of "
      "them (exit status 1 if not)";
  command.example = "plumb soundness --draws 100 --seed 1";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<SoundnessOptions>();
    options.group("Draws");
    options.integer(values->draws, "--draws", "N", "How many scenes (1000)", 1, 1'000'000);
    options.integer(values->seed, "--seed", "N", "Another seed, other scenes (1)", 0,
                    2'000'000'000);
    options.integer(values->first, "--first", "K", "Begin with this scene of the seed's (0)", 0,
                    2'000'000'000);
    std::vector<std::string> names;
    for (const audit::Method& known : audit::built_in_methods()) names.push_back(known.name);
    options.choice(values->method, "--method", names, "This method alone");
    options.group("Output");
    options.flag(values->commands, "--commands",
                 "Print the command that audits each scene, and run none");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation& invocation) { return run_soundness(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
