// plumb chart: what a sweep measured, as a page and as pictures for print.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "audit/chart/chart_page.h"
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
  std::string results, output;
  bool json = false;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// What was written, and what was left out and why.
struct Written {
  std::vector<std::string> files, left_out;
};

void write_page(const ChartOptions& options, const Invocation& invocation,
                const chart::RunTable& table, const std::vector<chart::Setting>& settings,
                Written& written) {
  const std::string library = file_of_command("vega.min.js");
  if (library.empty())
    written.left_out.push_back(
        "the page's filters and the choice of cost: vega.min.js is not beside the command (run npm "
        "ci in web/ and build again)");
  const std::string page =
      chart::chart_page({table, settings, options.results, invocation.command_line(),
                         library.empty() ? "" : text_of(library)});
  write_file_atomically(fs::path(options.output) / "charts.html", page);
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
  make_folder(options.output);
  Written written;
  progress.step("drawing the page");
  write_page(options, invocation, table, settings, written);
  progress.step("drawing for print");
  print_charts(options.output, table, settings, written.files, written.left_out);
  progress.finish();
  print(options, table, written);
  return 0;
}

}  // namespace

Command chart_command() {
  Command command;
  command.name = "chart";
  command.summary = "Draw what a sweep measured: cost against error, claims, camera paths";
  command.example = "plumb chart --help";
  command.declare = [](Options& options) -> Action {
    const auto values = std::make_shared<ChartOptions>();
    options.argument(values->results, "RESULTS", "What plumb sweep wrote, a .jsonl file");
    options.group("Output");
    add_output_option(options, values->output,
                      "Folder for charts.html and each chart as SVG and PNG");
    options.require_option("--output");
    add_json_option(options, values->json);
    return [values](const Invocation& invocation) { return run_chart(*values, invocation); };
  };
  return command;
}

}  // namespace plumb::tool
