#include "report/plain_chart.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace plumb::report {
namespace {

std::size_t count_of(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

PlainPanel panel() {
  PlainPanel one;
  one.title = "hills & dales";
  one.x = open_axis(std::vector<double>{0.0, 1.0, 10.0});
  one.y = open_axis(std::vector<double>{1.0, 10.0});
  PlainSeries series{.name = "full", .colour = "#123456"};
  for (const double error : {0.0, 1.0, 10.0})
    series.points.push_back({one.x.place(error), one.y.place(1.0), "<run>"});
  one.series = {series};
  return one;
}

TEST(PlainChart, DrawsEveryPointWithItsLabelEscaped) {
  const std::string svg = plain_svg({panel(), panel()});
  EXPECT_EQ(count_of("<title>&lt;run&gt;</title>", svg), 6u);
  EXPECT_EQ(count_of("hills &amp; dales", svg), 2u);
  EXPECT_EQ(count_of("class=\"apart\"", svg), 2u);  // the place of zero in each panel
  EXPECT_EQ(svg, plain_svg({panel(), panel()}));
}

// From (left, bottom) to the right, then down to the next.
TEST(PlainChart, DrawsAFrontInStepsAlongXFirst) {
  PlainPanel one = panel();
  one.front = {{one.x.place(1.0), one.y.place(10.0), ""},
               {one.x.place(10.0), one.y.place(1.0), ""}};
  const std::string svg = plain_svg({one}, 1);
  const std::size_t at = svg.find("class=\"front\" d=\"M");
  ASSERT_NE(at, std::string::npos);
  const std::string path = svg.substr(at, svg.find("/>", at) - at);
  EXPECT_EQ(count_of("H", path), 1u);
  EXPECT_LT(path.find('H'), path.find('L'));
}

TEST(PlainChart, RefusesGridsThatAreNone) {
  EXPECT_THROW(plain_svg(std::vector<PlainPanel>{}), std::invalid_argument);
  EXPECT_THROW(plain_svg(PlainGrid{"t", "x", {"1 px", "2 px"}, {"smooth"}, {{PlainCell{}}}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace plumb::report
