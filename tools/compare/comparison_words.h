// A comparison in words: what table, page, JSON and JUnit say alike.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/comparison.h"

namespace plumb::compare {

/// "equal", "passes", ... as people read it: "EQUAL", "PASSES", "FAILS", "NO VERDICT".
const char* verdict_label(CompareVerdict verdict);

/// One sentence without the label: what was compared, and why that is the verdict.
std::string verdict_sentence(const Comparison& comparison);

const char* name_of(Systematic kind);  // "offset", "linear-as-srgb", ...

/// A number as tables show it: whole ones with all digits, others with four; "inf", "nan"; with its
/// unit behind it.
std::string short_number(double value, const std::string& unit = "");

/// The measured value with its unit; "infinite" where there is none (the PSNR of equal pictures).
std::string value_text(const Measurement& measurement);
/// "at most 2 px", "at least 30 dB".
std::string bound_text(const Limit& limit, const Metric& metric);
/// "(12, 7)", or "-" where there is no pixel.
std::string pixel_text(int x, int y);

/// What was measured of each channel by itself.
struct ChannelTable {
  std::vector<std::string> channels;             // rows
  std::vector<std::string> metrics;              // columns: "psnr", "share_over(0.02)"
  std::vector<std::vector<std::string>> values;  // with units; "-" where there is none
};
ChannelTable channel_table(const Comparison& comparison);

/// How much of a limit is used up: measured / bound, or bound / measured where more is better.
/// Above 1, or infinite, exactly where the limit is broken; 0 where nothing differs.
double use_of(const Judgement& judgement);
/// The same in per cent: "43 %", "inf".
std::string use_text(const Judgement& judgement);
/// The judgement that uses most of its limit, the first of several; null without one.
const Judgement* tightest(const Comparison& comparison);
/// All of them, broken ones first, then by their use; what is alike keeps its order.
std::vector<const Judgement*> by_use(const Comparison& comparison);

}  // namespace plumb::compare
