#include "audit/patch_claims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "audit/surface_deviation.h"
#include "core/check.h"

namespace plumb::audit {
namespace {

ClaimResult judged(const Claim& claim, const SampleErrors& samples, double slack_m) {
  require(
      claim.measure == Measure::SampleError && claim.unit == Unit::Metre && claim.patch >= 0 &&
          claim.patch < static_cast<int>(samples.patch_max_m.size()),
      "a patch may claim its sample error in metres, and must exist; got {} in '{}' for patch {}",
      name_of(claim.measure), name_of(claim.unit), claim.patch);
  const double most_m = samples.patch_max_m[static_cast<std::size_t>(claim.patch)];
  ClaimResult r;
  r.claim = claim;
  r.label = name_of(claim.measure);
  r.is_measured = most_m >= 0.0;
  r.measured = std::max(most_m, 0.0);
  r.slack = slack_m;
  r.holds = r.is_measured && !(r.measured > claim.bound + r.slack);
  return r;
}

// Broken ones first, the worst of them before all, then the tightest; what was not measured last.
void sort_by_excess(std::vector<ClaimResult>& claims) {
  const auto excess = [](const ClaimResult& r) {
    return r.is_measured ? r.measured - r.claim.bound : -std::numeric_limits<double>::infinity();
  };
  std::stable_sort(claims.begin(), claims.end(), [&](const ClaimResult& a, const ClaimResult& b) {
    return excess(a) > excess(b);
  });
}

// Samples over the bound of a claim.
struct Over {
  std::int64_t samples = 0;
  WorstSample worst;

  void add(const WorstSample& sample) {
    ++samples;
    if (worst.i < 0 || sample.error > worst.error) worst = sample;
  }
  void join(const Over& other) {
    samples += other.samples;
    if (worst.i < 0 || other.worst.error > worst.error) worst = other.worst;
  }
};
using OverByClaim = std::map<std::size_t, Over>;

// Goes through all samples once more, for claims that are known to be broken.
OverByClaim samples_over(const HeightfieldTruth& truth, const DrawnSurface& surface,
                         const std::vector<ClaimResult>& broken) {
  std::vector<std::vector<std::size_t>> of_patch(std::max<std::size_t>(1, surface.patches.size()));
  for (std::size_t k = 0; k < broken.size(); ++k)
    of_patch[static_cast<std::size_t>(broken[k].claim.patch)].push_back(k);
  std::vector<OverByClaim> rows(static_cast<std::size_t>(truth.field().rows()));
  for_each_sample_row(truth.field(), *surface.mesh, nullptr, [&](int j, const DeviationRow& row) {
    int patch = -1;
    for (int i = 0; i < truth.field().columns(); ++i) {
      const Deviation there = row[i];
      if (!there.covered()) continue;
      patch = patch_of(surface, there.triangle, patch);
      const double metres = std::abs(there.delta_m);
      for (const std::size_t k : of_patch[static_cast<std::size_t>(patch)]) {
        if (metres > broken[k].claim.bound + broken[k].slack)
          rows[static_cast<std::size_t>(j)][k].add(
              {i, j, metres, there.delta_m, there.triangle, patch});
      }
    }
  });
  OverByClaim all;
  for (const OverByClaim& row : rows) {
    for (const auto& [claim, over] : row) all[claim].join(over);
  }
  return all;
}

}  // namespace

std::vector<ClaimResult> check_patch_claims(AuditResult& result, const HeightfieldTruth& truth,
                                            const DrawnSurface& surface,
                                            const OffenderFinder& finder, int most_listed) {
  std::vector<ClaimResult> claims;
  for (const Claim& claim : surface.claims) {
    if (claim.scope == Scope::Patch) claims.push_back(judged(claim, result.samples, truth.slack_m));
  }
  const auto count = [&](auto is_so) { return std::count_if(claims.begin(), claims.end(), is_so); };
  result.patch_claims = count([](const ClaimResult& r) { return r.is_measured; });
  result.patch_claims_broken = count([](const ClaimResult& r) { return r.is_broken(); });
  sort_by_excess(claims);
  const std::int64_t shown =
      std::clamp<std::int64_t>(result.patch_claims_broken, 1, std::max(1, most_listed));
  claims.resize(std::min(claims.size(), static_cast<std::size_t>(shown)));
  if (result.patch_claims_broken == 0) return claims;
  for (const auto& [k, over] : samples_over(truth, surface, claims)) {
    claims[k].violations = over.samples;
    claims[k].worst = finder.at_sample(claims[k].label, over.worst, Unit::Metre);
    claims[k].places = {*claims[k].worst};
  }
  return claims;
}

}  // namespace plumb::audit
