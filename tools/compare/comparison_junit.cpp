#include "compare/comparison_junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "compare/comparison_words.h"
#include "report/junit.h"

namespace plumb::compare {
namespace {

constexpr const char* kClass = "plumb.compare";

std::string details_of(const Comparison& c) {
  std::string text = verdict_sentence(c) + "\n";
  for (const std::string& reason : c.reasons) text += reason + "\n";
  for (const WorstPixel& worst : c.worst) {
    text += fmt::format("pixel {}: {} {}, reference {}, candidate {}\n",
                        pixel_text(worst.x, worst.y), worst.what,
                        short_number(worst.value, worst.unit), worst.reference, worst.candidate);
  }
  return text;
}

report::JUnitCase case_of(const std::string& name, const Comparison& c) {
  report::JUnitCase judged{kClass, name};
  if (c.verdict == CompareVerdict::Fails)
    judged.failure = {c.reasons.empty() ? verdict_sentence(c) : c.reasons.front(), details_of(c)};
  if (c.verdict == CompareVerdict::None) judged.error = verdict_sentence(c);
  return judged;
}

}  // namespace

std::string comparison_junit(const Comparison& comparison) {
  return report::to_junit_xml({"plumb compare", {case_of(comparison.candidate_name, comparison)}});
}

std::string error_junit(const std::string& name, const std::string& message) {
  return report::to_junit_xml({"plumb compare", {{kClass, name, {}, message}}});
}

std::string folder_junit(const FolderComparison& folders) {
  report::JUnitSuite suite{"plumb compare", {}};
  for (const FolderPair& pair : folders.pairs)
    suite.cases.push_back(case_of(pair.name, pair.comparison));
  for (const MissingFile& file : folders.missing)
    suite.cases.push_back({kClass, file.name, report::JUnitFailure{missing_text(file), ""}});
  for (const FolderError& error : folders.errors)
    suite.cases.push_back({kClass, error.name, {}, error.message});
  std::stable_sort(
      suite.cases.begin(), suite.cases.end(),
      [](const report::JUnitCase& a, const report::JUnitCase& b) { return a.name < b.name; });
  return report::to_junit_xml(suite);
}

}  // namespace plumb::compare
