#include "chart_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>

#include "child_process.h"
#include "core/atomic_file.h"
#include "core/check.h"
#include "progress.h"

namespace plumb::tool {
namespace {

namespace chart = audit::chart;
namespace fs = std::filesystem;

// A picture of an audit's report that a map is kept of.
struct Map {
  const char* file;     // the audit's
  const char* name;     // ours
  const char* caption;  // what it shows
};

constexpr std::array<Map, 4> kMaps{{
    {"pixel-error.png", "error", "Error: distance on screen to the truth above or below, pixels"},
    {"nearest-error.png", "nearest", "Error: distance on screen to the nearest truth, pixels"},
    {"overdraw.png", "overdraw", "Cost: fragments drawn on each pixel"},
    {"triangle-density.png", "triangles", "Cost: triangles a pixel (one over the area on screen)"},
}};

double error_of(const chart::Run& run) { return run.error_px.value_or(-1.0); }

double from_one(double value) {
  return value > 0.0 ? std::max(value, 1.0 / value) : std::numeric_limits<double>::infinity();
}

// Of each series the run that comes first by `better`.
template <class Better>
std::vector<std::size_t> best_of_each(const chart::RunTable& table,
                                      const std::vector<std::size_t>& rows, const Better& better) {
  std::map<int, std::size_t> best;
  for (const std::size_t row : rows) {
    const chart::Run& run = table.runs[row];
    const auto [at, is_new] = best.try_emplace(run.series, row);
    if (!is_new && better(run, table.runs[at->second])) at->second = row;
  }
  std::vector<std::size_t> chosen;
  for (const auto& [series, row] : best) chosen.push_back(row);
  return chosen;
}

std::string title_of(const chart::RunTable& table, const chart::Run& run) {
  const chart::Series& series = table.series[static_cast<std::size_t>(run.series)];
  return fmt::format("{}, {:.6g} {} asked: {}, {}{}", series.name, run.tolerance, series.unit,
                     table.terrains[static_cast<std::size_t>(run.terrain)].name,
                     table.cameras[static_cast<std::size_t>(run.camera)],
                     run.frame > 0 ? fmt::format(" frame {}", run.frame) : "");
}

std::vector<std::uint8_t> bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Makes the run's report in `work`; says why it could not, or nothing.
std::string make_report(const chart::Run& run, const std::string& work) {
  std::vector<std::string> words = shell_words(run.command);
  if (words.size() < 2 || words[0] != "plumb" || words[1] != "audit")
    return fmt::format("its command is no plumb audit: {}", run.command);
  words[0] = own_program();
  words.insert(words.end(), {"-o", work});
  const ChildResult made = run_child(words);
  if (fs::exists(work + "/report.html")) return "";
  const std::size_t end = made.output.find_last_not_of('\n');
  const std::string text = made.output.substr(0, end == std::string::npos ? 0 : end + 1);
  return text.substr(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
}

}  // namespace

std::vector<std::size_t> runs_for_maps(const chart::RunTable& table, const std::string& which) {
  std::vector<std::size_t> all(table.runs.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
  if (which == "worst")
    return best_of_each(table, all, [](const chart::Run& a, const chart::Run& b) {
      return error_of(a) > error_of(b);
    });
  std::vector<std::size_t> there;
  for (const std::size_t row : all) {
    const chart::Run& run = table.runs[row];
    if (run.key == which) return {row};
    if (table.terrains[static_cast<std::size_t>(run.terrain)].name + "/" +
            table.cameras[static_cast<std::size_t>(run.camera)] ==
        which)
      there.push_back(row);
  }
  if (there.empty())
    input_error("--maps {}: expected worst, TERRAIN/CAMERA or a key of the results, such as {}/{}",
                which, table.terrains.front().name, table.cameras.front());
  return best_of_each(table, there, [](const chart::Run& a, const chart::Run& b) {
    return std::tuple(from_one(a.tolerance), -error_of(a)) <
           std::tuple(from_one(b.tolerance), -error_of(b));
  });
}

std::vector<chart::MappedRun> make_maps(const std::string& folder, const chart::RunTable& table,
                                        const std::vector<std::size_t>& runs,
                                        std::vector<std::string>& files,
                                        std::vector<std::string>& left_out) {
  Progress progress;
  std::vector<chart::MappedRun> mapped;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    progress.step(fmt::format("maps of run {} of {}", k + 1, runs.size()));
    const chart::Run& run = table.runs[runs[k]];
    const WorkFolder work;
    const std::string title = title_of(table, run), why = make_report(run, work.file("report"));
    if (!why.empty()) {
      left_out.push_back(fmt::format("maps of {}: {}", title, why));
      continue;
    }
    chart::MappedRun one{title, run.command, {}};
    for (const Map& map : kMaps) {
      const std::vector<std::uint8_t> png = bytes_of(work.file("report/") + map.file);
      const bool has_vertical = map.name == std::string_view("nearest") && !one.maps.empty();
      if (png.empty() || has_vertical) continue;
      const std::string file = fmt::format("map-{}-{}.png", k + 1, map.name);
      write_file_atomically(fs::path(folder) / file,
                            {reinterpret_cast<const char*>(png.data()), png.size()});
      files.push_back(file);
      one.maps.push_back({map.caption, png});
    }
    mapped.push_back(std::move(one));
  }
  progress.finish();
  return mapped;
}

}  // namespace plumb::tool
