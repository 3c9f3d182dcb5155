#include "audit/chart/camera_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "core/reproducible_math.h"

namespace plumb::audit::chart {
namespace {

// Whole numbers from the first frame to the last, at most ten of them written.
report::OpenAxis frame_axis(int first, int last) {
  report::OpenAxis axis;
  axis.low = axis.first = first;
  axis.high = axis.last = std::max(last, first + 1);
  int step = 1;
  for (int times = 0; (last - first) / step > 10; ++times)
    step = step / (times % 3 == 1 ? 2 : 1) * (times % 3 == 1 ? 5 : 2);
  axis.ticks.push_back({axis.low, fmt::format("{}", first)});
  for (int frame = (first / step + 1) * step; frame <= last; frame += step)
    if (2 * (frame - first) >= step)
      axis.ticks.push_back({static_cast<double>(frame), fmt::format("{}", frame)});
  return axis;
}

double from_one(double value) { return value > 0.0 ? std::abs(reproducible_log(value)) : 1e300; }

}  // namespace

std::vector<CameraPath> paths_of(const RunTable& table) {
  std::map<std::pair<int, int>, std::pair<int, int>> ends;
  for (const Run& run : table.runs) {
    if (!run.on_path) continue;
    const auto [at, is_new] =
        ends.try_emplace({run.terrain, run.camera}, std::pair(run.frame, run.frame));
    at->second.first = std::min(at->second.first, run.frame);
    at->second.second = std::max(at->second.second, run.frame);
  }
  std::vector<CameraPath> paths;
  for (const auto& [of, frames] : ends)
    paths.push_back(
        {of.first, of.second,
         fmt::format("{} \xC2\xB7 {}", table.terrains[static_cast<std::size_t>(of.first)].name,
                     table.cameras[static_cast<std::size_t>(of.second)]),
         frame_axis(frames.first, frames.second)});
  return paths;
}

std::vector<Asked> asked_on_paths(const RunTable& table) {
  std::vector<Asked> all;
  for (const Run& run : table.runs) {
    if (!run.on_path) continue;
    const std::string& unit = table.series[static_cast<std::size_t>(run.series)].unit;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Asked& asked) {
      return asked.value == run.tolerance && asked.unit == unit;
    });
    if (found != all.end()) {
      ++found->runs;
    } else {
      all.push_back({run.tolerance, unit, 1});
    }
  }
  std::sort(all.begin(), all.end(), [](const Asked& a, const Asked& b) {
    return std::tuple(a.unit != "px", a.unit, a.value) <
           std::tuple(b.unit != "px", b.unit, b.value);
  });
  return all;
}

std::size_t first_asked(const std::vector<Asked>& all) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < all.size(); ++k)
    if (std::tuple(-all[k].runs, from_one(all[k].value)) <
        std::tuple(-all[best].runs, from_one(all[best].value)))
      best = k;
  return best;
}

}  // namespace plumb::audit::chart
