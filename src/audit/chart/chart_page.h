// The page of a sweep's charts.
#pragma once

#include <string>
#include <vector>

#include "audit/chart/run_table.h"
#include "audit/chart/summary.h"
#include "report/html_page.h"

namespace plumb::audit::chart {

/// A chart: a name for files and addresses, and what a reader is told.
struct ChartWords {
  const char* name;   // "cost-error", also of its template in web/charts
  const char* title;  // a question that it answers
  const char* words;  // how to read it
};

const std::vector<ChartWords>& charts();

/// A chart as files: FILE.svg and FILE.png.
struct PrintedChart {
  std::string file;      // "cost-error", "path-2"
  std::string chart;     // a name of charts()
  std::size_t path = 0;  // of a chart along a camera path: a row of paths_of()
};

/// Those for which the table has something to show.
std::vector<PrintedChart> printed_charts(const RunTable& table);

/// A run that was made again for its maps.
struct MappedRun {
  std::string title, command;
  std::vector<report::CaptionedPicture> maps;
};

struct PageInput {
  const RunTable& table;
  const std::vector<Setting>& settings;
  std::size_t cost = 0;  // that the charts show (the page: to begin with), a row of kCosts
  std::string results;   // the name of the file of results
  std::string command;   // makes the page again
  std::string library;   // the text of vega.min.js; "": plain charts in its place
  std::vector<MappedRun> mapped = {};
  std::string maps_of = {};  // "worst"; "" where no maps were asked for
};

/// The chart as SVG, drawn by the program.
std::string plain_chart(const PrintedChart& chart, const PageInput& input);

/// The whole page, UTF-8.
std::string chart_page(const PageInput& input);

/// What `node chart-print.js` reads: the table, and for each chart its template and file name.
std::string print_job(const PageInput& input);

}  // namespace plumb::audit::chart
