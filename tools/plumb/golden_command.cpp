// plumb golden: pictures that must not change, checked, replaced and added.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "audit/picture.h"
#include "command.h"
#include "common_options.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "core/parallel.h"
#include "golden_manifest.h"
#include "golden_picture.h"
#include "image/image_files.h"
#include "progress.h"
#include "terrain/generators.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;

struct GoldenOptions {
  std::string action, name, scene;
  std::string folder = "tests/golden";
  std::string why, output;
  bool accept = false;
  bool json = false;
  int threads = 0;
};

std::string check_text(const std::vector<GoldenCheck>& checks) {
  std::vector<std::vector<std::string>> rows;
  std::string details;
  for (const GoldenCheck& check : checks) {
    rows.push_back({check.name, name_of(check.verdict), checksum_digits(check.expected)});
    if (check.verdict == GoldenVerdict::Same) continue;
    details += fmt::format("\n{}: {}\n{}", check.name, check.message, text_of(check.channels));
  }
  return text_table({{"case"}, {"verdict"}, {"checksum"}}, rows) + details;
}

std::string check_json(const std::vector<GoldenCheck>& checks, const Invocation& invocation) {
  nlohmann::ordered_json json{{"schema", "plumb.golden/1"}, {"command", invocation.command_line()}};
  json["cases"] = nlohmann::ordered_json::array();
  for (const GoldenCheck& check : checks) {
    nlohmann::ordered_json entry{{"name", check.name},
                                 {"verdict", name_of(check.verdict)},
                                 {"expected", checksum_digits(check.expected)}};
    if (check.verdict != GoldenVerdict::Failed) entry["found"] = checksum_digits(check.found);
    if (!check.message.empty()) entry["message"] = check.message;
    for (const ChannelDifference& channel : check.channels) {
      nlohmann::ordered_json difference{{"channel", channel.channel}, {"pixels", channel.pixels}};
      difference["largest"] =
          std::isfinite(channel.largest) ? nlohmann::ordered_json(channel.largest) : nullptr;
      entry["channels"].push_back(difference);
    }
    json["cases"].push_back(entry);
  }
  return json.dump(2) + "\n";
}

void write_found(const std::string& output, const std::vector<GoldenCheck>& checks) {
  std::error_code error;
  fs::create_directories(output, error);
  if (error) input_error("cannot make the folder '{}': {}", output, error.message());
  for (const GoldenCheck& check : checks) {
    if (check.verdict == GoldenVerdict::Same || check.picture.size() == 0) continue;
    image::write_exr(fs::path(output) / (check.name + ".exr"), check.picture);
    image::write_png(fs::path(output) / (check.name + ".png"), audit::preview_of(check.picture));
  }
}

int run_check(const GoldenOptions& options, const Invocation& invocation) {
  const GoldenManifest manifest = read_manifest(options.folder);
  require_tidy(manifest);
  std::vector<GoldenCase> cases = manifest.cases;
  if (!options.name.empty()) cases = {find_case(manifest, options.name)};
  if (cases.empty()) input_error("{}: there is no case to check", manifest.path().string());
  Progress progress;
  std::vector<GoldenCheck> checks;
  int different = 0, failed = 0;
  for (const GoldenCase& golden : cases) {
    progress.step("drawing " + golden.name);
    checks.push_back(check_case(manifest, golden));
    const GoldenVerdict verdict = checks.back().verdict;
    failed += verdict == GoldenVerdict::Failed;
    different += verdict != GoldenVerdict::Failed && verdict != GoldenVerdict::Same;
  }
  if (!options.output.empty()) write_found(options.output, checks);
  progress.finish();
  std::cout << (options.json ? check_json(checks, invocation) : check_text(checks));
  if (failed > 0) {
    for (const GoldenCheck& check : checks) {
      if (check.verdict == GoldenVerdict::Failed)
        input_error("{} of {} cases could not be checked: {}: {}", failed, checks.size(),
                    check.name, check.message);
    }
  }
  return different > 0 ? 1 : 0;
}

bool accepted(const GoldenOptions& options) {
  if (options.accept) return true;
  if (::isatty(STDIN_FILENO) != 1 || ::isatty(STDERR_FILENO) != 1) return false;
  std::cout.flush();
  std::cerr << "Replace the reference? Type yes: " << std::flush;
  std::string answer;
  return std::getline(std::cin, answer) && answer == "yes";
}

