#include <limits>
#include <vector>

#include "core/hash.h"
#include "report/heat_map.h"
#include "report/html_page.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

std::uint64_t heat_maps() {
  Sequence numbers(4);
  std::vector<double> values;
  for (int i = 0; i < 400 * 100; ++i) values.push_back(numbers.between(0.0, 2.0));
  values[7] = std::numeric_limits<double>::infinity();
  values[8] = std::numeric_limits<double>::quiet_NaN();
  Checksum sum;
  for (const bool logarithmic : {false, true}) {
    report::HeatMapOptions options;
    options.title = "pixel error";
    options.logarithmic = logarithmic;
    options.limit = 1.0;
    const report::RgbImage image = report::heat_map(400, 100, values, options);
    sum.add(std::span<const std::uint8_t>(image.rgb));
  }
  return sum.value();
}

std::uint64_t pages() {
  report::HtmlPage page("<page>");
  page.add_verdict(report::Verdict::Held, "Every claim holds.");
  page.add_table({"claims", {{"claim", false}, {"px", true}}, {{{"a", "1"}}}});
  return Checksum().add(std::string_view(page.text())).value();
}

}  // namespace

std::vector<Stage> report_stages() {
  return {{"report.heat_maps", heat_maps}, {"report.pages", pages}};
}

}  // namespace plumb::determinism
