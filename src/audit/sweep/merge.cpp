#include "audit/sweep/merge.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/check.h"

namespace plumb::audit::sweep {
namespace {

bool is_timed(const ResultLine& line) { return line.status == "done" && !line.shared_times; }

// Which of two lines of one run is kept: 0 or 1.
bool second_is_better(const ResultLine& first, const ResultLine& second, const std::string& where) {
  if (result_text(first) != result_text(second))
    input_error("{}: run {} ({}) has another result there", where, first.key, first.run);
  return is_timed(second) && !is_timed(first);
}

}  // namespace

std::vector<ResultLine> merged(const std::vector<NamedResults>& parts) {
  struct Place {
    const ResultLine* line;
    const NamedResults* part;
  };
  std::map<std::string, Place> by_key;
  for (const NamedResults& part : parts) {
    for (const ResultLine& line : part.lines) {
      const auto [found, is_new] = by_key.try_emplace(line.key, Place{&line, &part});
      Place& place = found->second;
      if (is_new) continue;
      if (second_is_better(*place.line, line, place.part->name + " and " + part.name))
        place = {&line, &part};
    }
  }
  std::map<std::int64_t, Place> by_index;
  for (const auto& [key, place] : by_key) {
    const auto [found, is_new] = by_index.try_emplace(place.line->index, place);
    if (!is_new)
      input_error(
          "{} and {} are no parts of one sweep: the place {} of its order is that of run {} ({}) "
          "and of run {} ({})",
          found->second.part->name, place.part->name, place.line->index, found->second.line->key,
          found->second.line->run, key, place.line->run);
  }
  std::vector<ResultLine> lines;
  for (const auto& [index, place] : by_index) lines.push_back(*place.line);
  return lines;
}

Resumed resumed(const SweepPlan& plan, const std::vector<ResultLine>& lines,
                const RerunOptions& rerun) {
  std::map<std::string, std::size_t> places;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) places[plan.runs[k].key] = k;
  Resumed result;
  std::map<std::size_t, const ResultLine*> kept;
  for (const ResultLine& line : lines) {
    const auto place = places.find(line.key);
    if (place == places.end()) {
      result.others.push_back(line);
    } else if ((rerun.failed && line.status == "failed") ||
               (rerun.shared_times && line.status == "done" && line.shared_times)) {
      result.stale.push_back(line);
    } else {
      const auto [found, is_new] = kept.try_emplace(place->second, &line);
      if (!is_new && second_is_better(*found->second, line, "two lines")) found->second = &line;
    }
  }
  for (const auto& [index, line] : kept)
    result.kept.push_back(with_index(*line, static_cast<std::int64_t>(index)));
  return result;
}

}  // namespace plumb::audit::sweep
