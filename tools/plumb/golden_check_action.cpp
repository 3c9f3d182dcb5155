// plumb golden check.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <optional>

#include "core/atomic_file.h"
#include "core/check.h"
#include "golden_actions.h"
#include "golden_text.h"
#include "progress.h"

namespace plumb::tool {
namespace {

// What could not be checked, in a line; empty if all could.
std::string errors_in(const GoldenManifest& manifest, const std::vector<GoldenCheck>& checks,
                      const std::vector<std::string>& strays) {
  int failed = 0;
  const GoldenCheck* first = nullptr;
  for (const GoldenCheck& check : checks) {
    if (check.verdict != GoldenVerdict::Failed) continue;
    if (failed++ == 0) first = &check;
  }
  std::vector<std::string> errors;
  if (failed > 0)
    errors.push_back(fmt::format("{} of {} cases could not be checked: {}: {}", failed,
                                 checks.size(), first->name, first->message));
  if (!strays.empty())
    errors.push_back(
        fmt::format("{}: no case names {}", manifest.path().string(), fmt::join(strays, ", ")));
  return fmt::format("{}", fmt::join(errors, "; "));
}

}  // namespace

int golden_check(const GoldenOptions& options, const Invocation& invocation) {
  require_place_of_its_own(options);
  const GoldenManifest manifest = read_manifest(options.folder);
  std::vector<GoldenCase> cases = manifest.cases;
  if (!options.name.empty()) cases = {find_case(manifest, options.name)};
  if (cases.empty()) input_error("{}: there is no case to check", manifest.path().string());
  std::vector<std::string> strays = stray_files(manifest);
  std::optional<ActualFolder> actual;
  if (!options.actual.empty()) actual = read_actual_folder(options.actual, manifest);
  if (actual) strays.insert(strays.end(), actual->strays.begin(), actual->strays.end());
  Progress progress;
  std::vector<GoldenCheck> checks;
  bool all_pass = true;
  for (const GoldenCase& golden : cases) {
    progress.step("checking " + golden.name);
    checks.push_back(
        check_case(manifest, golden, actual ? &*actual : nullptr, !options.output.empty()));
    GoldenCheck& check = checks.back();
    if (!options.output.empty() && check.verdict != GoldenVerdict::Same)
      write_case_files(options.output, invocation.command_line(), check);
    check.drop_pixels();
    all_pass = all_pass && check.passes();
  }
  if (!options.junit.empty())
    write_file_atomically(options.junit, check_junit(options, checks, strays));
  progress.finish();
  std::cout << (options.json ? check_json(options, checks, strays, invocation.command_line())
                             : check_text(options, checks, strays));
  const std::string errors = errors_in(manifest, checks, strays);
  if (!errors.empty()) input_error("{}", errors);
  return all_pass ? 0 : 1;
}

}  // namespace plumb::tool
