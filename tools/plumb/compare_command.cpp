// plumb compare: whether two pictures, or two folders of them, are alike, and what is wrong if not.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "command.h"
#include "common_options.h"
#include "compare/comparison_json.h"
#include "compare/comparison_junit.h"
#include "compare/comparison_page.h"
#include "compare/folder_pairs.h"
#include "comparison_text.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "core/parallel.h"
#include "detection_run.h"
#include "progress.h"

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;

struct CompareCommandOptions {
  std::string reference, candidate;
  std::string profile = "default";
  std::string mask, output, junit;
  bool calibrate = false;
  bool detection = false;
  int seeds = 10;
  bool with_others = false;
  bool fast = false;
  bool json = false;
  int threads = 0;
};

int exit_status(compare::CompareVerdict verdict) {
  switch (verdict) {
    case compare::CompareVerdict::Equal:
    case compare::CompareVerdict::Passes:
      return 0;
    case compare::CompareVerdict::Fails:
      return 1;
    case compare::CompareVerdict::None:
      break;
  }
  return 2;
}

compare::CompareOptions compare_options(const CompareCommandOptions& options) {
  compare::CompareOptions result;
  result.everything = !options.fast;
  result.with_maps = !options.output.empty();
  return result;
}

void write_junit(const CompareCommandOptions& options, const std::string& xml) {
  if (options.junit == "-") {
    std::cout << xml;
  } else if (!options.junit.empty()) {
    write_file_atomically(options.junit, xml);
  }
}

int compare_files(const CompareCommandOptions& options, const compare::Profile& profile,
                  const Invocation& invocation) {
  Progress progress;
  progress.step("reading");
  const compare::PicturePair pair =
      compare::read_pair(options.reference, options.candidate, options.mask);
  progress.step("comparing");
  const compare::Comparison comparison =
      compare::compare_pictures(pair, profile, compare_options(options));
  std::vector<std::string> files;
  if (!options.output.empty()) {
    progress.step("writing the report");
    files = compare::write_comparison(options.output, pair, comparison, invocation.command_line());
  }
  write_junit(options, compare::comparison_junit(comparison));
  progress.finish();
  if (options.junit == "-") return exit_status(comparison.verdict);
  if (options.json) {
    std::cout << compare::comparison_json(comparison, invocation.command_line());
  } else {
    std::cout << comparison_text(comparison);
    if (!files.empty())
      std::cout << fmt::format("written to {}: {}\n", options.output, fmt::join(files, " "));
  }
  return exit_status(comparison.verdict);
}

// One pair; what is wrong with its files is kept for later, so that all the others are compared.
void compare_one(const CompareCommandOptions& options, const compare::Profile& profile,
                 const std::string& name, const Invocation& invocation,
                 compare::FolderComparison& folders) {
  try {
    const compare::PicturePair pair =
        compare::read_pair((fs::path(options.reference) / name).string(),
                           (fs::path(options.candidate) / name).string(), options.mask);
    compare::Comparison comparison =
        compare::compare_pictures(pair, profile, compare_options(options));
    if (options.output.empty()) {
      folders.pairs.push_back({name, std::move(comparison)});
    } else {
      folders.pairs.push_back(compare::write_folder_pair(
          options.output, name, pair, std::move(comparison), invocation.command_line()));
    }
  } catch (const InputError& error) {
    folders.errors.push_back({name, error.what()});
  }
}

int compare_folders(const CompareCommandOptions& options, const compare::Profile& profile,
                    const Invocation& invocation) {
  Progress progress;
  compare::FolderFiles files = compare::folder_files(options.reference, options.candidate);
  if (files.both.empty() && files.missing.empty())
    input_error("'{}' and '{}': there is no picture in either", options.reference,
                options.candidate);
  compare::FolderComparison folders;
  folders.reference_name = options.reference;
  folders.candidate_name = options.candidate;
  folders.profile = profile.name;
  folders.missing = std::move(files.missing);
  for (std::size_t k = 0; k < files.both.size(); ++k) {
    progress.step(fmt::format("comparing {} of {}: {}", k + 1, files.both.size(), files.both[k]));
    compare_one(options, profile, files.both[k], invocation, folders);
  }
  if (!options.output.empty())
    compare::write_folder_report(options.output, folders, invocation.command_line());
  write_junit(options, compare::folder_junit(folders));
  progress.finish();
  if (options.junit == "-") return exit_status(folders.verdict());
  if (options.json) {
    std::cout << compare::folder_json(folders, invocation.command_line());
  } else {
    std::cout << folder_text(folders);
    if (!options.output.empty())
      std::cout << fmt::format("written to {}: index.html\n", options.output);
  }
  return exit_status(folders.verdict());
}

