#include "chart_print.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "child_process.h"
#include "core/atomic_file.h"
#include "report/web_assets.h"

namespace plumb::tool {
namespace {

namespace chart = audit::chart;
namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// Lets Vega draw all charts into the work folder; says why it did not, or nothing.
std::string draw_by_vega(const WorkFolder& work, const std::string& job) {
  const std::string library = file_of_command("vega.min.js");
  if (library.empty()) return "vega.min.js is not beside the command";
  write_file_atomically(work.file("chart-print.js"), report::kPrintScript);
  write_file_atomically(work.file("chart-data.js"), report::kChartDataScript);
  write_file_atomically(work.file("job.json"), job);
  const ChildResult drawn = run_child({"node", work.file("chart-print.js"), library,
                                       work.file("chart-data.js"), work.file("job.json")});
  if (drawn.status == 127) return "there is no node";
  if (drawn.status != 0)
    return fmt::format("node ended with {}: {}", drawn.status, first_line(drawn.output));
  return "";
}

// Says why there is no PNG, or nothing.
std::string write_png(const fs::path& svg, const fs::path& png) {
  TemporarySibling file(png);
  const ChildResult result =
      run_child({"rsvg-convert", "--zoom", "2", "--output", file.path().string(), svg.string()});
  if (result.status == 127) return "there is no rsvg-convert (librsvg2-bin)";
  if (result.status != 0)
    return fmt::format("rsvg-convert ended with {}: {}", result.status, first_line(result.output));
  file.commit();
  return "";
}

}  // namespace

void print_charts(const std::string& folder, const chart::PageInput& input,
                  std::vector<std::string>& files, std::vector<std::string>& left_out) {
  const WorkFolder work;
  const std::string why_plain = draw_by_vega(work, chart::print_job(input));
  std::string no_png;
  for (const chart::PrintedChart& printed : chart::printed_charts(input.table)) {
    const std::string name = printed.file + ".svg";
    const fs::path svg = fs::path(folder) / name, png = fs::path(folder) / (printed.file + ".png");
    write_file_atomically(
        svg, why_plain.empty() ? text_of(work.file(name)) : chart::plain_chart(printed, input));
    files.push_back(name);
    if (!no_png.empty()) continue;
    no_png = write_png(svg, png);
    if (no_png.empty()) files.push_back(printed.file + ".png");
  }
  if (!why_plain.empty())
    left_out.push_back(fmt::format("Vega's drawing for print: {}; the SVG are plain", why_plain));
  if (!no_png.empty()) left_out.push_back(fmt::format("PNG: {}", no_png));
}

}  // namespace plumb::tool
