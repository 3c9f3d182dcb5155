// plumb info: what a terrain is like, and what was taken for granted.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "command.h"
#include "common_options.h"
#include "container_info.h"
#include "core/check.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "info_preview.h"
#include "progress.h"
#include "stack_info.h"
#include "terrain/stacks/stack_file.h"
#include "terrain/statistics.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

namespace fs = std::filesystem;
using terrain::Heightfield;
using terrain::TerrainStatistics;

struct InfoOptions {
  TerrainOptions terrain;
  std::string preview;
  int threads = 0;
  bool json = false;
};

// A sample's column and row in its file, counted from the top left.
struct FilePlace {
  int column = 0, row = 0;
};

FilePlace file_place(const Heightfield& field, int i, int j) {
  return {field.provenance.window_x + i, field.provenance.window_y + field.rows() - 1 - j};
}

std::string length_text(double metres) {
  return metres >= 10000.0 ? fmt::format("{:.6g} km", metres / 1000.0)
                           : fmt::format("{:.6g} m", metres);
}

std::string place_text(const Heightfield& field, int i, int j) {
  const FilePlace place = file_place(field, i, j);
  return fmt::format("column {}, row {} ({:.10g}, {:.10g})", place.column, place.row,
                     field.origin_m.x + i * field.dx_m, field.origin_m.y + j * field.dy_m);
}

using Rows = std::vector<std::vector<std::string>>;

void add_source(Rows& rows, const Heightfield& field) {
  const terrain::Provenance& from = field.provenance;
  rows.push_back({"terrain", from.source});
  rows.push_back({"format", from.format});
  rows.push_back({"size", fmt::format("{} x {} samples", field.columns(), field.rows())});
  if (from.file_columns != field.columns() || from.file_rows != field.rows()) {
    rows.push_back({"window", fmt::format("column {}, row {} of {} x {}", from.window_x,
                                          from.window_y, from.file_columns, from.file_rows)});
  }
  if (!from.crs.empty()) rows.push_back({"system", from.crs});
  rows.push_back({"spacing", fmt::format("{:.8g} x {:.8g} m", field.dx_m, field.dy_m)});
  rows.push_back({"origin", fmt::format("({:.10g}, {:.10g}) m, the south-western sample",
                                        field.origin_m.x, field.origin_m.y)});
  if (from.height_scale != 1.0 || from.height_offset_m != 0.0) {
    rows.push_back({"heights", fmt::format("stored value x {:.8g} + {:.8g} m", from.height_scale,
                                           from.height_offset_m)});
  }
  if (from.largest_rounding_m > 0.0)
    rows.push_back({"rounding", fmt::format("at most {:.3g} m", from.largest_rounding_m)});
}

void add_measures(Rows& rows, const Heightfield& field, const TerrainStatistics& found) {
  rows.push_back(
      {"extent", fmt::format("{} x {}", length_text(found.width_m), length_text(found.height_m))});
  rows.push_back({"voids", fmt::format("{} of {} samples ({} declared, {} not finite)", found.voids,
                                       found.voids + found.heights, field.provenance.voids_declared,
                                       field.provenance.voids_not_finite)});
  if (found.heights == 0) return;
  rows.push_back({"lowest", fmt::format("{:.7g} m at {}", found.lowest.height_m,
                                        place_text(field, found.lowest.i, found.lowest.j))});
  rows.push_back({"highest", fmt::format("{:.7g} m at {}", found.highest.height_m,
                                         place_text(field, found.highest.i, found.highest.j))});
  rows.push_back({"mean", fmt::format("{:.7g} m", found.mean_m)});
  rows.push_back({"slope", fmt::format("{:.2f} degrees (root mean square), {:.2f} at most",
                                       found.rms_slope_deg, found.largest_slope_deg)});
  const terrain::NeighbourStep& step = found.steepest_step;
  rows.push_back(
      {"step", fmt::format("{:.6g} m between neighbours at most, {:.2f} degrees, at {}",
                           step.rise_m, step.slope_deg, place_text(field, step.i, step.j))});
}

std::string slope_histogram(const TerrainStatistics& found) {
  Rows rows;
  double most = 0.0;
  int last = 0;
  for (int bin = 0; bin < terrain::kSlopeBins; ++bin) {
    const auto count = found.slope_histogram[static_cast<std::size_t>(bin)];
    most = std::max(most, static_cast<double>(count));
    if (count > 0) last = bin;
  }
  if (most == 0.0) return "";
  for (int bin = 0; bin <= last; ++bin) {
    const auto count = static_cast<double>(found.slope_histogram[static_cast<std::size_t>(bin)]);
    const double from = bin * terrain::kSlopeBinWidth_deg;
    rows.push_back({fmt::format("{:g}-{:g}", from, from + terrain::kSlopeBinWidth_deg),
                    fmt::format("{:.2f} %", 100.0 * count / static_cast<double>(found.cells)),
                    text_bar(count, most, 50)});
  }
  return text_table({{"degrees", true}, {"cells", true}, {"", false}}, rows);
}

std::string info_text(const Heightfield& field, const TerrainStatistics& found) {
  Rows rows;
  add_source(rows, field);
  add_measures(rows, field, found);
  for (std::size_t i = 0; i < field.provenance.assumptions.size(); ++i)
    rows.push_back({i == 0 ? "assumed" : "", field.provenance.assumptions[i]});
  std::string text = text_table({{"", false}, {"", false}}, rows);
  const std::string histogram = slope_histogram(found);
  return histogram.empty() ? text : text + "\n" + histogram;
}