int run_update(const GoldenOptions& options) {
  if (options.name.empty()) input_error("golden update needs the NAME of a case");
  const GoldenManifest manifest = read_manifest(options.folder);
  const GoldenCheck check = check_case(manifest, find_case(manifest, options.name));
  if (check.verdict == GoldenVerdict::Failed) input_error("{}: {}", check.name, check.message);
  if (check.verdict == GoldenVerdict::Same) {
    std::cout << options.name << ": nothing changes\n";
    return 0;
  }
  std::cout << fmt::format("{}: {}: {}\n{}", check.name, name_of(check.verdict), check.message,
                           text_of(check.channels));
  if (!accepted(options)) {
    std::cout << "not replaced: look at what changes, then give --accept\n";
    return 1;
  }
  write_reference(manifest, options.name, check.picture);
  write_file_atomically(manifest.path(), with_checksum(manifest, options.name, check.found));
  std::cout << "replaced: checksum " << checksum_digits(check.found) << "\n";
  return 0;
}

std::string why_text(const std::string& why, const audit::Scene& scene) {
  const std::string by = scene.painter == audit::Painter::Truth
                             ? "rays through the full-detail surface"
                             : scene.method + ", " + to_text(scene.tolerance);
  return fmt::format(
      "{}\nDrawn by {}; terrain {}.\nA change here is a bug until someone can say "
      "why every pixel of it is right.\n",
      why, by, scene.terrain);
}

// A terrain file's name as the scene in `folder` must say it.
std::string seen_from(const fs::path& folder, const std::string& terrain) {
  if (terrain::is_generator(terrain) || !fs::is_regular_file(terrain)) return terrain;
  return fs::proximate(terrain, folder).string();
}

int run_add(const GoldenOptions& options) {
  if (options.name.empty() || options.scene.empty())
    input_error("golden add needs a NAME and a SCENE (a .toml, or an .exr drawn by plumb)");
  if (options.why.empty()) input_error("golden add needs --why, one sentence");
  const fs::path folder(options.folder);
  const GoldenManifest manifest =
      fs::exists(folder / "manifest.toml") ? read_manifest(folder) : parse_manifest("", folder);
  audit::Scene scene = read_scene_or_picture(options.scene);
  const image::AovImage picture = draw(scene);
  GoldenCase added{options.name, image::raw_checksum(picture), 0, options.why};
  const std::string text = with_case(manifest, added);
  const fs::path target = folder / options.name;
  if (fs::exists(target))
    input_error("{}: is there already, though no case names it", target.string());
  write_reference(manifest, options.name, picture);
  scene.terrain = seen_from(target, scene.terrain);
  write_file_atomically(manifest.scene(options.name), audit::to_toml(scene));
  write_file_atomically(manifest.why(options.name), why_text(options.why, scene));
  write_file_atomically(manifest.path(), text);
  std::cout << fmt::format("{}: added, checksum {}\n", options.name,
                           checksum_digits(added.checksum));
  return 0;
}

int run_golden(const GoldenOptions& options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  if (options.action != "add" && !options.scene.empty())
    input_error("golden {}: unexpected argument '{}'", options.action, options.scene);
  if (options.action == "check") return run_check(options, invocation);
  if (options.action == "update") return run_update(options);
  if (options.action == "add") return run_add(options);
  input_error("golden '{}': expected check, update or add", options.action);
}

}  // namespace

Command golden_command() {
  Command command;
  command.name = "golden";
  command.summary =
      "Check that pictures did not change, bit for bit (exit status 1 if one did); replace and add "
      "them";
  command.example =
      "plumb render 'generate:alpine?size=129' --size 96x54 -o hill.exr && plumb golden add hill "
      "hill.exr --why 'A first picture.' --folder golden && plumb golden check --folder golden";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<GoldenOptions>();
    options.argument(
        values->action, "ACTION",
        "check: draw all cases again, or NAME alone; update: replace NAME's reference; "
        "add: a new case");
    options.optional_argument(values->name, "NAME", "A case");
    options.optional_argument(values->scene, "SCENE",
                              "Of add: a scene (.toml), or a picture (.exr) that plumb drew");
    options.group("Golden");
    options.text(values->folder, "--folder", "DIR", "Where manifest.toml is (tests/golden)");
    options.flag(values->accept, "--accept", "Of update: replace without asking");
    options.text(values->why, "--why", "SENTENCE", "Of add: what would go unnoticed without it");
    options.group("Output");
    add_output_option(options, values->output,
                      "Of check: write the pictures that differ into this folder");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation& invocation) { return run_golden(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