int run_compare(const CompareCommandOptions& options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  const compare::Profile profile = compare::find_profile(options.profile);
  if (options.calibrate && options.detection)
    input_error("--calibrate proposes limits, --detection takes a profile as it is: not both");
  if (options.calibrate || options.detection) {
    return run_detection({options.calibrate, options.reference, options.candidate, options.output,
                          options.seeds, options.with_others, options.json},
                         profile, invocation);
  }
  if (options.junit == "-" && options.json)
    input_error("--junit - and --json: there is one standard output");
  if (options.candidate.empty())
    input_error("compare needs a REFERENCE and a CANDIDATE, two pictures or two folders");
  const bool folder = fs::is_directory(options.reference);
  if (folder != fs::is_directory(options.candidate))
    input_error("'{}' is a {}, '{}' is not: expected two pictures or two folders",
                folder ? options.reference : options.candidate, "folder",
                folder ? options.candidate : options.reference);
  if (folder) return compare_folders(options, profile, invocation);
  try {
    return compare_files(options, profile, invocation);
  } catch (const InputError& error) {
    // A test run must not find the verdict of an earlier one.
    if (!options.junit.empty())
      write_junit(options, compare::error_junit(options.candidate, error.what()));
    throw;
  }
}

}  // namespace

Command compare_command() {
  Command command;
  command.name = "compare";
  command.summary =
      "Tell whether two pictures, or two folders of them, are alike, and what is wrong if they are "
      "not (exit status 1)";
  command.example =
      "plumb render 'generate:alpine?size=129' --size 192x108 -o a.exr && plumb render "
      "'generate:alpine?size=129' --size 192x108 --threads 1 -o b.exr && plumb compare a.exr b.exr "
      "-o report";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<CompareCommandOptions>();
    options.optional_argument(values->reference, "REFERENCE", "A picture, or a folder of them");
    options.optional_argument(values->candidate, "CANDIDATE",
                              "The one to be judged, or a folder with the same names");
    options.group("Comparison");
    std::string names;
    for (const compare::Profile& profile : compare::built_in_profiles())
      names += (names.empty() ? "" : ", ") + profile.name;
    options.text(values->profile, "--profile", "NAME|FILE",
                 "What may differ (default): a TOML file, or " + names);
    options.text(
        values->mask, "--mask", "FILE",
        "A picture of the same size: where it is black (below one half), nothing is judged");
    options.flag(values->fast, "--limits-only", "Measure nothing that the profile does not judge");
    options.group("Calibration");
    options.flag(values->calibrate, "--calibrate",
                 "Propose the tightest profile that passes REFERENCE and CANDIDATE (which should "
                 "pass; none: generated scenes), and tell which planted defects it catches");
    options.flag(values->detection, "--detection",
                 "Tell which planted defects the profile catches as it is, in a REFERENCE picture "
                 "or in generated scenes");
    options.integer(values->seeds, "--seeds", "N",
                    "How many times each defect is planted in each scene (10)", 1, 10000);
    options.flag(values->with_others, "--with-others", "Judge by other projects' rules as well");
    options.group("Output");
    add_output_option(options, values->output,
                      "Write a self-contained page, JSON and pictures into this folder; of "
                      "--calibrate: the profile into this .toml file; of --detection: pages of "
                      "what is planted, and planted.png");
    options.text(values->junit, "--junit", "FILE",
                 "Write the verdicts as JUnit XML; - is standard output, in the table's place");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation& invocation) { return run_compare(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
