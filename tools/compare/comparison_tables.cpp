#include "compare/comparison_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compare/comparison_words.h"

namespace plumb::compare {

report::Verdict banner_of(CompareVerdict verdict) {
  switch (verdict) {
    case CompareVerdict::Equal:
      return report::Verdict::Equal;
    case CompareVerdict::Passes:
      return report::Verdict::Passes;
    case CompareVerdict::Fails:
      return report::Verdict::Fails;
    case CompareVerdict::None:
      return report::Verdict::None;
  }
  return report::Verdict::None;
}

report::Table limits_table(const Comparison& c) {
  report::Table table{fmt::format("Limits of the profile '{}'", c.profile),
                      {{"limit"},
                       {"verdict"},
                       {"allowed", true},
                       {"measured", true},
                       {"used", true},
                       {"worst pixel", true}},
                      {}};
  for (const Judgement* j : by_use(c)) {
    table.rows.push_back({{j->measured.name(), j->holds ? "holds" : "BROKEN",
                           bound_text(j->limit, j->measured.info()), value_text(j->measured),
                           use_text(*j), pixel_text(j->measured.x, j->measured.y)},
                          j->holds ? report::RowKind::Ok : report::RowKind::Bad});
  }
  for (const std::string& name : c.not_judged)
    table.rows.push_back(
        {{name, "not judged: no such channel", "-", "-", "-", "-"}, report::RowKind::Plain});
  return table;
}

report::Table measurements_table(const Comparison& c) {
  report::Table table{
      "All that was measured",
      {{"measurement"}, {"value", true}, {"worst pixel", true}, {"meaning", false, true}},
      {}};
  for (const Measurement& m : c.measurements) {
    if (m.group == "channel") continue;
    table.rows.push_back({{m.name(), value_text(m), pixel_text(m.x, m.y), m.info().meaning},
                          report::RowKind::Plain});
  }
  return table;
}

report::Table channels_table(const Comparison& c) {
  const ChannelTable channels = channel_table(c);
  report::Table table{"Each channel by itself", {{"channel"}}, {}, true};
  for (const std::string& metric : channels.metrics) table.columns.push_back({metric, true});
  for (std::size_t row = 0; row < channels.channels.size(); ++row) {
    table.rows.push_back({{channels.channels[row]}, report::RowKind::Plain});
    std::vector<std::string>& cells = table.rows.back().cells;
    cells.insert(cells.end(), channels.values[row].begin(), channels.values[row].end());
  }
  return table;
}

report::Table systematic_table(const Comparison& c) {
  report::Table table{
      "Differences with a system",
      {{"kind"}, {"what it is", false, true}, {"RMS as it is", true}, {"RMS without it", true}},
      {}};
  for (const Diagnosis& found : c.systematic)
    table.rows.push_back({{name_of(found.kind), found.text, short_number(found.rms_before),
                           short_number(found.rms_after)},
                          report::RowKind::Bad});
  return table;
}

std::vector<report::KeyValue> shape_entries(const Comparison& c) {
  std::vector<report::KeyValue> entries;
  if (c.coverage) {
    entries.push_back({"pixels that must be terrain, must be sky, may be either",
                       fmt::format("{}, {}, {}", c.coverage->must_be_terrain,
                                   c.coverage->must_be_sky, c.coverage->undecided)});
    entries.push_back({"holes: sky where terrain must be", std::to_string(c.coverage->holes)});
    entries.push_back(
        {"overshoot: terrain where sky must be", std::to_string(c.coverage->overshoot)});
  } else {
    entries.push_back({"coverage", "not known: neither depth nor alpha"});
  }
  entries.push_back(
      {"numbers that are NaN or infinite, alike in both", std::to_string(c.numbers.alike)});
  entries.push_back({"numbers that are NaN or infinite, not alike",
                     c.numbers.first.empty()
                         ? std::to_string(c.numbers.unlike)
                         : fmt::format("{}, the first: {}", c.numbers.unlike, c.numbers.first)});
  if (c.mask) {
    entries.push_back({"pixels that the mask leaves out", std::to_string(c.mask->masked)});
    entries.push_back({"of these, pixels that differ", std::to_string(c.mask->would_differ)});
    entries.push_back({"of these, pixels that pass because of the mask alone",
                       std::to_string(c.mask->would_fail)});
  }
  return entries;
}

std::vector<report::KeyValue> subject_entries(const Comparison& c, const std::string& command) {
  return {{"reference", c.reference_name},
          {"candidate", c.candidate_name},
          {"size", fmt::format("{} x {} px", c.width_px, c.height_px)},
          {"numbers", c.encoding},
          {"channels", fmt::format("{}", fmt::join(c.channels, " "))},
          {"profile", c.profile},
          {"made again by", command}};
}

report::OffenderList worst_list(const Comparison& c, const std::string& viewer_id) {
  report::OffenderList list{
      "Worst pixels", viewer_id, {{"what"}, {"value", true}, {"reference"}, {"candidate"}}, {}};
  for (const WorstPixel& worst : c.worst)
    list.offenders.push_back(
        {worst.x,
         worst.y,
         {worst.what, short_number(worst.value, worst.unit), worst.reference, worst.candidate}});
  return list;
}

}  // namespace plumb::compare
