#include "comparison_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "compare/comparison_words.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

using compare::Comparison;
using compare::Judgement;
using compare::Measurement;
using Rows = std::vector<std::vector<std::string>>;

constexpr int kWidth = 96;

std::string limits_text(const Comparison& c) {
  Rows rows;
  for (const Judgement* j : compare::by_use(c))
    rows.push_back({j->holds ? "  holds" : "! BROKEN", j->measured.name(),
                    compare::bound_text(j->limit, j->measured.info()),
                    compare::value_text(j->measured), compare::use_text(*j),
                    compare::pixel_text(j->measured.x, j->measured.y)});
  if (rows.empty()) return "";
  return "\n" + text_table({{"  verdict"},
                            {fmt::format("limit of '{}'", c.profile)},
                            {"allowed", true},
                            {"measured", true},
                            {"used", true},
                            {"worst pixel", true}},
                           rows);
}

bool is_judged(const Comparison& c, const Measurement& measurement) {
  return std::any_of(c.judgements.begin(), c.judgements.end(), [&](const Judgement& judgement) {
    return judgement.limit.is_about(measurement);
  });
}

// What no limit speaks of, with its group named once.
std::string measurements_text(const Comparison& c) {
  Rows rows;
  std::string group;
  for (const Measurement& m : c.measurements) {
    if (m.group == "channel" || is_judged(c, m)) continue;
    rows.push_back({m.group == group ? "" : m.group, m.name().substr(m.group.size() + 1),
                    compare::value_text(m), compare::pixel_text(m.x, m.y)});
    group = m.group;
  }
  if (rows.empty()) return "";
  return "\n" + text_table({{"also measured"}, {""}, {"value", true}, {"worst pixel", true}}, rows);
}

std::string channels_text(const Comparison& c) {
  const compare::ChannelTable table = compare::channel_table(c);
  if (table.channels.empty()) return "";
  std::vector<TextColumn> columns{{"channel"}};
  for (const std::string& metric : table.metrics) columns.push_back({metric, true});
  Rows rows = table.values;
  for (std::size_t row = 0; row < rows.size(); ++row)
    rows[row].insert(rows[row].begin(), table.channels[row]);
  return "\n" + text_table(columns, rows);
}

std::string facts_text(const Comparison& c) {
  std::string text;
  if (c.coverage)
    text +=
        wrapped(fmt::format("coverage: {} holes and {} overshooting pixels; {} must be terrain, "
                            "{} must be sky, {} may be either",
                            c.coverage->holes, c.coverage->overshoot, c.coverage->must_be_terrain,
                            c.coverage->must_be_sky, c.coverage->undecided),
                kWidth, 2);
  if (c.numbers.alike > 0 || c.numbers.unlike > 0)
    text += wrapped(
        fmt::format("NaN or infinite: {} alike in both, {} not{}", c.numbers.alike,
                    c.numbers.unlike, c.numbers.first.empty() ? "" : ": " + c.numbers.first),
        kWidth, 2);
  if (c.mask)
    text += wrapped(fmt::format("mask: {} pixels left out, of which {} differ and {} pass because "
                                "of the mask alone",
                                c.mask->masked, c.mask->would_differ, c.mask->would_fail),
                    kWidth, 2);
  if (!c.not_judged.empty())
    text += wrapped(fmt::format("not judged, no such channel: {}", fmt::join(c.not_judged, ", ")),
                    kWidth, 2);
  for (const std::string& note : c.notes) text += wrapped("note: " + note, kWidth, 2);
  return text.empty() ? "" : "\n" + text;
}

std::string worst_text(const Comparison& c) {
  if (c.worst.empty()) return "";
  Rows rows;
  for (const compare::WorstPixel& w : c.worst)
    rows.push_back({compare::pixel_text(w.x, w.y), w.what, compare::short_number(w.value, w.unit),
                    w.reference, w.candidate});
  return "\n" +
         text_table(
             {{"worst pixel", true}, {"what"}, {"value", true}, {"reference"}, {"candidate"}},
             rows);
}

}  // namespace

std::string comparison_text(const Comparison& c) {
  std::string text = wrapped(
      fmt::format("{}: {}", compare::verdict_label(c.verdict), compare::verdict_sentence(c)),
      kWidth, 2);
  for (const std::string& reason : c.reasons) text += wrapped("- " + reason, kWidth, 2);
  for (const compare::Diagnosis& found : c.systematic)
    text += wrapped(fmt::format("systematic: {} (RMS {} with it, {} without)", found.text,
                                compare::short_number(found.rms_before),
                                compare::short_number(found.rms_after)),
                    kWidth, 2);
  return text + limits_text(c) + measurements_text(c) + channels_text(c) + facts_text(c) +
         worst_text(c);
}

std::string folder_text(const compare::FolderComparison& folders) {
  std::string text = wrapped(fmt::format("{}: {}", compare::verdict_label(folders.verdict()),
                                         compare::verdict_sentence(folders)),
                             kWidth, 2);
  for (const compare::MissingFile& file : folders.missing)
    text +=
        wrapped(fmt::format("MISSING {}: {}", file.name, compare::missing_text(file)), kWidth, 2);
  for (const compare::FolderError& error : folders.errors)
    text += wrapped(fmt::format("ERROR {}: {}", error.name, error.message), kWidth, 2);
  Rows rows;
  for (const std::size_t at : compare::by_badness(folders)) {
    const compare::FolderPair& pair = folders.pairs[at];
    std::vector<std::string> row{compare::verdict_label(pair.comparison.verdict), pair.name, "-",
                                 "-", "-"};
    if (const Judgement* worst = compare::tightest(pair.comparison)) {
      row[2] = fmt::format("{} {}", worst->measured.name(),
                           compare::bound_text(worst->limit, worst->measured.info()));
      row[3] = compare::value_text(worst->measured);
      row[4] = compare::use_text(*worst);
    }
    rows.push_back(row);
  }
  if (rows.empty()) return text;
  return text + "\n" +
         text_table({{"verdict"}, {"file"}, {"tightest limit"}, {"measured", true}, {"used", true}},
                    rows);
}

}  // namespace plumb::tool
