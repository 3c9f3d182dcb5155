#include "audit/soundness/soundness.h"

#include <algorithm>
#include <exception>
#include <string>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::audit::soundness {
namespace {

// A case that cannot be drawn is a fault of the drawing, and must not end the others.
CaseResult result_of(const MethodTable& table, const Draws& draws, std::int64_t index) {
  CaseResult result;
  try {
    result.drawn = draw_case(table, draws.seed, index, draws.only);
    result.outcome = outcome_of(table, result.drawn.scene);
  } catch (const std::exception& error) {
    result.drawn.seed = draws.seed;
    result.drawn.index = index;
    result.outcome.ending = Ending::Failed;
    result.outcome.reason = std::string("cannot be drawn: ") + error.what();
  }
  return result;
}

}  // namespace

std::vector<CaseResult> run_cases(const MethodTable& table, const Draws& draws,
                                  const ProgressReport& report) {
  require(draws.first >= 0 && draws.count >= 0, "cases must be numbered from 0, got {} and {} more",
          draws.first, draws.count);
  if (!draws.only.empty()) draw_case(table, draws.seed, draws.first, draws.only);  // is it known?
  constexpr std::int64_t kAtATime = 100;  // between reports
  std::vector<CaseResult> results(static_cast<std::size_t>(draws.count));
  for (std::int64_t begin = 0; begin < draws.count; begin += kAtATime) {
    if (report) report(begin);
    parallel_for(std::min(kAtATime, draws.count - begin), 1, [&](std::int64_t k) {
      in_isolation([&] {
        results[static_cast<std::size_t>(begin + k)] =
            result_of(table, draws, draws.first + begin + k);
      });
    });
  }
  return results;
}

}  // namespace plumb::audit::soundness
