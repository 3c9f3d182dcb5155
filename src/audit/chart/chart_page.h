// The page of a sweep's charts.
#pragma once

#include <string>
#include <vector>

#include "audit/chart/run_table.h"
#include "audit/chart/summary.h"

namespace plumb::audit::chart {

/// A chart: a name for files and addresses, and what a reader is told.
struct ChartWords {
  const char* name;   // "cost-error", also of its template in web/charts
  const char* title;  // a question that it answers
  const char* words;  // how to read it
};

const std::vector<ChartWords>& charts();

/// A chart drawn by the program; "" where the table has nothing for it.
std::string plain_chart(const std::string& name, const RunTable& table,
                        const std::vector<Setting>& settings);

struct PageInput {
  const RunTable& table;
  const std::vector<Setting>& settings;
  std::string results;  // the name of the file of results
  std::string command;  // makes the page again
  std::string library;  // the text of vega.min.js; "": plain charts in its place
};

/// The whole page, UTF-8.
std::string chart_page(const PageInput& input);

/// What `node chart-print.js` reads: the table, and for each chart its template and file name.
std::string print_job(const RunTable& table, const std::vector<Setting>& settings);

}  // namespace plumb::audit::chart
