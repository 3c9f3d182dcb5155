// plumb golden update: what changes, and only when that is accepted another reference.
#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <optional>

#include "comparison_text.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "golden_actions.h"
#include "golden_picture.h"
#include "golden_text.h"
#include "image/image_files.h"
#include "progress.h"

namespace plumb::tool {
namespace {

bool accepted(const GoldenOptions& options) {
  if (options.accept) return true;
  if (::isatty(STDIN_FILENO) != 1 || ::isatty(STDERR_FILENO) != 1) return false;
  std::cout.flush();
  std::cerr << "Replace the reference? Type yes: " << std::flush;
  std::string answer;
  return std::getline(std::cin, answer) && answer == "yes";
}

// The picture of a case that plumb draws, if another program wrote it: all of it must fit.
image::AovImage as_drawn(const std::filesystem::path& file, std::uint64_t checksum) {
  if (small_extension(file) == ".exr") {
    image::AovImage picture = image::read_exr(file);
    if (image::raw_checksum(picture) == checksum) return picture;
  }
  input_error(
      "{}: the case has a scene, and a reference with plumb's channels alone; a case "
      "without a scene keeps any picture",
      file.string());
}

// The reference first: if the manifest cannot follow, check finds the case stale.
void replace(const GoldenManifest& manifest, const GoldenCheck& check,
             const std::filesystem::path& actual) {
  const std::string text = with_checksum(manifest, check.name, check.found);
  if (check.drawn) {
    write_reference(manifest, check.name, *check.drawn);
  } else if (manifest.is_drawn(check.name)) {
    write_reference(manifest, check.name, as_drawn(actual, check.found));
  } else {
    copy_reference(manifest, check.name, actual, check.found);
  }
  write_file_atomically(manifest.path(), text);
}

void print_changes(const GoldenOptions& options, const GoldenCheck& check) {
  std::cout << case_text(options, check, false);
  if (check.comparison) std::cout << "\n" << comparison_text(*check.comparison);
}

}  // namespace

int golden_update(const GoldenOptions& options, const Invocation& invocation) {
  if (options.name.empty()) input_error("golden update needs the NAME of a case");
  require_place_of_its_own(options);
  const GoldenManifest manifest = read_manifest(options.folder);
  const GoldenCase& golden = find_case(manifest, options.name);
  std::optional<ActualFolder> actual;
  if (!options.actual.empty()) actual = read_actual_folder(options.actual, manifest);
  Progress progress;
  progress.step("checking " + golden.name);
  GoldenCheck check =
      check_case(manifest, golden, actual ? &*actual : nullptr, !options.output.empty());
  const std::filesystem::path picture = check.files.actual;
  if (!options.output.empty() && check.verdict != GoldenVerdict::Same)
    write_case_files(options.output, invocation.command_line(), check);
  progress.finish();
  if (check.verdict == GoldenVerdict::Failed || !check.has_picture())
    input_error("{}: {}", check.name, check.message);
  if (check.verdict == GoldenVerdict::Same) {
    std::cout << options.name << ": nothing changes\n";
    return 0;
  }
  print_changes(options, check);
  if (!accepted(options)) {
    std::cout << "not replaced: look at what changes, then give --accept\n";
    return 1;
  }
  replace(manifest, check, picture);
  std::cout << "replaced: checksum " << checksum_digits(check.found) << "\n";
  return 0;
}

}  // namespace plumb::tool
