// plumb stability: scenes in which methods fail, and what is measured there.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "audit/method.h"
#include "audit/stability/failure_scene.h"
#include "audit/stability/gallery_page.h"
#include "audit/stability/gallery_text.h"
#include "audit/stability/run_scene.h"
#include "command.h"
#include "common_options.h"
#include "core/check.h"
#include "core/parallel.h"
#include "progress.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

using audit::stability::Scene;
using audit::stability::SceneRun;

struct StabilityOptions {
  std::vector<std::string> names;
  std::string method, output;
  bool list = false, json = false;
  int threads = 0;
};

struct Chosen {
  const Scene* scene;
  std::string method;
};

std::vector<Chosen> chosen_scenes(const StabilityOptions& options) {
  for (const std::string& name : options.names) audit::stability::find_scene(name);
  std::vector<Chosen> chosen;
  for (const Scene& scene : audit::stability::failure_scenes()) {
    const bool is_named =
        std::find(options.names.begin(), options.names.end(), scene.name) != options.names.end();
    if (!options.names.empty() && !is_named) continue;
    for (const std::string& method : scene.methods)
      if (options.method.empty() || method == options.method) chosen.push_back({&scene, method});
  }
  if (chosen.empty())
    input_error("--method {}: none of the scenes named is of this method", options.method);
  return chosen;
}

// Without what changes nothing in it: the threads.
std::string command_of(const StabilityOptions& options) {
  std::string command = "plumb stability";
  for (const std::string& name : options.names) command += " " + name;
  if (!options.method.empty()) command += " --method " + options.method;
  return command + " --json";
}

int list_scenes(const std::vector<Chosen>& chosen) {
  std::vector<std::vector<std::string>> rows;
  for (const Chosen& each : chosen)
    rows.push_back({each.scene->name, each.method, each.scene->fails});
  std::cout << text_table({{"scene"}, {"method"}, {"what should go wrong"}}, rows);
  return 0;
}

// What was stated, and what came, of each that is not as expected.
std::string surprises(const std::vector<SceneRun>& runs) {
  std::string text;
  const auto add = [&](const SceneRun& run, const char* variant,
                       const std::optional<audit::stability::VariantRun>& drawn,
                       const std::optional<audit::stability::Expected>& expected) {
    if (!drawn || drawn->is_as_expected) return;
    text += fmt::format("{}, {}, {}: expected {}; {}{}\n", run.scene->name, run.method, variant,
                        expected_text(*run.scene, *expected),
                        drawn->refused.empty() ? drawn->sentence : "refused: " + drawn->refused,
                        drawn->has_nan ? " A figure is NaN." : "");
  };
  for (const SceneRun& run : runs) {
    add(run, "published", run.published, run.expected_published);
    add(run, "conservative", run.conservative, run.expected_conservative);
  }
  return text;
}

std::string table_of(const std::vector<SceneRun>& runs) {
  std::vector<std::vector<std::string>> rows;
  for (const SceneRun& run : runs) {
    rows.push_back({run.scene->name, run.method,
                    measured_text(run, run.published, run.expected_published),
                    claimed_text(run, run.conservative, run.expected_conservative),
                    measured_text(run, run.conservative, run.expected_conservative),
                    run.is_as_expected() ? "yes" : "NO"});
  }
  return text_table({{"scene"},
                     {"method"},
                     {"published"},
                     {"conservative claims"},
                     {"conservative"},
                     {"as expected"}},
                    rows);
}

int run_stability(const StabilityOptions& options) {
  const ThreadLimit limit(options.threads);
  if (options.output == "-")
    input_error(
        "-o -: stability writes several files, expected a folder (--json prints one object)");
  const std::vector<Chosen> chosen = chosen_scenes(options);
  if (options.list) return list_scenes(chosen);
  Progress progress;
  std::vector<SceneRun> runs;
  for (const Chosen& each : chosen) {
    progress.step(fmt::format("scene {} of {}: {}, {}", runs.size() + 1, chosen.size(),
                              each.scene->name, each.method));
    runs.push_back(run_scene(*each.scene, each.method, !options.output.empty()));
  }
  if (!options.output.empty()) {
    progress.step("writing the page");
    audit::stability::write_gallery_page(options.output, runs);
  }
  progress.finish();
  if (options.json) {
    std::cout << gallery_json(runs, command_of(options));
  } else {
    std::cout << table_of(runs) << "\n" << surprises(runs) << summary_text(runs) << "\n";
    if (!options.output.empty())
      std::cout << "written to " << options.output << ": failures.html failures.md figures\n";
  }
  const bool all = std::all_of(runs.begin(), runs.end(),
                               [](const SceneRun& run) { return run.is_as_expected(); });
  return all ? 0 : 1;
}

}  // namespace

Command stability_command() {
  Command command;
  command.name = "stability";
  command.summary =
      "Draw scenes in which methods fail, and hold what is measured against what was stated of "
      "them "
      "(exit status 1 where it differs)";
  command.example =
      "plumb stability spike-straight-down vertical-walls -o failures\n"
      "  plumb stability --list --method tessellation\n"
      "  plumb stability --method slicing --json";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<StabilityOptions>();
    options.optional_arguments(values->names, "NAME", "Scenes by name; all where none is given");
    std::vector<std::string> methods;
    for (const audit::Method& known : audit::built_in_methods()) methods.push_back(known.name);
    options.choice(values->method, "--method", methods, "Scenes of this method alone");
    options.flag(values->list, "--list", "Print the scenes' names and what should go wrong");
    options.group("Output");
    add_output_option(options, values->output,
                      "Write a picture of each scene, a page and its text into this folder");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation&) { return run_stability(*values); };
  };
  return command;
}

}  // namespace plumb::tool
