// plumb chart: what a sweep measured, as a page and as pictures for print.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "audit/chart/chart_page.h"
#include "audit/chart/chart_tables.h"
#include "audit/chart/scales.h"
#include "chart_maps.h"
#include "chart_print.h"
#include "child_process.h"
#include "command.h"
#include "common_options.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "progress.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

namespace chart = audit::chart;
namespace fs = std::filesystem;

struct ChartOptions {
  std::string results, output, cost, maps;
  bool json = false;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> cost_names() {
  std::vector<std::string> names;
  for (const chart::CostKind& cost : chart::kCosts) names.push_back(cost.key);
  return names;
}

// The row of kCosts that is meant.
std::size_t cost_of(const ChartOptions& options, const chart::RunTable& table) {
  if (options.cost.empty()) return chart::first_cost(table);
  const std::vector<std::string> names = cost_names();
  const auto at = std::find(names.begin(), names.end(), options.cost);
  const auto cost = static_cast<std::size_t>(at - names.begin());
  const std::vector<std::size_t> there = chart::costs_there(table);
  if (std::find(there.begin(), there.end(), cost) == there.end())
    input_error("--cost {}: no run of '{}' has it", options.cost, options.results);
  return cost;
}

// What was written, and what was left out and why.
struct Written {
  std::vector<std::string> files, left_out;
};

chart::PageInput page_input(const ChartOptions& options, const Invocation& invocation,
                            const chart::RunTable& table,
                            const std::vector<chart::Setting>& settings) {
  const std::string library = file_of_command("vega.min.js");
  return {table,
          settings,
          cost_of(options, table),
          options.results,
          invocation.command_line(),
          library.empty() ? "" : text_of(library)};
}

void write_page(const ChartOptions& options, const chart::PageInput& input, Written& written) {
  if (input.library.empty())
    written.left_out.push_back(
        "the page's filters and choices: vega.min.js is not beside the command (npm ci "
        "--ignore-scripts in web/, and build again)");
  write_file_atomically(fs::path(options.output) / "charts.html", chart::chart_page(input));
  written.files.push_back("charts.html");
}

void print(const ChartOptions& options, const chart::RunTable& table, const Written& written) {
  if (options.json) {
    std::cout << nlohmann::ordered_json{{"schema", "plumb.chart/1"},
                                        {"runs", table.runs.size()},
                                        {"failed", table.failed.size()},
                                        {"skipped", table.skipped.size()},
                                        {"torn", table.torn},
                                        {"repeated", table.repeated},
                                        {"folder", options.output},
                                        {"files", written.files},
                                        {"left_out", written.left_out}}
                     .dump(2)
              << "\n";
    return;
  }
  std::vector<std::vector<std::string>> rows{
      {"runs", fmt::format("{} finished, {} failed, {} skipped", table.runs.size(),
                           table.failed.size(), table.skipped.size())}};
  for (const std::string& file : written.files)
    rows.push_back({"written", (fs::path(options.output) / file).string()});
  for (const std::string& what : written.left_out) rows.push_back({"left out", what});
  std::cout << text_table({{""}, {""}}, rows);
}

int run_chart(const ChartOptions& options, const Invocation& invocation) {
  Progress progress;
  progress.step("reading the results");
  const chart::RunTable table = chart::read_runs(options.results);
  if (table.torn) warn(fmt::format("'{}': the last line is torn and left out", options.results));
  const std::vector<chart::Setting> settings = chart::settings_of(table);
  const std::vector<std::size_t> mapped =
      options.maps.empty() ? std::vector<std::size_t>{} : runs_for_maps(table, options.maps);
  chart::PageInput input = page_input(options, invocation, table, settings);
  make_folder(options.output);
  Written written;
  if (!options.maps.empty()) {
    progress.finish();
    input.maps_of = options.maps;
    input.mapped = make_maps(options.output, table, mapped, written.files, written.left_out);
  }
  progress.step("drawing the page");
  write_page(options, input, written);
  write_file_atomically(fs::path(options.output) / "tables.md",
                        chart::chart_tables(table, input.cost, invocation.command_line()));
  written.files.push_back("tables.md");
  progress.step("drawing for print");
  print_charts(options.output, input, written.files, written.left_out);
  progress.finish();
  print(options, table, written);
  return 0;
}

}  // namespace

Command chart_command() {
  Command command;
  command.name = "chart";
  command.summary = "Draw what a sweep measured: cost against error, claims, camera paths";
  command.example =
      "printf '%s\\n' 'terrains = [\"generate:alpine?size=65\"]' 'methods = "
      "[\"restricted-quadtree\", \"full\"]' 'tolerances_px = [1, 4]' 'width = 160' 'height = "
      "90' > sweep.toml && plumb sweep sweep.toml -o results.jsonl && plumb chart results.jsonl "
      "-o charts";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<ChartOptions>();
    options.argument(values->results, "RESULTS", "What plumb sweep wrote, a .jsonl file");
    options.choice(values->cost, "--cost", cost_names(),
                   "What the charts show as cost; the page offers all (draw_cpu_s, or triangles if "
                   "all times were taken while sharing the machine)");
    options.text(
        values->maps, "--maps", "RUNS",
        "Run some again, in this folder, for maps of error and cost: worst (of each method "
        "and variant), TERRAIN/CAMERA (of each at the tolerance nearest to 1), or a key");
    options.group("Output");
    add_output_option(options, values->output,
                      "Folder for charts.html, tables.md and each chart as SVG and PNG");
    options.require_option("--output");
    add_json_option(options, values->json);
    return [values](const Invocation& invocation) { return run_chart(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
