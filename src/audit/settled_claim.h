// The last steps of judging a claim.
#pragma once

#include <algorithm>
#include <vector>

#include "audit/audit.h"

namespace plumb::audit {

inline void settle(ClaimResult& r) {
  r.holds = r.is_measured && !(r.measured > r.claim.bound + r.slack);
}

inline void sort_worst_first(std::vector<Offender>& places, std::size_t most) {
  std::stable_sort(places.begin(), places.end(),
                   [](const Offender& a, const Offender& b) { return a.value > b.value; });
  places.resize(std::min(places.size(), most));
}

}  // namespace plumb::audit
