// The parts of a page that draw charts while it is open.
#include <fmt/format.h>

#include "core/check.h"
#include "report/html_page.h"
#include "report/html_parts.h"
#include "report/web_assets.h"

namespace plumb::report {
namespace {

// JSON within a page: whatever a text says, it ends no element.
std::string data_element(std::string_view id, std::string_view json) {
  std::string html = fmt::format("<script type=\"application/json\" id=\"{}\">", id);
  for (const char c : json) {
    if (c == '<') {
      html += "\\u003c";
    } else {
      html += c;
    }
  }
  return html + "</script>\n";
}

std::string script_element(std::string_view script) {
  return fmt::format("<script>\n{}</script>\n", script);
}

}  // namespace

void HtmlPage::set_live_charts(LiveCharts charts) {
  require(!live_, "a page has live charts once");
  require(charts.library.find("</script") == std::string::npos,
          "a drawing library must not end the script that it stands in");
  live_ = std::move(charts);
  body_ += "<div id=\"charts\" class=\"chart-controls\"></div>\n";
}

void HtmlPage::add_live_chart(std::string_view name, std::string_view label) {
  require_id(name);
  body_ += fmt::format(
      "<div class=\"live-chart\" id=\"chart-{}\" role=\"img\" aria-label=\"{}\"></div>\n", name,
      escape_html(label));
}

std::string live_scripts(const LiveCharts& charts) {
  return data_element("chart-table", charts.table_json) +
         data_element("chart-templates", charts.templates_json) + script_element(charts.library) +
         script_element(kChartDataScript) + script_element(kChartScript);
}

}  // namespace plumb::report
