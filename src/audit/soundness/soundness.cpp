#include "audit/soundness/soundness.h"

#include <algorithm>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::audit::soundness {

std::vector<CaseResult> run_cases(const MethodTable& table, const Draws& draws,
                                  const ProgressReport& report) {
  require(draws.first >= 0 && draws.count >= 0, "cases must be numbered from 0, got {} and {} more",
          draws.first, draws.count);
  constexpr std::int64_t kAtATime = 100;  // between reports
  std::vector<CaseResult> results(static_cast<std::size_t>(draws.count));
  for (std::int64_t begin = 0; begin < draws.count; begin += kAtATime) {
    if (report) report(begin);
    parallel_for(std::min(kAtATime, draws.count - begin), 1, [&](std::int64_t k) {
      in_isolation([&] {
        CaseResult& result = results[static_cast<std::size_t>(begin + k)];
        result.drawn = draw_case(table, draws.seed, draws.first + begin + k, draws.only);
        result.outcome = outcome_of(table, result.drawn.scene);
      });
    });
  }
  return results;
}

}  // namespace plumb::audit::soundness
