#include "progress.h"

#include <gtest/gtest.h>

namespace plumb::tool {
namespace {

// Half of it took six seconds.
TEST(ProgressText, TellsTheTimeLeft) {
  EXPECT_EQ(progress_text("runs", 6, 12, 6.0),
            "[===============               ]  50 %  6 of 12 runs, 6 s left");
  EXPECT_EQ(progress_text("runs", 1, 100, 10.0),
            "[                              ]   1 %  1 of 100 runs, 17 min left");
  EXPECT_EQ(progress_text("runs", 1, 2, 3600.0 + 5 * 60),
            "[===============               ]  50 %  1 of 2 runs, 1 h 05 min left");
  EXPECT_EQ(progress_text("runs", 3, 3, 1.0),
            "[==============================] 100 %  3 of 3 runs, 0 s left");
}

}  // namespace
}  // namespace plumb::tool
