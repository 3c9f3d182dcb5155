// Which methods break what they claim, how often and by how much.
#pragma once

#include <cstdint>
#include <vector>

#include "audit/chart/run_table.h"

namespace plumb::audit::chart {

/// All runs of one series over one terrain.
struct BrokenClaims {
  int terrain = 0, series = 0;  // rows of the table's lists
  int judged = 0;               // runs with a verdict
  int broken = 0;               // of these
  int by_error = 0;             // of these: measured beyond what was claimed, in pixels or metres
  int by_coverage = 0;          // of these: with holes, overshoots or see-through cracks
  int by_patches = 0;           // of these: with patches that break a claim of their own
  double worst_ratio = 0.0;     // measured over claimed, of the claims of errors that are broken
  int worst_run = -1;           // a row of the runs; -1: none
  int worst_claim = -1;         // a row of its claims
  double most_pixels = 0.0;     // wrong ones of one picture
};

/// Of each terrain and series with a judged run, sorted by these. A ratio is +inf where zero was
/// claimed or infinity measured; of equal ratios the first run's stands.
std::vector<BrokenClaims> broken_claims(const RunTable& table);

}  // namespace plumb::audit::chart
