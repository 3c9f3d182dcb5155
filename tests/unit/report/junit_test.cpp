#include "report/junit.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "support/run_command.h"
#include "support/small_xml.h"

namespace plumb::report {
namespace {

JUnitSuite three_outcomes() {
  return {"pictures",
          {{"plumb.compare", "a.png"},
           {"plumb.compare", "b.png", JUnitFailure{"too far off", "line 1\nline 2"}},
           {"plumb.compare", "c.png", {}, "unreadable"},
           {"plumb.compare", "d.png", {}, {}, "not asked for"}}};
}

// All that XML has a mind about, and bytes that are no text at all.
JUnitSuite hostile() {
  constexpr char kText[] = "<&>\"' ]]> \x01\x1f\x7f\xff\xc0\x80\n\tend\0";
  const std::string text(kText, sizeof kText - 1);  // the zero byte is part of it
  return {text, {{text, text, JUnitFailure{text, text}}, {text, text, {}, text}}};
}

TEST(JUnit, IsThisFileForTheseCases) {
  EXPECT_EQ(to_junit_xml(three_outcomes()),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuite name=\"pictures\" tests=\"4\" failures=\"1\" errors=\"1\" skipped=\"1\" "
            "time=\"0\">\n"
            "  <testcase classname=\"plumb.compare\" name=\"a.png\" time=\"0\"/>\n"
            "  <testcase classname=\"plumb.compare\" name=\"b.png\" time=\"0\">\n"
            "    <failure message=\"too far off\">line 1\nline 2</failure>\n"
            "  </testcase>\n"
            "  <testcase classname=\"plumb.compare\" name=\"c.png\" time=\"0\">\n"
            "    <error message=\"unreadable\"/>\n"
            "  </testcase>\n"
            "  <testcase classname=\"plumb.compare\" name=\"d.png\" time=\"0\">\n"
            "    <skipped message=\"not asked for\"/>\n"
            "  </testcase>\n"
            "</testsuite>\n");
}

TEST(JUnit, EscapesWhatMeansSomethingToXml) {
  EXPECT_EQ(escape_xml("a<b & \"c\" > 'd'"), "a&lt;b &amp; &quot;c&quot; &gt; &apos;d&apos;");
  EXPECT_EQ(escape_xml("1\n2\t3\r"), "1&#10;2&#9;3&#13;");
  EXPECT_EQ(escape_xml("H\xc3\xb6he \xe2\x82\xac \xf0\x9f\x8f\x94"),
            "H\xc3\xb6he \xe2\x82\xac \xf0\x9f\x8f\x94");
}

TEST(JUnit, ReplacesWhatXmlCannotHold) {
  const std::string r = "\xEF\xBF\xBD";
  EXPECT_EQ(escape_xml(std::string("a\0b\x1b", 4)), "a" + r + "b" + r);
  EXPECT_EQ(escape_xml("\xff\xfe"), r + r);
  EXPECT_EQ(escape_xml("\xc0\x80"), r + r);                  // a longer form of NUL
  EXPECT_EQ(escape_xml("\xed\xa0\x80"), r);                  // half of a surrogate pair
  EXPECT_EQ(escape_xml("\xef\xbf\xbf"), r);                  // U+FFFF
  EXPECT_EQ(escape_xml("\xf4\x90\x80\x80"), r + r + r + r);  // beyond the last letter
  EXPECT_EQ(escape_xml("\xe2\x82"), r + r);                  // broken off
}

TEST(JUnit, IsWellFormedWhateverTheTextsAre) {
  EXPECT_EQ(testing::xml_fault(to_junit_xml(three_outcomes())), "");
  EXPECT_EQ(testing::xml_fault(to_junit_xml(hostile())), "");
}

TEST(JUnit, IsWellFormedToXmllint) {
  if (testing::run_command({"xmllint", "--version"}).status != 0)
    GTEST_SKIP() << "xmllint is not installed";
  const testing::TemporaryFolder folder;
  std::ofstream(folder.file("junit.xml"), std::ios::binary) << to_junit_xml(hostile());
  const auto result = testing::run_command({"xmllint", "--noout", folder.file("junit.xml")});
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST(JUnit, RefusesACaseWithTwoOutcomes) {
  EXPECT_THROW(to_junit_xml({"s", {{"c", "n", JUnitFailure{"m", ""}, "e"}}}),
               std::invalid_argument);
}

// The check itself finds faults.
TEST(SmallXml, FindsWhatIsNotWellFormed) {
  EXPECT_EQ(testing::xml_fault("<?xml version=\"1.0\"?>\n<a b=\"c\"><d/>text</a>\n"), "");
  EXPECT_NE(testing::xml_fault("<a><b></a></b>"), "");
  EXPECT_NE(testing::xml_fault("<a>"), "");
  EXPECT_NE(testing::xml_fault("<a b=\"<\"/>"), "");
  EXPECT_NE(testing::xml_fault("<a>1 & 2</a>"), "");
  EXPECT_NE(testing::xml_fault("<a/><b/>"), "");
  EXPECT_NE(testing::xml_fault("<a b=c/>"), "");
  EXPECT_NE(testing::xml_fault("<a>\x01</a>"), "");
}

}  // namespace
}  // namespace plumb::report
