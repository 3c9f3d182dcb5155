// What the page of a path says of its frames.
#include "audit/temporal/path_page.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plumb::audit::temporal {
namespace {

PathRow row_of(std::size_t frame, double popping_px, std::int64_t flicker) {
  PathRow row;
  row.frame = frame;
  row.error_px = 0.5;
  row.popping_px = popping_px;
  row.flicker_pixels = row.flicker_patches = flicker;
  row.worst = "pixel (1, 2)";
  return row;
}

TEST(PathPage, SaysWhatIsWorstInASentence) {
  EXPECT_EQ(path_sentence({row_of(2, 0.0, 0)}), "Nothing pops; no level flickers.");
  EXPECT_EQ(path_sentence({row_of(2, 1.5, 0), row_of(3, 2.5, 7), row_of(4, 2.5, 3)}),
            "Popping at most 2.5 px, in frame 3 at pixel (1, 2); levels flicker in 2 frames, most "
            "in frame 3: 7 pixels of 7 patches.");
}

// An error without end is left out of its panel; the other panels have the frame.
TEST(PathPage, DrawsAllPanelsOverTheFrames) {
  std::vector<PathRow> rows{row_of(1, 1.0, 0), row_of(2, 2.0, 4)};
  rows[1].error_px = std::numeric_limits<double>::infinity();
  const std::string svg = path_chart(rows, "title", 1.0, std::nullopt);
  for (const char* label : {"largest error, px", "largest popping, px", "flickering pixels",
                            "triangles, thousands", ">frame<", ">tolerance<"})
    EXPECT_NE(svg.find(label), std::string::npos) << label;
  EXPECT_EQ(svg.find("frame 2: largest error"), std::string::npos);
  EXPECT_NE(svg.find("frame 2: largest popping, px 2<"), std::string::npos);
}

}  // namespace
}  // namespace plumb::audit::temporal
