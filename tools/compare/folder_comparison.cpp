#include "compare/folder_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "compare/comparison_words.h"

namespace plumb::compare {
namespace {

int rank_of(CompareVerdict verdict) {
  switch (verdict) {
    case CompareVerdict::Fails:
      return 0;
    case CompareVerdict::None:
      return 1;
    case CompareVerdict::Passes:
      return 2;
    case CompareVerdict::Equal:
      return 3;
  }
  return 4;
}

double worst_use(const Comparison& comparison) {
  const Judgement* worst = tightest(comparison);
  return worst == nullptr ? 0.0 : use_of(*worst);
}

}  // namespace

int FolderComparison::count(CompareVerdict wanted) const {
  return static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [&](const FolderPair& pair) {
    return pair.comparison.verdict == wanted;
  }));
}

CompareVerdict FolderComparison::verdict() const {
  if (!errors.empty() || count(CompareVerdict::None) > 0) return CompareVerdict::None;
  if (!missing.empty() || count(CompareVerdict::Fails) > 0) return CompareVerdict::Fails;
  if (pairs.empty()) return CompareVerdict::None;
  return count(CompareVerdict::Passes) > 0 ? CompareVerdict::Passes : CompareVerdict::Equal;
}

std::string verdict_sentence(const FolderComparison& folders) {
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, what));
  };
  const auto add_verdict = [&](CompareVerdict verdict, const char* what) {
    add(static_cast<std::size_t>(folders.count(verdict)), what);
  };
  add(folders.missing.size(), "missing on one side");
  add(folders.errors.size(), "not comparable");
  add_verdict(CompareVerdict::Fails, "failing");
  add_verdict(CompareVerdict::None, "without a verdict");
  add_verdict(CompareVerdict::Passes, "passing");
  add_verdict(CompareVerdict::Equal, "equal");
  const std::size_t files = folders.pairs.size() + folders.missing.size() + folders.errors.size();
  if (files == 0)
    return fmt::format("There is no picture in {} and {}.", folders.reference_name,
                       folders.candidate_name);
  return fmt::format("{} against {}, profile '{}', {} file{}: {}.", folders.candidate_name,
                     folders.reference_name, folders.profile, files, files == 1 ? "" : "s",
                     fmt::join(parts, ", "));
}

std::vector<std::size_t> by_badness(const FolderComparison& folders) {
  std::vector<std::size_t> order(folders.pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> uses;
  for (const FolderPair& pair : folders.pairs) uses.push_back(worst_use(pair.comparison));
  const auto key = [&](std::size_t at) {
    const FolderPair& pair = folders.pairs[at];
    return std::tuple<int, double, const std::string&>(rank_of(pair.comparison.verdict), -uses[at],
                                                       pair.name);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

const char* missing_text(const MissingFile& file) {
  return file.in_reference ? "missing in the candidate" : "missing in the reference";
}

}  // namespace plumb::compare
