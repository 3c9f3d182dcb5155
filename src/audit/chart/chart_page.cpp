#include "audit/chart/chart_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "audit/chart/camera_paths.h"
#include "audit/chart/chart_data.h"
#include "audit/chart/plain_charts.h"
#include "audit/chart/scales.h"
#include "report/html_page.h"
#include "report/web_assets.h"

namespace plumb::audit::chart {
namespace {

constexpr std::size_t kMostListed = 200;

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string summary(const RunTable& table) {
  return fmt::format(
      "{} over {} by {} are charted; {} failed and {} were skipped (listed at the end).",
      counted(table.runs.size(), "finished run", "finished runs"),
      counted(table.terrains.size(), "terrain", "terrains"),
      counted(table.series.size(), "method or variant", "methods and variants"),
      table.failed.size(), table.skipped.size());
}

// Reasons with their counts, then the runs themselves.
void add_unfinished(report::HtmlPage& page, const char* caption,
                    const std::vector<Unfinished>& runs) {
  if (runs.empty()) return;
  std::map<std::string, std::size_t> reasons;
  for (const Unfinished& run : runs) ++reasons[run.error];
  report::Table counts{fmt::format("{} runs {}", runs.size(), caption),
                       {{"reason", false, true}, {"runs", true}},
                       {}};
  for (const auto& [reason, count] : reasons)
    counts.rows.push_back({{reason, std::to_string(count)}});
  page.add_table(counts);
  const std::size_t listed = std::min(runs.size(), kMostListed);
  report::Table table{
      listed < runs.size() ? fmt::format("The first {} of them", listed) : "Which they are",
      {{"run", false, true}, {"reason", false, true}},
      {},
      true};
  for (std::size_t k = 0; k < listed; ++k) table.rows.push_back({{runs[k].what, runs[k].error}});
  page.add_table(table);
}

std::vector<report::KeyValue> origin(const PageInput& input) {
  std::vector<report::KeyValue> entries{{"results", input.results},
                                        {"measured by plumb", input.table.program},
                                        {"made again by", input.command}};
  if (input.table.torn)
    entries.push_back({"left out", "the last line, which ends within itself: a run in flight"});
  if (input.table.repeated > 0)
    entries.push_back({"left out", fmt::format("{} lines of runs that stood there before",
                                               input.table.repeated)});
  return entries;
}

std::string templates_json() {
  std::string json = "{";
  for (const ChartWords& chart : charts())
    json += fmt::format("{}\"{}\":{}", json.size() > 1 ? "," : "", chart.name,
                        report::chart_template(chart.name));
  return json + "}";
}

}  // namespace

const std::vector<ChartWords>& charts() {
  static const std::vector<ChartWords> kCharts{
      {"cost-error", "What does accuracy cost?",
       "Each small point is one run: one picture of one terrain. A large marker is the median over "
       "all views of one terrain at one tolerance, and a curve joins a method's tolerances. Lower "
       "left is best: less error for less work. The broad grey steps are the Pareto front: no "
       "method, shown or hidden, has a median with both less error and less cost. Both axes are "
       "logarithmic; 0 and \xE2\x88\x9E have shaded places of their own, and what is below a "
       "millionth of a pixel is "
       "rounding and counts as 0."},
      {"claims", "Do methods keep what they claim?",
       "Each point is one run: across, the error that the method claims to stay below; upwards, "
       "what was measured. On the dashed line both are the same. Above it the claim is broken (a "
       "dark rim, a larger mark); far below it the method worked harder than it had to."},
      {"path", "How steady is it while the camera moves?",
       "Frame after frame along one camera path, all methods asked for the same tolerance. Low and "
       "flat is best: a spike is a frame that is wrong or slow, and popping is what an eye sees "
       "jump between two frames."},
      {"winners", "Where does each method win?",
       "For each kind of terrain and each error: the method that draws most cheaply among those "
       "whose error is at most this in every view of that kind, and no pixel wrong (holes, "
       "overshoots, see-through). The cost is the median over these views. A setting that was not "
       "finished in all of them does not compete."}};
  return kCharts;
}

std::vector<PrintedChart> printed_charts(const RunTable& table) {
  std::vector<PrintedChart> list;
  if (!costs_there(table).empty()) list.push_back({"cost-error", "cost-error"});
  if (!claim_measures(table).empty()) list.push_back({"claims", "claims"});
  const std::size_t paths = paths_of(table).size();
  for (std::size_t k = 0; k < paths; ++k)
    list.push_back({k == 0 ? "path" : fmt::format("path-{}", k + 1), "path", k});
  if (!costs_there(table).empty()) list.push_back({"winners", "winners"});
  return list;
}

std::string plain_chart(const PrintedChart& chart, const PageInput& input) {
  if (chart.chart == "cost-error") return plain_cost_chart(input.table, input.settings, input.cost);
  if (chart.chart == "claims") return plain_claim_chart(input.table);
  if (chart.chart == "path") return plain_path_chart(input.table, input.cost, chart.path);
  return plain_winner_chart(input.table, input.cost);
}

namespace {

void add_charts(report::HtmlPage& page, const PageInput& input) {
  const std::vector<PrintedChart> there = printed_charts(input.table);
  for (const ChartWords& words : charts()) {
    std::vector<PrintedChart> own;
    for (const PrintedChart& chart : there)
      if (chart.chart == words.name) own.push_back(chart);
    page.add_heading(words.title);
    if (own.empty()) {
      page.add_paragraph("These results have nothing for this chart.");
      continue;
    }
    page.add_paragraph(words.words);
    if (!input.library.empty()) {
      page.add_live_chart(words.name, words.title);
      continue;
    }
    for (const PrintedChart& chart : own) page.add_chart(words.title, plain_chart(chart, input));
  }
}

void add_maps(report::HtmlPage& page, const PageInput& input) {
  page.add_heading("Where in the picture are error and cost?");
  if (input.maps_of.empty()) {
    page.add_paragraph(
        "Maps are made on request, as each needs its run once more: plumb chart --maps worst shows "
        "the run with the largest error of each method and variant, --maps TERRAIN/CAMERA all of "
        "them in one view.");
    return;
  }
  page.add_paragraph(
      input.maps_of == "worst"
          ? "Of each method and variant the run with the largest error. Left: how wrong each pixel "
            "is; then how much work it took. Where both are bright, work did not help."
          : fmt::format("Runs of {}. Left: how wrong each pixel is; then how much work it took.",
                        input.maps_of));
  for (const MappedRun& run : input.mapped) {
    page.add_pictures(run.title, run.maps);
    page.add_details("Its command", run.command);
  }
}

}  // namespace

std::string chart_page(const PageInput& input) {
  report::HtmlPage page("Speed against accuracy");
  page.add_paragraph(summary(input.table));
  if (!input.library.empty()) {
    page.add_paragraph(
        "Rest on a point to see what it is, click it to keep that and to copy its command. Axes "
        "stay where they are whatever is hidden, so that pictures can be compared.");
    page.set_live_charts(
        {chart_data(input.table, input.settings, input.cost), templates_json(), input.library});
  }
  add_charts(page, input);
  add_maps(page, input);
  page.add_heading("What is not in the charts");
  if (input.table.failed.empty() && input.table.skipped.empty())
    page.add_paragraph("No run failed, none was skipped.");
  add_unfinished(page, "failed", input.table.failed);
  add_unfinished(page, "were skipped", input.table.skipped);
  page.add_key_values("Where this comes from", origin(input));
  return page.text();
}

std::string print_job(const PageInput& input) {
  std::string json = fmt::format("{{\"table\":{},\"charts\":[",
                                 chart_data(input.table, input.settings, input.cost));
  bool first = true;
  for (const PrintedChart& chart : printed_charts(input.table)) {
    json +=
        fmt::format("{}{{\"template\":{},\"state\":{{\"path\":{}}},\"svg\":\"{}.svg\"}}",
                    first ? "" : ",", report::chart_template(chart.chart), chart.path, chart.file);
    first = false;
  }
  return json + "]}\n";
}

}  // namespace plumb::audit::chart
