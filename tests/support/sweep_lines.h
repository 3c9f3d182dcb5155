// Lines of results as a sweep writes them, made up: for tests of what reads them.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "audit/sweep/plan.h"

namespace plumb::testing {

/// A run and its result; each member is one thing that a test may want otherwise.
struct MadeUpRun {
  std::string terrain = "hills", kind = "smooth", method = "full", variant = "only";
  double tolerance = 1.0;
  std::string unit = "px";
  std::string camera = "oblique";
  int frame = 0;  // above 0: of a path
  std::string status = "done";
  std::optional<double> error_px = 0.5;  // none: infinite
  bool empty = false;                    // shows nothing of the terrain
  double claimed_px = 1.0;
  double cpu_s = 0.001;
  int triangles = 1000, slices = 0;
  bool shared = false;
  std::optional<double> popping_px = std::nullopt;
  std::string command = "plumb audit 'generate:plane?size=9' --method full --size 16x9";
};

/// The line of plumb.sweep/1, with its line feed.
inline std::string line_of(const MadeUpRun& run) {
  using Json = nlohmann::ordered_json;
  const Json asked{
      {"terrain", {{"name", run.terrain}, {"kind", run.kind}}},
      {"method", run.method},
      {"variant", run.variant},
      {"parameters", Json::object()},
      {"tolerance", {{"value", run.tolerance}, {"unit", run.unit}}},
      {"camera", {{"name", run.camera}, {"frame", run.frame}, {"path", run.frame > 0}}},
      {"program", "0.1.0"}};
  Json line{{"schema", "plumb.sweep/1"},
            {"key", audit::sweep::key_of(asked.dump())},
            {"index", 0},
            {"asked", asked},
            {"status", run.status}};
  if (run.status != "done") line["error"] = "made up";
  line["command"] = run.command;
  if (run.status != "done") return line.dump() + "\n";
  const Json error = run.empty ? Json(0.0) : run.error_px ? Json(*run.error_px) : Json(nullptr);
  const bool holds = run.error_px && *run.error_px <= run.claimed_px;
  line["verdict"] = holds ? "held" : "broken";
  line["claims"] = {{{"measure", "pixel-error"},
                     {"by", "method"},
                     {"scope", "frame"},
                     {"claimed", run.claimed_px},
                     {"unit", "px"},
                     {"measured", error},
                     {"holds", holds}}};
  line["errors"] = {
      {"pixel_vertical_px",
       {{"count", run.empty ? 0 : 9}, {"infinite", run.error_px ? 0 : 1}, {"max", error}}}};
  line["cost"] = {{"vertices", run.triangles / 2},
                  {"triangles", run.triangles},
                  {"slices", run.slices},
                  {"fragments", 5000},
                  {"nodes_visited", 0},
                  {"bytes_resident", 24 * run.triangles},
                  {"bytes_encoded", 0}};
  if (run.popping_px) line["popping"] = {{"max_px", *run.popping_px}};
  line["timing"] = {{"prepare", {{"wall_s", 0.5}, {"cpu_s", 0.4}}},
                    {"draw", {{"runs", 3}, {"wall_s", run.cpu_s}, {"cpu_s", run.cpu_s}}},
                    {"shared", run.shared}};
  return line.dump() + "\n";
}

}  // namespace plumb::testing
