#include "audit/chart/broken_claims.h"

#include <algorithm>
#include <limits>
#include <map>

namespace plumb::audit::chart {
namespace {

double ratio_of(const ClaimedAndMeasured& claim) {
  return claim.claimed > 0.0 ? claim.measured / claim.claimed
                             : std::numeric_limits<double>::infinity();
}

void add(BrokenClaims& all, const RunTable& table, std::size_t row) {
  const Run& run = table.runs[row];
  bool by_error = false;
  for (std::size_t k = 0; k < run.claims.size(); ++k) {
    if (run.claims[k].holds) continue;
    by_error = true;
    if (ratio_of(run.claims[k]) <= all.worst_ratio) continue;
    all.worst_ratio = ratio_of(run.claims[k]);
    all.worst_run = static_cast<int>(row);
    all.worst_claim = static_cast<int>(k);
  }
  ++all.judged;
  all.broken += run.verdict == "broken";
  all.by_error += by_error;
  all.by_coverage += run.wrong_pixels > 0.0;
  all.by_patches += run.wrong_patches > 0;
  all.most_pixels = std::max(all.most_pixels, run.wrong_pixels);
}

}  // namespace

std::vector<BrokenClaims> broken_claims(const RunTable& table) {
  std::map<std::pair<int, int>, BrokenClaims> groups;
  for (std::size_t row = 0; row < table.runs.size(); ++row) {
    const Run& run = table.runs[row];
    if (run.verdict == "none") continue;
    BrokenClaims& group = groups[{run.terrain, run.series}];
    group.terrain = run.terrain;
    group.series = run.series;
    add(group, table, row);
  }
  std::vector<BrokenClaims> all;
  for (const auto& [key, group] : groups) all.push_back(group);
  return all;
}

}  // namespace plumb::audit::chart
