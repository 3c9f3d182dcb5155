#include "detection_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "compare/calibration.h"
#include "compare/comparison_page.h"
#include "compare/defect_sheet.h"
#include "compare/detection.h"
#include "compare/folder_pairs.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "detection_text.h"
#include "image/image_files.h"
#include "progress.h"

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;
using compare::Channels;

Channels channels_of(const image::PlaneImage& picture) {
  return picture.encoding == image::Encoding::Srgb && picture.find("A") == nullptr
             ? Channels::ColoursAlone
             : Channels::All;
}

// What a profile catches in generated scenes, with both kinds of channels.
std::vector<NamedTable> tables_of_scenes(const DetectionRun& run, const compare::Profile& profile,
                                         Progress& progress) {
  std::vector<NamedTable> tables;
  for (const Channels channels : {Channels::All, Channels::ColoursAlone}) {
    compare::DetectionOptions options;
    options.seeds = run.seeds;
    options.channels = channels;
    options.with_others = run.with_others;
    const std::string name =
        channels == Channels::All ? "all channels" : "colours alone, 8-bit sRGB";
    tables.push_back(
        {name, compare::detection_power(profile, options, [&](const std::string& step) {
           progress.step(name + ": " + step);
         })});
  }
  return tables;
}

// What it catches of the defects planted in pictures.
NamedTable table_of_pictures(const DetectionRun& run, const std::vector<std::string>& references,
                             const compare::Profile& profile, Progress& progress) {
  NamedTable named{"defects planted in the references",
                   compare::empty_detection_table(run.with_others)};
  for (const std::string& reference : references) {
    const image::PlaneImage picture = image::read_planes(reference);
    if (compare::colour_planes(picture).empty()) continue;
    const Channels channels = channels_of(picture);
    for (int seed = 1; seed <= run.seeds; ++seed) {
      progress.step(fmt::format("defects in {}, seed {} of {}", reference, seed, run.seeds));
      named.table.judge(
          compare::harmed_pictures(picture, static_cast<std::uint64_t>(seed), channels), profile,
          fmt::format("{}, seed {}", reference, seed));
    }
  }
  return named;
}

// Noise and jitter of generated scenes: what the built-in profile was calibrated by.
DetectionOutcome calibrate_by_scenes(const DetectionRun& run, const compare::Profile& base,
                                     Progress& progress) {
  const compare::DetectionOptions defaults;
  compare::Calibrator calibrator(base);
  for (int seed = 1; seed <= run.seeds; ++seed) {
    for (const std::string& terrain : defaults.terrains) {
      progress.step(fmt::format("what is harmless: {}, seed {} of {}", terrain, seed, run.seeds));
      compare::PlantedSceneOptions options;
      options.terrain = terrain;
      options.seed = static_cast<std::uint64_t>(seed);
      const compare::PlantedScene scene(options);
      for (const Channels channels : {Channels::All, Channels::ColoursAlone}) {
        for (compare::HarmedPicture& each :
             compare::harmless_pictures(scene, options.seed, channels)) {
          calibrator.add({"reference",
                          fmt::format("{} of {}, seed {}", each.kind->name, terrain, seed),
                          std::move(each.reference),
                          std::move(each.picture),
                          {}});
        }
      }
    }
  }
  DetectionOutcome outcome{calibrator.finish(), {}};
  outcome.tables = tables_of_scenes(run, outcome.calibration->proposed, progress);
  return outcome;
}

std::vector<std::pair<std::string, std::string>> pairs_of(const DetectionRun& run) {
  if (run.candidate.empty())
    input_error("--calibrate needs a REFERENCE and a CANDIDATE that should pass, or neither");
  if (!fs::is_directory(run.reference)) return {{run.reference, run.candidate}};
  std::vector<std::pair<std::string, std::string>> pairs;
  const compare::FolderFiles files = compare::folder_files(run.reference, run.candidate);
  for (const compare::MissingFile& each : files.missing)
    input_error("'{}' is {}", each.name, compare::missing_text(each));
  for (const std::string& name : files.both)
    pairs.emplace_back((fs::path(run.reference) / name).string(),
                       (fs::path(run.candidate) / name).string());
  return pairs;
}

