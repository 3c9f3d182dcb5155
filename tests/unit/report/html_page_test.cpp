#include "report/html_page.h"

#include <gtest/gtest.h>

#include <string>

#include "report/base64.h"

namespace plumb::report {
namespace {

// The beginning of a PNG file of the given size: as much as the page looks at.
std::vector<std::uint8_t> png(int width, int height) {
  const auto high = [](int v) { return static_cast<std::uint8_t>(v >> 8); };
  const auto low = [](int v) { return static_cast<std::uint8_t>(v & 255); };
  return {0x89,         'P',         'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a,        0,          0, 0,
          13,           'I',         'H', 'D', 'R',  0,    0,    high(width), low(width), 0, 0,
          high(height), low(height), 8,   2,   0,    0,    0};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string kHostile = "<script>alert(\"1\")</script> & 'co'";
const std::string kTamed = "&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt; &amp; &#39;co&#39;";

Viewer small_viewer() {
  return {"view-1", "Pictures", 4, 3, {{"truth", "", png(4, 3), {}}, {"drawn", "", png(4, 3), {}}}};
}

HtmlPage full_page() {
  HtmlPage page("Audit of " + kHostile);
  page.add_verdict(Verdict::Broken, kHostile);
  page.add_heading(kHostile);
  page.add_paragraph(kHostile);
  page.add_key_values(kHostile, {{kHostile, kHostile}});
  page.add_table({kHostile, {{kHostile, true}}, {{{kHostile}, RowKind::Bad}}});
  Viewer viewer = small_viewer();
  viewer.caption = viewer.images[0].name = viewer.images[0].note = kHostile;
  viewer.images[1].legend_png = png(9, 9);
  page.add_viewer(viewer);
  page.add_offenders({kHostile, "view-1", {{kHostile, false}}, {{3, 2, {kHostile}}}});
  page.add_picture(kHostile, png(7, 7));
  page.add_list(kHostile, {kHostile});
  page.add_chart(kHostile, "<svg ></svg>");
  page.add_links({kHostile, kHostile, {{kHostile}}, {{kHostile, "a/b", png(3, 3), {kHostile}}}});
  page.add_details(kHostile, "{\"a\": \"" + kHostile + "\"}");
  return page;
}

TEST(EscapeHtml, ReplacesWhatMeansSomethingToABrowser) {
  EXPECT_EQ(escape_html(kHostile), kTamed);
  EXPECT_EQ(escape_html("H\xc3\xb6he"), "H\xc3\xb6he");
  EXPECT_EQ(escape_html(std::string("a\0b\x1b\n\t", 6)),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD\n\t");
}

TEST(HtmlPage, EscapesEveryTextThatIsHandedIn) {
  const std::string page = full_page().text();
  EXPECT_FALSE(has(page, "<script>alert"));
  EXPECT_FALSE(has(page, "alert(\""));
  int times = 0;
  for (std::size_t at = page.find(kTamed); at != std::string::npos; at = page.find(kTamed, at + 1))
    ++times;
  // title and h1; verdict, heading, paragraph; facts 3; table 3; viewer 2, figure: alt, data-name,
  // caption, note; offenders 3; picture 2; list 2; chart 2;
  // links: caption, two columns, alt, name, cell; details 2
  EXPECT_EQ(times, 2 + 3 + 3 + 3 + 2 + 4 + 3 + 2 + 2 + 2 + 6 + 2);
}

TEST(HtmlPage, RefersToNothingOutsideItself) {
  const std::string page = full_page().text();
  EXPECT_FALSE(has(page, "http://"));
  EXPECT_FALSE(has(page, "https://"));
  EXPECT_FALSE(has(page, "@import"));
  EXPECT_FALSE(has(page, "url("));
  EXPECT_FALSE(has(page, "<link"));
  for (std::size_t at = page.find("src=\""); at != std::string::npos;
       at = page.find("src=\"", at + 1))
    EXPECT_TRUE(page.compare(at + 5, 22, "data:image/png;base64,") == 0 ||
                page.compare(at + 5, 26, "data:image/svg+xml;base64,") == 0)
        << page.substr(at, 60);
  EXPECT_TRUE(has(page, "default-src 'none'"));
}

TEST(HtmlPage, HoldsItsStyleAndScript) {
  const std::string page = full_page().text();
  EXPECT_TRUE(has(page, "prefers-color-scheme: dark"));
  EXPECT_TRUE(has(page, "@media print"));
  EXPECT_TRUE(has(page, "class Viewer"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
}

TEST(HtmlPage, SaysTheVerdictInWordsAndNotInColourAlone) {
  HtmlPage page("t");
  page.add_verdict(Verdict::Held, "one");
  page.add_verdict(Verdict::Broken, "two");
  page.add_verdict(Verdict::MeasuredOnly, "three");
  EXPECT_TRUE(has(page.text(), "<p class=\"verdict held\"><strong>Held</strong> <span>one</span>"));
  EXPECT_TRUE(has(page.text(), "<p class=\"verdict broken\"><strong>Broken</strong>"));
  EXPECT_TRUE(has(page.text(), "<p class=\"verdict measured\"><strong>Measured only</strong>"));
  page.add_verdict(Verdict::None, "four");
  EXPECT_TRUE(has(page.text(), "<strong>No verdict</strong> <span>four</span>"));
  page.add_verdict(Verdict::Equal, "five");
  page.add_verdict(Verdict::Passes, "six");
  page.add_verdict(Verdict::Fails, "seven");
  EXPECT_TRUE(has(page.text(), "<p class=\"verdict held\"><strong>Equal</strong>"));
  EXPECT_TRUE(has(page.text(), "<p class=\"verdict held\"><strong>Passes</strong>"));
  EXPECT_TRUE(has(page.text(), "<p class=\"verdict broken\"><strong>Fails</strong>"));
}

TEST(HtmlPage, MarksNumbersAndKindsOfRows) {
  HtmlPage page("t");
  page.add_table(
      {"c",
       {{"claim", false}, {"px", true}},
       {{{"a", "1"}, RowKind::Ok}, {{"b", "2"}, RowKind::Bad}, {{"c", "3"}, RowKind::Plain}}});
  const std::string text = page.text();
  EXPECT_TRUE(has(text, "<th scope=\"col\">claim</th><th scope=\"col\" class=\"number\">px</th>"));
  EXPECT_TRUE(has(text, "<tr class=\"ok\"><td>a</td><td class=\"number\">1</td></tr>"));
  EXPECT_TRUE(has(text, "<tr class=\"bad\"><td>b</td>"));
  EXPECT_TRUE(has(text, "<tr><td>c</td>"));
}

TEST(HtmlPage, FoldsATableUnderItsCaption) {
  HtmlPage page("t");
  page.add_table({"caption", {{"a"}}, {{{"1"}}}, true});
  EXPECT_TRUE(has(page.text(),
                  "<details><summary>caption</summary><div class=\"scroll\"><table>"
                  "<thead>"));
  EXPECT_TRUE(has(page.text(), "</table></div></details>\n"));
}

TEST(HtmlPage, ShowsEveryPictureWithoutAScript) {
  const std::string text = full_page().text();
  const std::string address = "data:image/png;base64," + base64(png(4, 3));
  EXPECT_TRUE(has(text, "<img class=\"pixels\" src=\"" + address + "\" width=\"4\" height=\"3\""));
  EXPECT_TRUE(has(text, "<img class=\"legend\" src=\"data:image/png;base64," + base64(png(9, 9))));
}

TEST(HtmlPage, LinksEachOffenderToItsPixel) {
  EXPECT_TRUE(has(full_page().text(),
                  "<a href=\"#view-1\" data-viewer=\"view-1\" data-x=\"3\" data-y=\"2\">3, 2</a>"));
}

TEST(HtmlPage, ListsAnOffenderOutOfViewWithoutALink) {
  HtmlPage page("t");
  page.add_offenders({"c", "v", {{"a", false}}, {{-1, -1, {"far off"}}}});
  EXPECT_TRUE(has(page.text(), "<td class=\"number\">out of view</td><td>far off</td>"));
  EXPECT_FALSE(has(page.text(), "<a href"));
}

TEST(HtmlPage, LinksNameAndPictureToAnotherPage) {
  HtmlPage page("t");
  page.add_links({"c",
                  "file",
                  {{"px", true}},
                  {{"a b?.png", "pairs/a b?.png/index.html", png(2, 2), {"1"}, RowKind::Bad},
                   {"gone", "", {}, {"-"}}}});
  const std::string text = page.text();
  EXPECT_TRUE(has(text, "<tr class=\"bad\"><td><a href=\"pairs/a%20b%3F.png/index.html\"><img "));
  EXPECT_TRUE(has(text,
                  "<a href=\"pairs/a%20b%3F.png/index.html\">a b?.png</a></td><td "
                  "class=\"number\">1</td>"));
  EXPECT_TRUE(has(text, "<tr><td></td><td>gone</td>"));
}

TEST(HtmlPage, LinksWithoutPicturesHaveNoColumnForThem) {
  HtmlPage page("t");
  page.add_links({"c", "frame", {{"px"}}, {{"1", "frame_0001/report.html", {}, {"2"}}}});
  const std::string text = page.text();
  EXPECT_FALSE(has(text, ">picture</th>"));
  EXPECT_TRUE(has(text, "<tr><td><a href=\"frame_0001/report.html\">1</a></td><td>2</td></tr>"));
}

TEST(HtmlPage, RefusesAddressesThatLeadElsewhere) {
  HtmlPage page("t");
  EXPECT_THROW(page.add_links({"c", "n", {}, {{"a", "//example.org/", {}, {}}}}),
               std::invalid_argument);
  page.add_links({"c", "n", {}, {{"a", "javascript:alert(1)", {}, {}}}});
  EXPECT_TRUE(has(page.text(), "href=\"javascript%3Aalert%281%29\""));
}

TEST(HtmlPage, HasNoListWithoutLines) {
  HtmlPage page("t"), bare("t");
  page.add_list("caption", {});
  EXPECT_EQ(page.text(), bare.text());
}

TEST(HtmlPage, RefusesAChartThatIsNoSvg) {
  HtmlPage page("t");
  EXPECT_THROW(page.add_chart("c", "<script>"), std::invalid_argument);
}

TEST(HtmlPage, RefusesRowsThatDoNotFit) {
  HtmlPage page("t");
  EXPECT_THROW(page.add_table({"", {{"a", false}}, {{{"1", "2"}, RowKind::Plain}}}),
               std::invalid_argument);
  EXPECT_THROW(page.add_offenders({"", "v", {}, {{0, 0, {"1"}}}}), std::invalid_argument);
}

TEST(HtmlPage, RefusesPicturesOfAnotherSizeAndOtherBytes) {
  HtmlPage page("t");
  Viewer viewer = small_viewer();
  viewer.images[1].png = png(4, 4);
  EXPECT_THROW(page.add_viewer(viewer), std::invalid_argument);
  viewer.images[1].png = std::vector<std::uint8_t>(100, 0);
  EXPECT_THROW(page.add_viewer(viewer), std::invalid_argument);
  EXPECT_THROW(page.add_picture("p", {}), std::invalid_argument);
  viewer = small_viewer();
  viewer.id = "a b";
  EXPECT_THROW(page.add_viewer(viewer), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::report
