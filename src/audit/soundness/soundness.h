// Many random cases, and whether every conservative claim held in all of them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "audit/soundness/case.h"
#include "audit/soundness/outcome.h"

namespace plumb::audit::soundness {

struct Draws {
  std::uint64_t seed = 1;
  std::int64_t first = 0;
  std::int64_t count = 1000;
  std::string only;  // a method's name; empty: all that have a variant `conservative`
};

struct CaseResult {
  Case drawn;
  Outcome outcome;
};

/// Called now and then with how many cases are done.
using ProgressReport = std::function<void(std::int64_t done)>;

/// Draws and audits cases `first` to `first + count - 1`, as many at a time as there are threads.
///
///   (1) The same on any number of threads; a case is the same whatever else is drawn.
/// Throws InputError as draw_case does.
std::vector<CaseResult> run_cases(const MethodTable& table, const Draws& draws,
                                  const ProgressReport& report = {});

/// How many cases have each of some properties, in a fixed order.
struct Tally {
  std::string heading;
  std::vector<std::pair<std::string, std::int64_t>> counts;
};

/// How close to their bounds the claims of a method came: claimed divided by measured.
struct MethodTightness {
  std::string method;
  std::int64_t cases = 0;     // drawn
  std::int64_t measured = 0;  // with a claim that measured more than zero
  double least = 0.0, low = 0.0, median = 0.0, high = 0.0;  // low: 5 %, high: 95 %; 0 if none
};

struct Summary {
  std::int64_t draws = 0;
  std::vector<Tally> tallies;
  std::vector<MethodTightness> tightness;  // a row for each method of the table that was drawn
  std::vector<CaseResult> failures;        // those that are not sound
};
Summary summary_of(const MethodTable& table, const std::vector<CaseResult>& results);

/// The number that a tally holds under a heading and a name. Throws std::invalid_argument if it
/// holds none.
std::int64_t count_of(const Summary& summary, const std::string& heading, const std::string& name);

}  // namespace plumb::audit::soundness