nlohmann::ordered_json place_json(const Heightfield& field, int i, int j) {
  const FilePlace place = file_place(field, i, j);
  return {{"column", place.column},
          {"row", place.row},
          {"x_m", field.origin_m.x + i * field.dx_m},
          {"y_m", field.origin_m.y + j * field.dy_m}};
}

nlohmann::ordered_json height_json(const Heightfield& field, const terrain::PlacedHeight& height) {
  nlohmann::ordered_json json{{"height_m", height.height_m}};
  json.update(place_json(field, height.i, height.j));
  return json;
}

std::string info_json(const Heightfield& field, const TerrainStatistics& found,
                      const Invocation& invocation) {
  const terrain::Provenance& from = field.provenance;
  nlohmann::ordered_json json;
  json["schema"] = "plumb.info/1";
  json["command"] = invocation.command_line();
  json["terrain"] = {{"source", from.source},
                     {"format", from.format},
                     {"checksum", fmt::format("{:016x}", terrain::checksum(field))},
                     {"columns", field.columns()},
                     {"rows", field.rows()},
                     {"file_columns", from.file_columns},
                     {"file_rows", from.file_rows},
                     {"window", {from.window_x, from.window_y, field.columns(), field.rows()}},
                     {"crs", from.crs},
                     {"spacing_m", {field.dx_m, field.dy_m}},
                     {"origin_m", {field.origin_m.x, field.origin_m.y}},
                     {"extent_m", {found.width_m, found.height_m}},
                     {"height_scale", from.height_scale},
                     {"height_offset_m", from.height_offset_m},
                     {"largest_rounding_m", from.largest_rounding_m}};
  json["voids"] = {{"samples", found.voids},
                   {"declared", from.voids_declared},
                   {"not_finite", from.voids_not_finite}};
  if (found.heights > 0) {
    json["lowest"] = height_json(field, found.lowest);
    json["highest"] = height_json(field, found.highest);
    json["mean_m"] = found.mean_m;
    const terrain::NeighbourStep& step = found.steepest_step;
    json["steepest_step"] = {{"rise_m", step.rise_m}, {"slope_deg", step.slope_deg}};
    json["steepest_step"].update(place_json(field, step.i, step.j));
  }
  json["slopes"] = {{"cells", found.cells},
                    {"rms_deg", found.rms_slope_deg},
                    {"largest_deg", found.largest_slope_deg},
                    {"bin_width_deg", terrain::kSlopeBinWidth_deg},
                    {"histogram", found.slope_histogram}};
  json["assumptions"] = from.assumptions;
  return json.dump(2) + "\n";
}

bool has_options_for_reading(const InfoOptions& options) {
  TerrainOptions nothing_else;
  nothing_else.terrain = options.terrain.terrain;
  return !(options.terrain == nothing_else) || !options.preview.empty();
}

// A coded terrain says itself all that the other options would.
int run_container_info(const InfoOptions& options, const Invocation& invocation) {
  if (has_options_for_reading(options))
    input_error("{}: a coded terrain: 'plumb decode' makes one that these options are for",
                options.terrain.terrain);
  const mesh::patch_quadtree::Container container{fs::path(options.terrain.terrain)};
  std::cout << (options.json ? container_json(container, invocation) : container_text(container));
  return 0;
}

int run_stack_info(const InfoOptions& options, const Invocation& invocation) {
  if (has_options_for_reading(options))
    input_error("{}: a file of stacks, which options for reading a terrain are not for",
                options.terrain.terrain);
  const std::string& file = options.terrain.terrain;
  const terrain::StackField field = terrain::read_stacks(file);
  const StackFileSize size{file, static_cast<std::int64_t>(fs::file_size(file))};
  std::cout << (options.json ? stacks_json(field, size, invocation) : stacks_text(field, size));
  return 0;
}

int run_info(const InfoOptions& options, const Invocation& invocation) {
  const ThreadLimit limit(options.threads);
  if (mesh::patch_quadtree::is_container(options.terrain.terrain))
    return run_container_info(options, invocation);
  if (terrain::is_stack_file(options.terrain.terrain)) return run_stack_info(options, invocation);
  Progress progress;
  progress.step("reading the terrain");
  const Heightfield field = load(options.terrain, false);
  if (field.stacks != nullptr) {  // of a generator: a file has gone its own way
    if (!options.preview.empty()) write_preview(options.preview, field);
    progress.finish();
    std::cout << (options.json ? stacks_json(*field.stacks, std::nullopt, invocation)
                               : stacks_text(*field.stacks, std::nullopt));
    return 0;
  }
  progress.step("measuring it");
  const TerrainStatistics found = terrain::statistics_of(field);
  if (!options.preview.empty()) {
    progress.step("drawing the preview");
    write_preview(options.preview, field);
  }
  progress.finish();
  std::cout << (options.json ? info_json(field, found, invocation) : info_text(field, found));
  return 0;
}

}  // namespace

Command info_command() {
  Command command;
  command.name = "info";
  command.summary =
      "Tell what a terrain is like, and what was assumed when it was read; or what a coded one "
      "(.plumb) or stacks of material (.stacks) hold";
  command.example = "plumb info 'generate:alpine?size=513&seed=7' --preview preview.png";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<InfoOptions>();
    add_terrain_options(options, values->terrain, false);
    options.group("Output");
    options.text(values->preview, "--preview", "PNG", "Write a shaded picture, seen from above");
    add_json_option(options, values->json);
    add_threads_option(options, values->threads);
    return [values](const Invocation& invocation) { return run_info(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