DetectionOutcome calibrate_by_pairs(const DetectionRun& run, const compare::Profile& base,
                                    Progress& progress) {
  const auto pairs = pairs_of(run);
  compare::Calibrator calibrator(base);
  for (const auto& [reference, candidate] : pairs) {
    progress.step("what is harmless: " + candidate);
    calibrator.add(compare::read_pair(reference, candidate));
  }
  DetectionOutcome outcome{calibrator.finish(), {}};
  std::vector<std::string> references;
  for (const auto& pair : pairs) references.push_back(pair.first);
  outcome.tables.push_back(
      table_of_pictures(run, references, outcome.calibration->proposed, progress));
  return outcome;
}

// Pictures with every kind of defect, of the reference or of one generated scene, as tables have
// them.
std::vector<compare::HarmedPicture> planted_once(const DetectionRun& run) {
  std::vector<compare::HarmedPicture> planted;
  if (run.reference.empty()) {
    planted = harmed_pictures(compare::PlantedScene({}), 1, Channels::ColoursAlone);
  } else {
    const image::PlaneImage picture = image::read_planes(run.reference);
    planted = harmed_pictures(picture, 1, channels_of(picture));
  }
  const compare::DefectKind* first = compare::defect_kinds().data();
  std::stable_sort(planted.begin(), planted.end(),
                   [&](const auto& a, const auto& b) { return a.kind - first < b.kind - first; });
  return planted;
}

// The page of what is planted, and a sheet of what finds it.
void write_planted(const DetectionRun& run, const compare::Profile& profile,
                   const Invocation& invocation, Progress& progress) {
  compare::FolderComparison folder;
  folder.reference_name = run.reference.empty() ? "a generated scene" : run.reference;
  folder.candidate_name = "planted defects";
  folder.profile = profile.name;
  std::vector<compare::SheetRow> rows;
  for (compare::HarmedPicture& each : planted_once(run)) {
    progress.step(fmt::format("the page of {}", each.kind->name));
    const compare::PicturePair pair{
        "reference", each.kind->name, std::move(each.reference), std::move(each.picture), {}};
    compare::Comparison comparison = compare_pictures(pair, profile);
    const char* wanted = each.kind->harmless == comparison.passes() ? "" : " - WRONG";
    rows.push_back(sheet_row(
        fmt::format("{}: {}{}", each.kind->name, comparison.passes() ? "passes" : "fails", wanted),
        pair, comparison));
    folder.pairs.push_back(write_folder_pair(run.output, each.kind->name, pair,
                                             std::move(comparison), invocation.command_line()));
  }
  write_folder_report(run.output, folder, invocation.command_line());
  image::write_png(fs::path(run.output) / "planted.png", compare::sheet_of(rows));
}

// The profile as it is.
DetectionOutcome detect(const DetectionRun& run, const compare::Profile& profile,
                        const Invocation& invocation, Progress& progress) {
  if (!run.candidate.empty() || fs::is_directory(run.reference))
    input_error("--detection plants defects in one REFERENCE picture, or in generated scenes");
  if (!run.output.empty()) {
    make_folder(run.output);
    write_planted(run, profile, invocation, progress);
  }
  if (run.reference.empty()) return {{}, tables_of_scenes(run, profile, progress)};
  return {{}, {table_of_pictures(run, {run.reference}, profile, progress)}};
}

}  // namespace

int run_detection(const DetectionRun& run, const compare::Profile& base,
                  const Invocation& invocation) {
  Progress progress;
  if (!run.calibrate) {
    const DetectionOutcome outcome = detect(run, base, invocation, progress);
    progress.finish();
    std::cout << (run.json ? detection_json(outcome, invocation.command_line())
                           : detection_text(outcome));
    if (!run.json && !run.output.empty())
      std::cout << fmt::format("written to {}: index.html planted.png\n", run.output);
    return outcome.good() ? 0 : 1;
  }
  if (!run.output.empty() && !run.output.ends_with(".toml"))
    input_error("-o '{}': --calibrate writes a profile, expected a name that ends in .toml",
                run.output);
  const DetectionOutcome outcome = run.reference.empty() ? calibrate_by_scenes(run, base, progress)
                                                         : calibrate_by_pairs(run, base, progress);
  if (!run.output.empty())
    write_file_atomically(run.output, compare::to_toml(outcome.calibration->proposed));
  progress.finish();
  if (run.json) {
    std::cout << detection_json(outcome, invocation.command_line());
  } else {
    std::cout << detection_text(outcome);
    if (!run.output.empty()) std::cout << "written to " << run.output << "\n";
  }
  return outcome.good() ? 0 : 1;
}

}  // namespace plumb::tool
