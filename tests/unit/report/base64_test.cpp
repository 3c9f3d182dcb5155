#include "report/base64.h"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace plumb::report {
namespace {

std::string of(std::string_view text) {
  return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
}

// The known answers of RFC 4648, section 10.
TEST(Base64, GivesTheKnownAnswers) {
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foob"), "Zm9vYg==");
  EXPECT_EQ(of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

// 0xfb 0xef 0xff = 111110 111110 111111 111111: digits 62, 62, 63, 63.
TEST(Base64, UsesTheLastTwoDigitsForBytesWithTheHighBitSet) {
  EXPECT_EQ(base64(std::vector<std::uint8_t>{0xfb, 0xef, 0xff}), "++//");
}

}  // namespace
}  // namespace plumb::report
