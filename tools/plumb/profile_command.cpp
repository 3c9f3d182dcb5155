// plumb profile: how fast this machine is, for the cost model of slices and polygons.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>
#include <tuple>

#include "audit/profile_file.h"
#include "command.h"
#include "common_options.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"
#include "progress.h"
#include "report/scatter_chart.h"
#include "slicing/profile_measure.h"
#include "terrain/camera_presets.h"
#include "text_table.h"
#include "version.h"

namespace plumb::tool {
namespace {

struct ProfileOptions {
  TerrainOptions terrain;
  std::string size = "640x360", name = "measured", output, table, chart;
  int views = 0, threads = 0;
  bool json = false;
};

// Views from everywhere around and above the terrain, the same ones for everybody.
Camera view_of(const terrain::Heightfield& field, int number, const ImageSize& size) {
  const Box box = terrain::bounds(field);
  const glm::dvec3 middle = field.world_origin_m() + 0.5 * (box.low + box.high),
                   extent = box.high - box.low;
  const double turn = 2.399963229728653 * number;  // the golden angle: no direction comes twice
  const double away = 0.15 + 0.85 * ((number * 7) % 10) / 10.0;
  const double height = 0.02 + 0.6 * ((number * 3) % 10) / 10.0;
  LookAt look;
  look.eye_m = middle + glm::dvec3(away * extent.x * reproducible_cos(turn),
                                   away * extent.y * reproducible_sin(turn),
                                   0.5 * extent.z + height * std::max(extent.x, extent.y));
  look.target_m = middle;
  look.width_px = size.width_px;
  look.height_px = size.height_px;
  return make_camera(look);
}

struct Measured {
  slicing::ProfileMeasurement speeds;
  slicing::CostProfile profile;
  std::vector<slicing::ModelledFrame> frames;
};

Measured measure(const ProfileOptions& options, Progress& progress) {
  const ImageSize size = parse_size(options.size);
  progress.step("reading the terrain");
  const terrain::Heightfield field = load(options.terrain);
  const slicing::SlicingTree tree(field, terrain::parse_diagonal(options.terrain.diagonal));
  progress.step("drawing polygons and slices");
  Measured measured;
  measured.speeds = slicing::measure_profile(
      tree,
      make_camera(terrain::preset_camera(field, "oblique", size.width_px, size.height_px, 50.0)));
  measured.profile = measured.speeds.profile(options.name);
  for (int k = 0; k < options.views; ++k) {
    progress.step(fmt::format("view {} of {}", k + 1, options.views));
    measured.frames.push_back(
        slicing::model_frame(tree, view_of(field, k, size), measured.profile));
  }
  return measured;
}

std::string table_of(const std::vector<slicing::ModelledFrame>& frames) {
  std::string text = "view,predicted_s,measured_s\n";
  for (std::size_t k = 0; k < frames.size(); ++k)
    text += fmt::format("{},{},{}\n", k, frames[k].predicted_s, frames[k].measured_s);
  return text;
}

report::ScatterChart chart_of(const ProfileOptions& options, const Measured& measured) {
  report::ScatterChart chart;
  chart.title = fmt::format("How well the cost model foretells {} views", options.views);
  chart.x_label = "measured, s";
  chart.y_label = fmt::format("predicted by profile '{}', s", options.name);
  chart.diagonal = true;
  for (std::size_t k = 0; k < measured.frames.size(); ++k) {
    const slicing::ModelledFrame& frame = measured.frames[k];
    if (!(frame.predicted_s > 0.0 && frame.measured_s > 0.0)) continue;  // sees nothing
    chart.points.push_back({frame.measured_s, frame.predicted_s,
                            fmt::format("view {}: {:.4g} s measured, {:.4g} s predicted", k,
                                        frame.measured_s, frame.predicted_s)});
  }
  return chart;
}

std::vector<std::string> write_files(const ProfileOptions& options, const Measured& measured) {
  std::vector<std::string> files;
  if (!options.output.empty()) {
    const std::string text = audit::to_toml(
        measured.profile,
        {fmt::format("plumb {}, {} threads, {}, {} pixels", version_number(),
                     options.threads > 0 ? options.threads : std::thread::hardware_concurrency(),
                     options.terrain.terrain, options.size),
         "Slices and polygons are chosen by these: another profile draws another "
         "picture."});
    if (options.output == "-") {
      std::cout << text;
    } else {
      write_file_atomically(options.output, text);
      files.push_back(options.output);
    }
  }
  if (!options.table.empty()) {
    write_file_atomically(options.table, table_of(measured.frames));
    files.push_back(options.table);
  }
  if (!options.chart.empty()) {
    write_file_atomically(options.chart, report::to_svg(chart_of(options, measured)));
    files.push_back(options.chart);
  }
  return files;
}

void print(const ProfileOptions& options, const Measured& measured,
           const std::vector<std::string>& files) {
  const slicing::ModelQuality quality = slicing::quality_of(measured.frames);
  if (options.json) {
    nlohmann::ordered_json json{{"schema", "plumb.profile/1"},
                                {"name", measured.profile.name},
                                {"vertices_per_s", measured.profile.vertices_per_s},
                                {"pixels_per_s", measured.profile.pixels_per_s}};
    if (options.views > 0) {
      json["model"] = {{"views", options.views},
                       {"predicted_by_measured",
                        {{"p25", quality.lower}, {"p50", quality.median}, {"p75", quality.upper}}},
                       {"correlation_of_logarithms", quality.correlation}};
    }
    json["files"] = files;
    std::cout << json.dump(2) << "\n";
    return;
  }
  std::vector<std::vector<std::string>> rows{
      {"profile", measured.profile.name},
      {"vertices", fmt::format("{:.4g} a second ({} in {:.4f} s)", measured.profile.vertices_per_s,
                               measured.speeds.vertices, measured.speeds.vertices_s)},
      {"pixels",
       fmt::format("{:.4g} a second ({} fragments in {:.4f} s)", measured.profile.pixels_per_s,
                   measured.speeds.fragments, measured.speeds.fragments_s)}};
  if (options.views > 0) {
    rows.push_back({"model", fmt::format("predicted / measured {:.2f} in the middle of {} views, "
                                         "quartiles {:.2f} and {:.2f}; correlation of logarithms "
                                         "{:.2f}",
                                         quality.median, options.views, quality.lower,
                                         quality.upper, quality.correlation)});
  }
  for (const std::string& file : files) rows.push_back({"written", file});
  std::cout << text_table({{""}, {""}}, rows);
}

// What can be known before anything is measured.
void require_usable(const ProfileOptions& options) {
  constexpr int kLeastViews = 3;  // for quartiles and a correlation
  if (options.views != 0 && options.views < kLeastViews)
    input_error("--views {}: expected 0, or at least {}", options.views, kLeastViews);
  if (!options.table.empty() && options.views == 0)
    input_error("--table '{}': a table needs --views", options.table);
  if (!options.chart.empty() && options.views == 0)
    input_error("--chart '{}': a chart needs --views", options.chart);
  audit::parse_profile(options.name + ",1,1");  // the name
  const std::tuple<const char*, const std::string&, const char*> files[] = {
      {"-o", options.output, ".toml"},
      {"--table", options.table, ".csv"},
      {"--chart", options.chart, ".svg"}};
  for (const auto& [option, file, ending] : files) {
    if (file.empty() || (file == "-" && &file == &options.output)) continue;
    const std::filesystem::path path(file);
    if (path.extension() != ending)
      input_error("{} '{}': expected a name that ends with {}", option, file, ending);
    if (path.has_parent_path() && !std::filesystem::is_directory(path.parent_path()))
      input_error("{} '{}': there is no folder '{}'", option, file, path.parent_path().string());
  }
  if (options.output == "-" && options.json)
    input_error("-o - and --json both write to standard output");
}

int run_profile(const ProfileOptions& options) {
  const ThreadLimit limit(options.threads);
  require_usable(options);
  Progress progress;
  const Measured measured = measure(options, progress);
  const std::vector<std::string> files = write_files(options, measured);
  progress.finish();
  if (options.output != "-") print(options, measured, files);
  return 0;
}

}  // namespace

Command profile_command() {
  Command command;
  command.name = "profile";
  command.summary =
      "Measure how fast this machine draws polygons and slices, for the cost model of the methods "
      "slicing and hybrid-slicing";
  command.example =
      "plumb profile -o mine.toml --views 20 && plumb render 'generate:alpine?size=513' --method "
      "hybrid-slicing --set profile=mine.toml -o picture.png";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<ProfileOptions>();
    values->terrain.terrain = "generate:alpine?size=1025";
    options.optional_argument(values->terrain.terrain, "TERRAIN",
                              "What to draw (generate:alpine?size=1025)");
    options.group("Measurement");
    options.text(values->size, "--size", "WIDTHxHEIGHT", "Picture of slices and views (640x360)");
    options.integer(values->views, "--views", "N",
                    "Also draw N views by the new profile: how well are their times foretold?", 0,
                    10000);
    options.text(values->name, "--name", "NAME", "What the profile calls itself (measured)");
    options.group("Output");
    add_output_option(options, values->output,
                      "Write the profile, a .toml file, or - for the standard output");
    options.text(values->table, "--table", "CSV",
                 "Write predicted and measured seconds of each view");
    options.text(values->chart, "--chart", "SVG",
                 "Draw predicted over measured seconds of each view");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation&) { return run_profile(*values); };
  };
  return command;
}

}  // namespace plumb::tool
