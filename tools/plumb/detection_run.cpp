#include "detection_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "compare/calibration.h"
#include "compare/detection.h"
#include "compare/folder_pairs.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "progress.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using compare::Channels;
using compare::DetectionRow;
using compare::DetectionTable;

struct Named {
  std::string name;
  DetectionTable table;
};

struct Outcome {
  compare::Calibration calibration;
  std::vector<Named> tables;

  bool good() const {
    return calibration.hopeless.empty() &&
           std::all_of(tables.begin(), tables.end(),
                       [](const Named& each) { return each.table.as_wanted(); });
  }
};

// Noise and jitter of generated scenes: what the built-in profile was calibrated by.
Outcome calibrate_by_scenes(const DetectionRun& run, const compare::Profile& base,
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
  Outcome outcome{calibrator.finish(), {}};
  for (const Channels channels : {Channels::All, Channels::ColoursAlone}) {
    compare::DetectionOptions options;
    options.seeds = run.seeds;
    options.channels = channels;
    options.with_others = run.with_others;
    const std::string name =
        channels == Channels::All ? "all channels" : "colours alone, 8-bit sRGB";
    outcome.tables.push_back({name, compare::detection_power(outcome.calibration.proposed, options,
                                                             [&](const std::string& step) {
                                                               progress.step(name + ": " + step);
                                                             })});
  }
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

Outcome calibrate_by_pairs(const DetectionRun& run, const compare::Profile& base,
                           Progress& progress) {
  const auto pairs = pairs_of(run);
  compare::Calibrator calibrator(base);
  for (const auto& [reference, candidate] : pairs) {
    progress.step("what is harmless: " + candidate);
    calibrator.add(compare::read_pair(reference, candidate));
  }
  Outcome outcome{calibrator.finish(), {}};
  Named named{"defects planted in the references", compare::empty_detection_table(run.with_others)};
  for (const auto& [reference, candidate] : pairs) {
    const image::PlaneImage picture = image::read_planes(reference);
    if (compare::colour_planes(picture).empty()) continue;
    const Channels channels =
        picture.encoding == image::Encoding::Srgb && picture.find("A") == nullptr
            ? Channels::ColoursAlone
            : Channels::All;
    for (int seed = 1; seed <= run.seeds; ++seed) {
      progress.step(fmt::format("defects in {}, seed {} of {}", reference, seed, run.seeds));
      named.table.judge(
          compare::harmed_pictures(picture, static_cast<std::uint64_t>(seed), channels),
          outcome.calibration.proposed);
    }
  }
  outcome.tables.push_back(std::move(named));
  return outcome;
}

std::string limits_text(const compare::Calibration& calibration) {
  std::vector<std::vector<std::string>> rows;
  for (const compare::CalibratedLimit& each : calibration.limits) {
    const compare::Measurement about{each.limit.group, each.limit.channel, each.limit.metric,
                                     each.limit.threshold};
    rows.push_back({about.name(), fmt::format("{:.4g}", each.limit.bound),
                    fmt::format("{:.4g}", each.reached), fmt::format("{:.4g}", each.built_in),
                    each.worst_pair});
  }
  return text_table({{"limit"}, {"proposed", true}, {"reached", true}, {"was", true}, {"by"}},
                    rows);
}

std::string rate_text(int failed, int pictures) {
  return pictures > 0 ? fmt::format("{:.0f} %", 100.0 * failed / pictures) : "-";
}

std::string table_text(const Named& named) {
  std::vector<TextColumn> columns{
      {"planted"}, {"should"}, {"pictures", true}, {"failed", true}, {""}};
  for (const std::string& other : named.table.others) columns.push_back({other, true});
  columns.push_back({"caught by"});
  std::vector<std::vector<std::string>> rows;
  for (const DetectionRow& row : named.table.rows) {
    std::vector<std::string> cells{row.kind->name, row.kind->harmless ? "pass" : "fail",
                                   std::to_string(row.pictures),
                                   rate_text(row.failed, row.pictures),
                                   row.pictures == 0 ? "needs a scene"
                                   : row.as_wanted() ? ""
                                                     : "!"};
    for (const int failed : row.failed_by_others) cells.push_back(rate_text(failed, row.pictures));
    cells.push_back(fmt::format("{}", fmt::join(row.best_checks(2), ", ")));
    rows.push_back(std::move(cells));
  }
  return fmt::format("\n{}\n{}", named.name, text_table(columns, rows));
}

Json table_json(const Named& named) {
  Json json{{"name", named.name}, {"rows", Json::array()}};
  for (const DetectionRow& row : named.table.rows) {
    Json entry{{"planted", row.kind->name},      {"meaning", row.kind->meaning},
               {"harmless", row.kind->harmless}, {"pictures", row.pictures},
               {"failed", row.failed},           {"as_wanted", row.as_wanted()},
               {"caught_by", row.caught_by}};
    for (std::size_t k = 0; k < row.failed_by_others.size(); ++k)
      entry["failed_by_others"][named.table.others[k]] = row.failed_by_others[k];
    json["rows"].push_back(std::move(entry));
  }
  return json;
}

std::string outcome_json(const Outcome& outcome, const Invocation& invocation) {
  Json json{{"schema", "plumb.calibration/1"},
            {"command", invocation.command_line()},
            {"pairs", outcome.calibration.pairs},
            {"cannot_pass", outcome.calibration.hopeless}};
  for (const compare::CalibratedLimit& each : outcome.calibration.limits) {
    const compare::Measurement about{each.limit.group, each.limit.channel, each.limit.metric,
                                     each.limit.threshold};
    const auto number = [](double value) {
      return std::isfinite(value) ? Json(value) : Json(nullptr);
    };
    json["limits"].push_back({{"name", about.name()},
                              {"proposed", each.limit.bound},
                              {"reached", number(each.reached)},
                              {"was", each.built_in},
                              {"by", each.worst_pair}});
  }
  json["profile_toml"] = compare::to_toml(outcome.calibration.proposed);
  for (const Named& named : outcome.tables) json["detection"].push_back(table_json(named));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

int run_detection(const DetectionRun& run, const compare::Profile& base,
                  const Invocation& invocation) {
  if (!run.output.empty() && !run.output.ends_with(".toml"))
    input_error("-o '{}': --calibrate writes a profile, expected a name that ends in .toml",
                run.output);
  Progress progress;
  const Outcome outcome = run.reference.empty() ? calibrate_by_scenes(run, base, progress)
                                                : calibrate_by_pairs(run, base, progress);
  if (!run.output.empty())
    write_file_atomically(run.output, compare::to_toml(outcome.calibration.proposed));
  progress.finish();
  if (run.json) {
    std::cout << outcome_json(outcome, invocation);
    return outcome.good() ? 0 : 1;
  }
  for (const std::string& each : outcome.calibration.hopeless)
    std::cout << "no limit can pass " << each << "\n";
  std::cout << limits_text(outcome.calibration);
  for (const Named& named : outcome.tables) std::cout << table_text(named);
  std::cout << (outcome.good() ? "\nEvery defect is caught, and nothing harmless.\n"
                               : "\nNot as it should be where marked with !\n");
  if (!run.output.empty()) std::cout << "written to " << run.output << "\n";
  return outcome.good() ? 0 : 1;
}

}  // namespace plumb::tool
