// plumb golden: pictures that must not change, checked, replaced, added and listed.
#include <algorithm>
#include <memory>

#include "common_options.h"
#include "core/check.h"
#include "core/parallel.h"
#include "golden_actions.h"

namespace plumb::tool {
namespace {

// An option that an action has no use for is a misunderstanding.
void require_used(const GoldenOptions& options) {
  struct Given {
    bool given;
    const char* option;
    std::vector<std::string> actions;
  };
  const std::vector<Given> all{
      {!options.name.empty(), "NAME", {"check", "update", "add"}},
      {!options.subject.empty(), "SCENE or PICTURE", {"add"}},
      {!options.actual.empty(), "--actual", {"check", "update"}},
      {options.accept, "--accept", {"update"}},
      {!options.why.empty(), "--why", {"add"}},
      {!options.tolerance.empty(), "--tolerance", {"add"}},
      {options.as_picture, "--as-picture", {"add"}},
      {!options.output.empty(), "-o", {"check", "update"}},
      {!options.junit.empty(), "--junit", {"check"}},
      {options.json, "--json", {"check", "list"}},
  };
  for (const Given& each : all) {
    if (!each.given ||
        std::find(each.actions.begin(), each.actions.end(), options.action) != each.actions.end())
      continue;
    input_error("golden {}: it has no use for {}", options.action, each.option);
  }
}

int run_golden(const GoldenOptions& options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  const std::vector<std::string> actions{"check", "update", "add", "list"};
  if (std::find(actions.begin(), actions.end(), options.action) == actions.end())
    input_error("golden '{}': expected check, update, add or list", options.action);
  require_used(options);
  if (options.action == "check") return golden_check(options, invocation);
  if (options.action == "update") return golden_update(options, invocation);
  return options.action == "add" ? golden_add(options) : golden_list(options, invocation);
}

void declare_options(Options& options, GoldenOptions& values) {
  options.argument(values.action, "ACTION",
                   "check: draw all cases again, or NAME alone; update: replace NAME's reference; "
                   "add: a new case; list: the cases");
  options.optional_argument(values.name, "NAME", "A case");
  options.optional_argument(values.subject, "SCENE|PICTURE",
                            "Of add: a scene (.toml), a picture (.exr) that plumb drew, or a "
                            "picture of another program, which is kept as it is");
  options.group("Golden");
  options.text(values.folder, "--folder", "DIR", "Where manifest.toml is (tests/golden)");
  options.text(values.actual, "--actual", "DIR",
               "Of check and update: where another program wrote its pictures, NAME.exr, NAME.png, "
               "...; what is not there plumb draws, if it has a scene");
  options.flag(values.accept, "--accept", "Of update: replace without asking");
  options.text(values.why, "--why", "SENTENCE", "Of add: what would go unnoticed without it");
  options.text(values.tolerance, "--tolerance", "NAME|FILE",
               "Of add: none (bit for bit), or a profile of plumb compare; a file is looked for in "
               "the manifest's folder (none)");
  options.flag(values.as_picture, "--as-picture",
               "Of add: keep the picture itself, though plumb could draw it");
  options.group("Output");
  add_output_option(options, values.output,
                    "Write the pictures of what is not the same, and a report of each, into this "
                    "folder");
  options.text(values.junit, "--junit", "FILE", "Of check: write the verdicts as JUnit XML");
  add_json_option(options, values.json);
  add_threads_option(options, values.threads);
}

}  // namespace

Command golden_command() {
  Command command;
  command.name = "golden";
  command.summary =
      "Check that pictures did not change, bit for bit or within a tolerance (exit status 1 if one "
      "did); replace, add and list them";
  command.example =
      "plumb render 'generate:alpine?size=129' --size 96x54 -o hill.exr && plumb golden add hill "
      "hill.exr --why 'A first picture.' --folder golden && plumb golden check --folder golden";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<GoldenOptions>();
    declare_options(options, *values);
    return [values](const Invocation& invocation) { return run_golden(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
