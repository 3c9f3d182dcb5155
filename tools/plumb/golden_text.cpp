#include "golden_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/comparison_words.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

constexpr std::size_t kMostReasons = 3, kMostPixels = 5;
constexpr int kWidth = 96;

using Rows = std::vector<std::vector<std::string>>;

std::string indented(const std::string& text) {
  std::string result = "  ";
  for (const char c : text) {
    result += c;
    if (c == '\n') result += "  ";
  }
  result.resize(result.size() - 2);
  return result;
}

// Metrics and their verdict, which decides only where the case has a tolerance.
std::string metrics_text(const GoldenCheck& check) {
  if (!check.comparison) return "";
  const compare::Comparison& c = *check.comparison;
  std::string text = wrapped(
      fmt::format("profile '{}'{}: {}: {}", c.profile,
                  check.tolerance == "none" ? " (the case is bit for bit: it decides nothing)" : "",
                  compare::verdict_label(c.verdict), compare::verdict_sentence(c)),
      kWidth, 2);
  for (std::size_t k = 0; k < std::min(c.reasons.size(), kMostReasons); ++k)
    text += wrapped("- " + c.reasons[k], kWidth, 2);
  if (const compare::Judgement* tightest = compare::tightest(c); tightest != nullptr && c.passes())
    text += wrapped(fmt::format("- tightest limit: {} {}, measured {}", tightest->measured.name(),
                                compare::bound_text(tightest->limit, tightest->measured.info()),
                                compare::value_text(tightest->measured)),
                    kWidth, 2);
  return indented(text);
}

bool shows_patches(const GoldenCheck& check) {
  return !check.patches_golden.empty() &&
         (check.patches_golden.front() || check.patches_now.front());
}

std::string worst_text(const GoldenCheck& check) {
  if (!check.comparison || check.comparison->worst.empty()) return "";
  const std::vector<compare::WorstPixel>& worst = check.comparison->worst;
  const bool patches = shows_patches(check);
  std::vector<TextColumn> columns{
      {"worst pixel", true}, {"what"}, {"value", true}, {"golden"}, {"now"}};
  if (patches) columns.insert(columns.end(), {{"patch in golden"}, {"patch now"}});
  Rows rows;
  for (std::size_t k = 0; k < std::min(worst.size(), kMostPixels); ++k) {
    const compare::WorstPixel& w = worst[k];
    rows.push_back({compare::pixel_text(w.x, w.y), w.what, compare::short_number(w.value, w.unit),
                    w.reference, w.candidate});
    if (patches) {
      rows.back().push_back(text_of(check.patches_golden[k]));
      rows.back().push_back(text_of(check.patches_now[k]));
    }
  }
  return indented(text_table(columns, rows));
}

std::string patch_text(const GoldenCheck& check) {
  if (!check.responsible) return "";
  const PatchShare& share = *check.responsible;
  return fmt::format("  patch responsible: {}{}, with {} of the {} pixels that differ\n",
                     text_of(std::optional(share.patch)), share.is_now ? "" : " of the golden",
                     share.pixels, share.of);
}

std::string files_text(const GoldenCheck& check) {
  std::string text;
  const auto line = [&](const char* what, const std::filesystem::path& file) {
    if (!file.empty()) text += fmt::format("  {:<12}{}\n", what, file.string());
  };
  line("golden:", check.files.golden);
  line("actual:", check.files.actual);
  line("difference:", check.files.difference);
  line("report:", check.files.page);
  return text;
}

std::string quoted_command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"plumb", "golden"});
  return Invocation{arguments}.command_line();
}

}  // namespace

NextSteps next_steps(const GoldenOptions& options, const GoldenCheck& check) {
  std::vector<std::string> common{check.name, "--folder", options.folder};
  if (!options.actual.empty()) common.insert(common.end(), {"--actual", options.actual});
  std::vector<std::string> see{"check"}, accept{"update"};
  see.insert(see.end(), common.begin(), common.end());
  see.insert(see.end(), {"-o", "golden_report"});
  accept.insert(accept.end(), common.begin(), common.end());
  accept.emplace_back("--accept");
  NextSteps steps;
  if (check.found == 0) return steps;  // there is no picture to look at
  steps.see = quoted_command(see);
  if (check.verdict != GoldenVerdict::Failed) steps.accept = quoted_command(accept);
  return steps;
}

std::string case_text(const GoldenOptions& options, const GoldenCheck& check, bool with_metrics) {
  std::string text = fmt::format("{}: {}{}{}\n", check.name, name_of(check.verdict),
                                 check.message.empty() ? "" : ": ", check.message);
  text += text_of(check.channels);
  if (with_metrics) text += metrics_text(check);
  if (with_metrics || shows_patches(check)) text += worst_text(check);
  text += patch_text(check) + files_text(check);
  const NextSteps steps = next_steps(options, check);
  if (!steps.see.empty() && check.files.page.empty())
    text += fmt::format("  {:<12}{}\n", "to see:", steps.see);
  if (!steps.accept.empty()) text += fmt::format("  {:<12}{}\n", "to accept:", steps.accept);
  return text;
}

std::string check_text(const GoldenOptions& options, const std::vector<GoldenCheck>& checks,
                       const std::vector<std::string>& strays) {
  Rows rows;
  std::string details;
  for (const GoldenCheck& check : checks) {
    rows.push_back(
        {check.name, name_of(check.verdict), check.tolerance, checksum_digits(check.expected)});
    if (check.verdict != GoldenVerdict::Same) details += "\n" + case_text(options, check);
  }
  if (!strays.empty()) details += "\nno case names:\n";
  for (const std::string& stray : strays) details += "  " + stray + "\n";
  return text_table({{"case"}, {"verdict"}, {"tolerance"}, {"checksum"}}, rows) + details;
}

}  // namespace plumb::tool
