#include "audit/plan/choice.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace plumb::audit::plan {
namespace {

void require_sound(const std::vector<Candidate>& candidates, const Search& search) {
  if (!(search.error > 0.0)) throw std::invalid_argument("error must be above zero");
  if (search.family.size() != candidates.size())
    throw std::invalid_argument("family must have one entry a candidate");
  for (const std::size_t view : search.held_out) {
    if (view >= search.views) throw std::invalid_argument("held-out views must be below `views`");
  }
  for (const Candidate& candidate : candidates) {
    for (const Measurement& m : candidate.measurements) {
      if (m.view >= search.views) throw std::invalid_argument("views must be below `views`");
    }
  }
}

// Nothing unless every view of the set was measured, and the claims held where they must.
std::optional<Worth> worth_over(const Candidate& candidate, std::size_t index,
                                const std::vector<bool>& in_set, bool claims_must_hold) {
  Worth worth{index, -1.0, 0.0, 0.0, 0};
  std::vector<bool> seen(in_set.size(), false);
  std::size_t views = 0;
  for (const Measurement& m : candidate.measurements) {
    if (!in_set[m.view] || seen[m.view]) continue;
    seen[m.view] = true;
    ++views;
    worth.cost += m.cost;
    worth.triangles += m.triangles;
    const double error =
        claims_must_hold && !m.keeps_claims ? std::numeric_limits<double>::infinity() : m.error;
    if (error > worth.error) {
      worth.error = error;
      worth.worst_view = m.view;
    }
  }
  if (views == 0 || seen != in_set) return std::nullopt;
  worth.cost /= static_cast<double>(views);
  worth.triangles /= static_cast<double>(views);
  return worth;
}

bool is_cheaper(const Worth& a, const Worth& b) {
  return std::tie(a.cost, a.triangles, a.candidate) < std::tie(b.cost, b.triangles, b.candidate);
}

bool is_nearer(const Worth& a, const Worth& b) {
  return std::tie(a.error, a.cost, a.candidate) < std::tie(b.error, b.cost, b.candidate);
}

void settle(Choice& choice, const std::vector<Candidate>& candidates, const Search& search,
            const std::vector<bool>& held_out) {
  std::sort(choice.fitting.begin(), choice.fitting.end(), is_cheaper);
  if (choice.fitting.empty()) return;
  choice.best = choice.fitting.front();
  choice.dearest = choice.fitting.back();
  const std::size_t family = search.family[choice.best->candidate];
  for (const Worth& worth : choice.fitting) {
    if (search.family[worth.candidate] == family) continue;
    choice.runner_up = worth;
    break;
  }
  choice.held_out = worth_over(candidates[choice.best->candidate], choice.best->candidate, held_out,
                               search.claims_must_hold);
}

}  // namespace

std::vector<std::size_t> views_held_out(std::size_t views, std::size_t every) {
  std::vector<std::size_t> held_out;
  if (views < 3 || every < 2) return held_out;
  for (std::size_t k = views; k > 0; k -= std::min(k, every)) held_out.push_back(k - 1);
  if (held_out.size() == views) held_out.pop_back();
  std::reverse(held_out.begin(), held_out.end());
  return held_out;
}

Choice choose(const std::vector<Candidate>& candidates, const Search& search) {
  require_sound(candidates, search);
  std::vector<bool> searched(search.views, true), held_out(search.views, false);
  for (const std::size_t view : search.held_out) {
    searched[view] = false;
    held_out[view] = true;
  }
  if (std::find(searched.begin(), searched.end(), true) == searched.end())
    throw std::invalid_argument("not all views can be held out");
  Choice choice;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const auto worth = worth_over(candidates[k], k, searched, search.claims_must_hold);
    ++(worth ? choice.candidates : choice.incomplete);
    if (!worth) continue;
    if (worth->error <= search.error) choice.fitting.push_back(*worth);
    if (!choice.nearest || is_nearer(*worth, *choice.nearest)) choice.nearest = *worth;
  }
  settle(choice, candidates, search, held_out);
  if (choice.best) choice.nearest.reset();
  return choice;
}

}  // namespace plumb::audit::plan
