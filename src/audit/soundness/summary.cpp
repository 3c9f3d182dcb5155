// What a run of cases reached, and how close its claims came to their bounds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "audit/soundness/soundness.h"
#include "core/check.h"
#include "terrain/generators.h"

namespace plumb::audit::soundness {
namespace {

using Results = std::vector<CaseResult>;

// Counts under names, in the order in which the names were given.
class Counter {
 public:
  Counter(const std::string& heading, const std::vector<std::string>& names) {
    tally_.heading = heading;
    for (const std::string& name : names) tally_.counts.emplace_back(name, 0);
  }
  void add(const std::string& name, bool counts = true) {
    for (auto& [known, count] : tally_.counts) {
      if (known == name) {
        count += counts;
        return;
      }
    }
    tally_.counts.emplace_back(name, counts ? 1 : 0);
  }
  const Tally& tally() const { return tally_; }

 private:
  Tally tally_;
};

// The first limit that a value is below, in words.
struct Step {
  double below;
  const char* name;
};

template <std::size_t N>
const char* step_of(double value, const Step (&steps)[N]) {
  for (const Step& step : steps) {
    if (value < step.below) return step.name;
  }
  return steps[N - 1].name;
}

template <std::size_t N>
std::vector<std::string> names_of(const Step (&steps)[N]) {
  std::vector<std::string> names;
  for (const Step& step : steps) names.emplace_back(step.name);
  return names;
}

constexpr Step kSides[] = {{2, "1"},         {4, "2 to 3"},    {10, "4 to 9"},
                           {34, "10 to 33"}, {66, "34 to 65"}, {1e9, "66 and more"}};
constexpr Step kPixels[] = {{1.0, "0.1 to 1 px"}, {10.0, "1 to 10 px"}, {1e9, "10 to 64 px"}};
constexpr Step kReliefs[] = {{1e-12, "level"}, {1e-3, "below 1/1000"}, {3e-2, "to 3/100"},
                             {0.3, "to 3/10"}, {3.0, "to 3"},          {1e18, "above 3"}};
constexpr Step kLenses[] = {
    {1.0, "below 1 degree"}, {25.0, "1 to 25"}, {95.0, "25 to 95"}, {180.0, "95 to 172"}};

template <std::size_t N, class Value>
Tally by_steps(const Results& results, const char* heading, const Step (&steps)[N],
               const Value& value) {
  Counter counter(heading, names_of(steps));
  for (const CaseResult& result : results) counter.add(step_of(value(result.drawn), steps));
  return counter.tally();
}

Tally by_generator(const Results& results) {
  std::vector<std::string> names;
  for (const terrain::GeneratorHelp& help : terrain::generator_help()) names.push_back(help.name);
  names.emplace_back("caves (top)");
  Counter counter("terrain", names);
  for (const CaseResult& result : results) counter.add(result.drawn.traits.generator);
  return counter.tally();
}

Tally by_placement(const Results& results) {
  std::vector<std::string> names;
  for (int k = 0; k < kPlacements; ++k) names.emplace_back(name_of(static_cast<Placement>(k)));
  Counter counter("camera", names);
  for (const CaseResult& result : results) counter.add(name_of(result.drawn.traits.placement));
  return counter.tally();
}

Tally by_method(const MethodTable& table, const Results& results) {
  std::vector<std::string> names;
  for (const Method& method : table) names.push_back(method.name);
  Counter counter("method", names);
  for (const CaseResult& result : results) counter.add(result.drawn.scene.method);
  return counter.tally();
}

Tally by_tolerance(const Results& results) {
  std::vector<std::string> names = names_of(kPixels);
  names.emplace_back("in metres");
  Counter counter("tolerance", names);
  for (const CaseResult& result : results) {
    const Tolerance& tolerance = result.drawn.scene.tolerance;
    counter.add(tolerance.unit == Unit::Metre ? "in metres" : step_of(tolerance.value, kPixels));
  }
  return counter.tally();
}

// Properties that a case may have several of.
Tally properties(const Results& results) {
  Counter counter("reached", {});
  for (const CaseResult& result : results) {
    const Traits& t = result.drawn.traits;
    counter.add("sides of different length", t.columns != t.rows);
    counter.add("an even number of samples along a side", t.columns % 2 == 0 || t.rows % 2 == 0);
    counter.add("cells that are not square", t.not_square_cells);
    counter.add("an origin beyond 100 km", t.far_origin);
    counter.add("a window", t.windowed);
    counter.add("voids", t.void_part > 0.0);
    counter.add("voids over more than half", t.void_part > 0.5);
    counter.add("voids that were filled", t.filled);
    counter.add("the eye below the ground", t.below_ground);
    counter.add("the camera rolled", t.rolled);
    counter.add("a centre off the picture's middle", t.off_centre);
    counter.add("near or far planes of its own", t.clipped);
    counter.add("the terrain tilted", t.tilted);
  }
  return counter.tally();
}

Tally endings(const Results& results) {
  Counter counter("outcome", {"held", "broken", "failed"});
  for (const CaseResult& result : results) {
    const Outcome& o = result.outcome;
    const std::string refusal = stated_refusal(o);
    counter.add(o.ending == Ending::None
                    ? "no verdict: " + std::string(o.reason.substr(0, o.reason.find(" (")))
                : refusal.empty() ? name_of(o.ending)
                                  : "refused: " + refusal);
  }
  return counter.tally();
}

Tally measured(const Results& results) {
  Counter counter("measured", {});
  for (const CaseResult& result : results) {
    const Outcome& o = result.outcome;
    counter.add("some of the terrain in the picture", o.pixels_seen > 0);
    counter.add("a claim of the frame", o.claims > 0);
    counter.add("a claim of a patch", o.patch_claims > 0);
    counter.add("an error above zero", o.tightness.has_value());
    counter.add("within twice of its bound", o.tightness && *o.tightness < 2.0);
    counter.add("nothing promised but coverage", o.ending == Ending::Held && o.promises_nothing);
  }
  return counter.tally();
}

MethodTightness tightness_of(const std::string& method, const Results& results) {
  MethodTightness row;
  row.method = method;
  std::vector<double> values;
  for (const CaseResult& result : results) {
    if (result.drawn.scene.method != method) continue;
    ++row.cases;
    if (result.outcome.tightness) values.push_back(*result.outcome.tightness);
  }
  row.measured = static_cast<std::int64_t>(values.size());
  if (values.empty()) return row;
  std::sort(values.begin(), values.end());
  const auto at = [&](double part) {
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
  };
  row.least = values.front();
  row.low = at(0.05);
  row.median = at(0.5);
  row.high = at(0.95);
  return row;
}

}  // namespace

Summary summary_of(const MethodTable& table, const std::vector<CaseResult>& results) {
  Summary summary;
  summary.draws = static_cast<std::int64_t>(results.size());
  const auto longer = [](const Case& c) { return std::max(c.traits.columns, c.traits.rows); };
  const auto shorter = [](const Case& c) { return std::min(c.traits.columns, c.traits.rows); };
  summary.tallies = {
      by_method(table, results),
      by_generator(results),
      by_steps(results, "samples along the longer side", kSides, longer),
      by_steps(results, "along the shorter side", kSides, shorter),
      by_steps(results, "relief per length", kReliefs,
               [](const Case& c) { return c.traits.relief_part; }),
      by_placement(results),
      by_steps(results, "field of view", kLenses, [](const Case& c) { return c.traits.fov_y_deg; }),
      by_tolerance(results),
      properties(results),
      measured(results),
      endings(results)};
  for (const Method& method : table) {
    MethodTightness row = tightness_of(method.name, results);
    if (row.cases > 0) summary.tightness.push_back(row);
  }
  for (const CaseResult& result : results) {
    if (!is_sound(result.outcome)) summary.failures.push_back(result);
  }
  return summary;
}

std::int64_t count_of(const Summary& summary, const std::string& heading, const std::string& name) {
  for (const Tally& tally : summary.tallies) {
    if (tally.heading != heading) continue;
    for (const auto& [known, count] : tally.counts) {
      if (known == name) return count;
    }
  }
  require(false, "there is no count of {} under {}", name, heading);
  return 0;
}

}  // namespace plumb::audit::soundness
