#include "audit/chart/run_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "audit/sweep/result_file.h"
#include "core/check.h"

namespace plumb::audit::chart {
namespace {

using nlohmann::json;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// A member that may be absent or null.
const json* member(const json& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(name);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

std::optional<double> number(const json& object, const char* name) {
  const json* value = member(object, name);
  return value != nullptr && value->is_number() ? std::optional(value->get<double>())
                                                : std::nullopt;
}

// What is left of an exact method's error by rounding is none.
double without_rounding(double error) { return error < kRounding ? 0.0 : error; }

// The largest error of a distribution; a null beside a count is an infinite one. None where nothing
// was measured: a view that shows nothing of the terrain.
std::optional<double> largest(const json* distribution) {
  if (distribution == nullptr) return std::nullopt;
  const bool any = number(*distribution, "count").value_or(1.0) > 0.0 ||
                   number(*distribution, "infinite").value_or(0.0) > 0.0;
  if (!any) return std::nullopt;
  return without_rounding(number(*distribution, "max").value_or(kInfinite));
}

std::optional<double> error_of(const json& errors) {
  const auto vertical = largest(member(errors, "pixel_vertical_px"));
  return vertical ? vertical : largest(member(errors, "pixel_nearest_px"));
}

// As an audit of a path has it: a null beside infinite pixels is infinite.
std::optional<double> popping_of(const json& line) {
  const json* popping = member(line, "popping");
  if (popping == nullptr) return std::nullopt;
  if (const auto most = number(*popping, "max_px")) return without_rounding(*most);
  return number(*popping, "infinite").value_or(0.0) > 0.0 ? std::optional(kInfinite) : std::nullopt;
}

std::array<std::optional<double>, kCosts.size()> costs_of(const json& cost, const json& timing) {
  const json nothing;
  const auto part = [&](const char* name) -> const json& {
    const json* found = member(timing, name);
    return found != nullptr ? *found : nothing;
  };
  const auto unless_zero = [](std::optional<double> value) {
    return value == 0.0 ? std::nullopt : value;
  };
  return {number(part("draw"), "cpu_s"),    number(part("draw"), "wall_s"),
          number(part("prepare"), "cpu_s"), number(cost, "triangles"),
          number(cost, "vertices"),         unless_zero(number(cost, "slices")),
          number(cost, "fragments"),        unless_zero(number(cost, "nodes_visited")),
          number(cost, "bytes_resident"),   unless_zero(number(cost, "bytes_encoded"))};
}

// What a picture of caves is held against is the nearest point, up and down meaning nothing there:
// one chart shows both.
void name_nearest_pixel_error(std::vector<ClaimedAndMeasured>& claims) {
  const auto is = [](const char* measure) {
    return [measure](const ClaimedAndMeasured& claim) { return claim.measure == measure; };
  };
  if (std::any_of(claims.begin(), claims.end(), is("pixel-error"))) return;
  for (ClaimedAndMeasured& claim : claims)
    if (is("nearest-error")(claim)) claim.measure = "pixel-error";
}

std::vector<ClaimedAndMeasured> claims_of(const json& line) {
  std::vector<ClaimedAndMeasured> claims;
  const json* list = member(line, "claims");
  if (list == nullptr) return claims;
  for (const json& claim : *list) {
    const std::string unit = claim.value("unit", "");
    if (claim.value("by", "") != "method" || claim.value("scope", "") != "frame") continue;
    if (unit != "px" && unit != "m") continue;
    const json* holds = member(claim, "holds");
    if (holds == nullptr) continue;  // not measured
    claims.push_back(
        {claim.value("measure", ""), unit, number(claim, "claimed").value_or(kInfinite),
         without_rounding(number(claim, "measured").value_or(kInfinite)), holds->get<bool>()});
  }
  name_nearest_pixel_error(claims);
  return claims;
}

double wrong_pixels_of(const json& line) {
  const json* list = member(line, "claims");
  if (list == nullptr) return 0.0;
  for (const json& claim : *list) {
    if (claim.value("by", "") == "method" && claim.value("measure", "") == "coverage")
      return number(claim, "measured").value_or(0.0);
  }
  return 0.0;
}

std::string parameters_of(const json& asked) {
  std::string text;
  if (const json* parameters = member(asked, "parameters"))
    for (const auto& [name, value] : parameters->items())
      text += fmt::format("{}{}={}", text.empty() ? "" : ", ", name,
                          value.is_string() ? value.get<std::string>() : value.dump());
  return text;
}

// Rows of a list in the order of their first appearance.
class Names {
 public:
  int row(const std::string& name) {
    const auto [found, is_new] = rows_.try_emplace(name, static_cast<int>(rows_.size()));
    return found->second;
  }

 private:
  std::map<std::string, int> rows_;
};

class Reader {
 public:
  /// `run` names it for people.
  void add(const json& line, const std::string& run) {
    const json& asked = line.at("asked");
    if (!keys_.insert(line.at("key").get<std::string>()).second) {
      ++table_.repeated;
      return;
    }
    programs_.insert(asked.value("program", "?"));
    const std::string status = line.at("status").get<std::string>();
    if (status == "done") {
      add_finished(line, asked);
    } else if (status == "failed" || status == "skipped") {
      const bool skipped = status == "skipped";
      (skipped ? table_.skipped : table_.failed)
          .push_back({run, line.value("error", "no reason given"), skipped});
    } else {
      input_error("the status '{}' is none of done, failed and skipped", status);
    }
  }

  RunTable table() && {
    sort_series();
    leave_out_triangles_of_slices();
    for (const std::string& program : programs_)
      table_.program += (table_.program.empty() ? "" : ", ") + program;
    return std::move(table_);
  }

 private:
  int terrain_row(const json& terrain) {
    const std::string name = terrain.at("name").get<std::string>();
    const auto row = static_cast<std::size_t>(terrain_names_.row(name));
    if (row == table_.terrains.size()) table_.terrains.push_back({name, terrain.value("kind", "")});
    return static_cast<int>(row);
  }

  int camera_row(const json& camera) {
    const std::string name = camera.at("name").get<std::string>();
    const auto row = static_cast<std::size_t>(camera_names_.row(name));
    if (row == table_.cameras.size()) table_.cameras.push_back(name);
    return static_cast<int>(row);
  }

  int series_row(const json& asked) {
    const Series series{asked.at("method").get<std::string>(), asked.value("variant", ""),
                        parameters_of(asked), asked.at("tolerance").at("unit").get<std::string>(),
                        ""};
    const auto found = std::find(table_.series.begin(), table_.series.end(), series);
    if (found != table_.series.end()) return static_cast<int>(found - table_.series.begin());
    table_.series.push_back(series);
    return static_cast<int>(table_.series.size()) - 1;
  }

  void add_finished(const json& line, const json& asked) {
    const json& camera = asked.at("camera");
    const json nothing;
    const json* timing = member(line, "timing");
    Run run;
    run.terrain = terrain_row(asked.at("terrain"));
    run.series = series_row(asked);
    run.camera = camera_row(camera);
    run.frame = camera.value("frame", 0);
    run.on_path = camera.value("path", false);
    run.tolerance = asked.at("tolerance").at("value").get<double>();
    run.error_px = error_of(line.at("errors"));
    run.costs = costs_of(line.at("cost"), timing != nullptr ? *timing : nothing);
    run.shared = timing != nullptr && timing->value("shared", false);
    run.claims = claims_of(line);
    run.wrong_pixels = wrong_pixels_of(line);
    if (const json* patches = member(line, "patch_claims"))
      run.wrong_patches = patches->value("broken", std::int64_t{0});
    run.popping_px = popping_of(line);
    run.verdict = line.value("verdict", "none");
    run.command = line.value("command", "");
    run.key = line.at("key").get<std::string>();
    table_.runs.push_back(std::move(run));
  }

  // Triangles alone say nothing of what slices cost: a series that draws slices anywhere has none.
  void leave_out_triangles_of_slices() {
    constexpr std::size_t kTriangles = 3, kVertices = 4, kSlices = 5;
    std::set<int> of_slices;
    for (const Run& run : table_.runs)
      if (run.costs[kSlices]) of_slices.insert(run.series);
    for (Run& run : table_.runs)
      if (of_slices.contains(run.series)) run.costs[kTriangles] = run.costs[kVertices] = {};
  }

  // Sorts the series and names each by as much as tells it from the others.
  void sort_series() {
    std::vector<Series>& all = table_.series;
    const auto key = [](const Series& s) {
      return std::tie(s.method, s.variant, s.parameters, s.unit);
    };
    std::vector<Series> sorted = all;
    std::sort(sorted.begin(), sorted.end(),
              [&](const Series& a, const Series& b) { return key(a) < key(b); });
    for (Run& run : table_.runs) {
      const auto at =
          std::find(sorted.begin(), sorted.end(), all[static_cast<std::size_t>(run.series)]);
      run.series = static_cast<int>(at - sorted.begin());
    }
    const auto differs = [&](const Series& one, auto part) {
      return std::any_of(sorted.begin(), sorted.end(), [&](const Series& other) {
        return other.method == one.method && other.*part != one.*part;
      });
    };
    std::vector<std::string> names;
    for (const Series& one : sorted) {
      std::string name = one.method;
      if (!one.variant.empty() && differs(one, &Series::variant)) name += " " + one.variant;
      if (differs(one, &Series::parameters))
        name += fmt::format(" ({})", one.parameters.empty() ? "as it comes" : one.parameters);
      if (differs(one, &Series::unit)) name += fmt::format(", tolerance in {}", one.unit);
      names.push_back(name);
    }
    for (std::size_t k = 0; k < sorted.size(); ++k) sorted[k].name = names[k];
    all = std::move(sorted);
  }

  RunTable table_;
  Names terrain_names_, camera_names_;
  std::set<std::string> keys_, programs_;
};

}  // namespace

RunTable parse_runs(std::string_view text, const std::string& name) {
  if (text.empty()) input_error("'{}' is empty: expected the results of plumb sweep", name);
  const sweep::ResultLines results = sweep::parse_results(text, name);
  Reader reader;
  for (const sweep::ResultLine& line : results.lines) {
    try {
      reader.add(json::parse(line.text), line.run);
    } catch (const json::exception& error) {
      input_error("'{}': the line of {} is not as plumb.sweep/1 has it: {}", name, line.run,
                  error.what());
    }
  }
  RunTable table = std::move(reader).table();
  table.torn = results.whole_bytes < text.size();
  if (table.runs.empty())
    input_error("'{}' has no finished run ({} failed, {} skipped{})", name, table.failed.size(),
                table.skipped.size(), table.torn ? ", a torn last line" : "");
  return table;
}

RunTable read_runs(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    input_error("cannot read '{}': expected the results of plumb sweep", path.string());
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return parse_runs(text, path.string());
}

}  // namespace plumb::audit::chart
