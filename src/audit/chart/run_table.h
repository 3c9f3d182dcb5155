// The finished runs of a sweep, as far as charts need them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::audit::chart {

/// What drawing costs, in one of the ways to count it.
struct CostKind {
  const char* key;   // letters and underscores
  const char* name;  // for people, with its unit
  const char* unit;  // "s", "bytes" or "" of what is counted
  bool is_time = false;
};

inline constexpr std::array<CostKind, 10> kCosts{{
    {"draw_cpu_s", "CPU time of drawing, s", "s", true},
    {"draw_wall_s", "Wall time of drawing, s", "s", true},
    {"prepare_cpu_s", "CPU time of preparing, s", "s", true},
    {"triangles", "Triangles drawn", ""},
    {"vertices", "Vertices drawn", ""},
    {"slices", "Slices drawn", ""},
    {"fragments", "Fragments drawn, overdraw included", ""},
    {"nodes_visited", "Nodes of the hierarchy visited", ""},
    {"bytes_resident", "Memory for drawing, bytes", "bytes"},
    {"bytes_encoded", "Prepared file, bytes", "bytes"},
}};

/// An error below this, in pixels or metres, is what rounding left of none: it counts as zero.
inline constexpr double kRounding = 1e-6;

/// A claim of a method about the whole frame, beside what was measured; +inf for no finite number.
struct ClaimedAndMeasured {
  std::string measure;  // as the audit names it: "pixel-error", a nearest-error without one too
  std::string unit;     // "px" or "m"
  double claimed = 0.0, measured = 0.0;
  bool holds = true;
};

struct Terrain {
  std::string name, kind;
};

/// A method with its variant, its parameters and the unit of its tolerance: what one curve shows.
struct Series {
  std::string method, variant, parameters;  // parameters as "name=value, ...", names ascending
  std::string unit;                         // of the tolerance: "px" or "m"
  std::string name;                         // short, and no other series of the table has it
  friend bool operator==(const Series&, const Series&) = default;
};

struct Run {
  int terrain = 0, series = 0, camera = 0;  // rows of the table's lists
  int frame = 0;                            // of a path, from 1; else 0
  bool on_path = false;
  double tolerance = 0.0;
  std::optional<double> error_px;  // +inf: infinite; none: nothing to measure
  std::array<std::optional<double>, kCosts.size()> costs;  // none: does not apply
  bool shared = false;                                     // other runs used the machine meanwhile
  std::vector<ClaimedAndMeasured> claims;
  double wrong_pixels = 0.0;       // where coverage was claimed: holes, overshoots, see-through
  std::int64_t wrong_patches = 0;  // patches that broke a claim of their own
  std::optional<double> popping_px;
  std::string verdict;  // "held", "broken" or "none"
  std::string command, key;
};

/// A run without a result.
struct Unfinished {
  std::string what;   // terrain, method, tolerance and camera in words
  std::string error;  // the reason
  bool skipped = false;
};

struct RunTable {
  std::vector<Terrain> terrains;     // in the order of the file
  std::vector<Series> series;        // sorted by method, variant, parameters, unit
  std::vector<std::string> cameras;  // in the order of the file
  std::vector<Run> runs;             // finished ones, in the order of the file
  std::vector<Unfinished> failed, skipped;
  std::string program;  // the versions that measured, "0.1.0"
  bool torn = false;    // the file ended within a line, which is left out
  int repeated = 0;     // lines whose run stood there before, left out
};

/// Reads lines of schema "plumb.sweep/1" (docs/formats/sweep-results.md). `name` stands in errors.
/// Throws InputError with the line's number for what is no such line, and if no run is finished.
RunTable parse_runs(std::string_view text, const std::string& name);

/// The same of a file.
RunTable read_runs(const std::filesystem::path& path);

}  // namespace plumb::audit::chart
