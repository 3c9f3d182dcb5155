#include "text_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace plumb::tool {
namespace {

TEST(TextTable, SetsWordsLeftAndNumbersRight) {
  EXPECT_EQ(text_table({{"claim", false}, {"px", true}}, {{"sample", "1.25"}, {"x", "10"}}),
            "claim     px\n"
            "sample  1.25\n"
            "x         10\n");
}

TEST(TextTable, NeedsNoHeadings) {
  EXPECT_EQ(text_table({{"", false}, {"", false}}, {{"size", "3"}, {"a", ""}}), "size  3\na\n");
}

TEST(TextTable, CountsLettersAndNotBytes) {
  EXPECT_EQ(letters_in("H\xc3\xb6he"), 4);
  EXPECT_EQ(text_table({{"", false}, {"", false}}, {{"H\xc3\xb6he", "1"}, {"abcd", "2"}}),
            "H\xc3\xb6he  1\nabcd  2\n");
}

TEST(TextTable, RefusesRowsThatDoNotFit) {
  EXPECT_THROW(text_table({{"a", false}}, {{"1", "2"}}), std::invalid_argument);
}

TEST(TextBar, IsAsLongAsItsPart) {
  EXPECT_EQ(text_bar(1.0, 2.0, 10), "#####");
  EXPECT_EQ(text_bar(2.0, 2.0, 10), "##########");
  EXPECT_EQ(text_bar(1e-9, 2.0, 10), "#");
  EXPECT_EQ(text_bar(0.0, 2.0, 10), "");
}

}  // namespace
}  // namespace plumb::tool
