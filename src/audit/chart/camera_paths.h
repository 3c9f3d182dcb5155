// The camera paths of a sweep: runs whose frames belong together in time.
#pragma once

#include <string>
#include <vector>

#include "audit/chart/run_table.h"
#include "report/open_axis.h"

namespace plumb::audit::chart {

struct CameraPath {
  int terrain = 0, camera = 0;  // rows of the table
  std::string title;            // "hills · flight"
  report::OpenAxis frames;      // linear: a frame's number is its place
};

/// In the order of terrains, then cameras.
std::vector<CameraPath> paths_of(const RunTable& table);

struct Asked {
  double value = 0.0;
  std::string unit;
  int runs = 0;
};

/// The tolerances asked for on paths, by unit (pixels first), then value.
std::vector<Asked> asked_on_paths(const RunTable& table);

/// The row that a chart begins with: the one with most runs; of several such the one nearest to 1,
/// by ratio. 0 for an empty list.
std::size_t first_asked(const std::vector<Asked>& all);

}  // namespace plumb::audit::chart
