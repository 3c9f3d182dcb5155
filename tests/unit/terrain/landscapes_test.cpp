// The generated landscapes: dunes, canyon and urban.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/check.h"
#include "terrain/generators.h"

namespace plumb::terrain {
namespace {

constexpr double kTan10 = 0.17632698070846498, kTan32 = 0.62486935190932752;

std::string refusal(const std::string& argument) {
  try {
    generate(argument);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << argument << " was accepted";
  return "";
}

void expect_says(const std::string& message, const std::string& words) {
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

double part_at_height(Heightfield field, float height) {
  const auto& heights = field.heights_m.floats().values();
  return static_cast<double>(std::count(heights.begin(), heights.end(), height)) /
         static_cast<double>(heights.size());
}

// The bits of the generators are part of golden images: these change with their versions only.
TEST(Landscapes, KeepTheirBits) {
  EXPECT_EQ(checksum(generate("generate:dunes?size=65&seed=7")), 16786034333941258234u);
  EXPECT_EQ(checksum(generate("generate:canyon?size=65&spacing=200&seed=7")),
            10839340498876458501u);
  EXPECT_EQ(checksum(generate("generate:urban?size=65&spacing=3&seed=7&turn_deg=20")),
            4413629277891385897u);
}

TEST(Landscapes, OfAnotherSeedAreOthers) {
  for (const char* name : {"dunes", "canyon", "urban"}) {
    std::set<std::uint64_t> sums;
    for (const char* seed : {"0", "1", "2", "9223372036854775807"}) {
      sums.insert(
          checksum(generate(fmt::format("generate:{}?size=33&spacing=20&seed={}", name, seed))));
    }
    EXPECT_EQ(sums.size(), 4u) << name;
  }
}

// The largest difference between a sample and those up to two columns and rows away, as a part of
// what the angle of repose allows over that distance.
double steepest_part_of_repose(const Heightfield& field) {
  double steepest = 0.0;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i) {
      for (int b = 0; b <= 2 && j + b < field.rows(); ++b) {
        for (int a = -2; a <= 2; ++a) {
          if ((b == 0 && a <= 0) || i + a < 0 || i + a >= field.columns()) continue;
          const double rise = std::abs(static_cast<double>(field.heights_m(i + a, j + b)) -
                                       static_cast<double>(field.heights_m(i, j)));
          steepest =
              std::max(steepest, rise / (kTan32 * std::hypot(a * field.dx_m, b * field.dy_m)));
        }
      }
    }
  }
  return steepest;
}

// Heights below 32 m are rounded by at most 2^-20 m each: two of them to 2^-19 m, over 1 m of
// which sand may rise 0.62 m.
TEST(Dunes, LieNowhereSteeperThanTheAngleOfRepose) {
  for (const char* argument :
       {"generate:dunes?size=400&spacing=1&height=0",
        "generate:dunes?size=300&spacing=3,1&height=0",
        "generate:dunes?size=400&spacing=1&height=0&relief=15.7&bend=1&seed=3&wind_deg=17",
        "generate:dunes?size=400&spacing=1&height=0&relief=15.7&bend=1&seed=8&wind_deg=135"}) {
    EXPECT_LE(steepest_part_of_repose(generate(argument)), 1.0 + 0x1p-19 / kTan32) << argument;
  }
}

// Straight dunes under a west wind are the same in every row but for their heights along a crest:
// a row along the wind meets the slip face head-on.
TEST(Dunes, RiseAtTenDegreesAndFallAtThirtyTwo) {
  const Heightfield field =
      generate("generate:dunes?size=2000x40&spacing=0.5&height=0&bend=0&wind_deg=270");
  std::int64_t falling = 0, falling_at_repose = 0, rising = 0;
  double up = 0.0;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i + 1 < field.columns(); ++i) {
      const double slope =
          (static_cast<double>(field.heights_m(i + 1, j)) - field.heights_m(i, j)) / field.dx_m;
      falling += slope < -0.01 ? 1 : 0;
      falling_at_repose += slope < -0.95 * kTan32 ? 1 : 0;
      rising += slope > 0.0 ? 1 : 0;
      up += std::max(0.0, slope);
    }
  }
  EXPECT_GT(static_cast<double>(falling_at_repose), 0.9 * static_cast<double>(falling));
  EXPECT_GT(falling, 0);
  // Feet of dunes hide under slip faces, so that the mean is a little above the whole dune's.
  EXPECT_NEAR(up / static_cast<double>(rising), kTan10, 0.15 * kTan10);
}

// A crest lies within a spacing of some sample, and the ground falls by tan 32 degrees at most.
TEST(Dunes, AreAsTallAsTheyAreAskedToBe) {
  const Box box = bounds(generate("generate:dunes?size=1025&spacing=1&height=50&relief=12"));
  EXPECT_EQ(box.low.z, 50.0);
  EXPECT_LE(box.high.z, 62.0);
  EXPECT_GE(box.high.z, 62.0 - kTan32);
}

TEST(Dunes, OfNoReliefAreLevel) {
  const Heightfield field = generate("generate:dunes?size=65&height=3&relief=0");
  EXPECT_EQ(part_at_height(field, 3.0f), 1.0);
}

TEST(Canyon, RunsFromItsFloorToItsPlateau) {
  const Heightfield field = generate("generate:canyon?size=513&spacing=40&height=200&relief=800");
  const Box box = bounds(field);
  EXPECT_EQ(box.low.z, 200.0);
  EXPECT_EQ(box.high.z, 1000.0);
  EXPECT_GT(part_at_height(field, 200.0f), 0.01);  // level floor and level plateau
  EXPECT_GT(part_at_height(field, 1000.0f), 0.4);
}

// Cliffs of eight layers rise 25 m to 150 m within less than a cell of 10 m where the wall runs
// straight; they are a small part of the ground seen from above.
TEST(Canyon, HasWallsOfSlopesAndCliffs) {
  const Heightfield field = generate("generate:canyon?size=1025&spacing=10&relief=900");
  std::int64_t cliffs = 0;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i + 1 < field.columns(); ++i) {
      const float rise = std::abs(field.heights_m(i + 1, j) - field.heights_m(i, j));
      cliffs += rise > 20.0f ? 1 : 0;  // 63 degrees
    }
  }
  const auto cells = static_cast<double>(field.heights_m.size());
  EXPECT_GT(static_cast<double>(cliffs), 0.02 * cells);
  EXPECT_LT(static_cast<double>(cliffs), 0.2 * cells);
}

// The same strata everywhere: cliffs end at the layers' tops, where the next slope begins, so
// along every wall the same heights are passed quickly.
TEST(Canyon, ShowsTheSameLayersEverywhere) {
  const auto cliff_tops = [](const char* argument) {
    Heightfield field = generate(argument);
    std::vector<std::int64_t> counts(90, 0);
    for (const float height : field.heights_m.floats().values()) {
      const auto bin = static_cast<std::size_t>(std::clamp(height / 10.0f, 0.0f, 89.0f));
      ++counts[bin];
    }
    return counts;
  };
  const auto a = cliff_tops("generate:canyon?size=600x300&spacing=10&height=0&relief=900&strata=4");
  const auto b = cliff_tops("generate:canyon?size=300x600&spacing=10&height=0&relief=900&strata=4");
  int rare_in_both = 0, rare_in_one = 0;
  const auto is_rare = [](const std::vector<std::int64_t>& counts, std::size_t k) {
    return counts[k] * 90 * 4 < 180000;
  };
  for (std::size_t k = 1; k < 89; ++k) {
    rare_in_both += is_rare(a, k) && is_rare(b, k) ? 1 : 0;
    rare_in_one += is_rare(a, k) != is_rare(b, k) ? 1 : 0;
  }
  EXPECT_GT(rare_in_both, 25);
  EXPECT_LT(rare_in_one, 20);
}

TEST(Urban, LiesWithinItsRelief) {
  for (const char* seed : {"1", "2", "3"}) {
    const Box box =
        bounds(generate(std::string("generate:urban?height=40&relief=100&ground=10&seed=") + seed));
    EXPECT_GE(box.low.z, 40.0);
    EXPECT_LT(box.low.z, 45.0);  // the ground's lower half
    EXPECT_LE(box.high.z, 140.0);
    EXPECT_GT(box.high.z, 90.0);
  }
}

// On level ground of its own a pitched roof rises by 35 degrees, ground by nothing: a step of more
// than 2 m between two samples is a wall.
TEST(Urban, HasVerticalWallsAndLevelRoofs) {
  const Heightfield field = generate("generate:urban?size=513&height=0&ground=0");
  std::int64_t walls = 0, level_roofs = 0, roofs = 0;
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i + 1 < field.columns(); ++i) {
      const float here = field.heights_m(i, j), east = field.heights_m(i + 1, j);
      walls += std::abs(here - east) > 2.0f ? 1 : 0;
      roofs += here > 0.0f ? 1 : 0;
      level_roofs += here > 0.0f && here == east ? 1 : 0;
    }
  }
  const auto cells = static_cast<double>(field.heights_m.size());
  EXPECT_GT(static_cast<double>(walls), 0.02 * cells);
  EXPECT_GT(static_cast<double>(roofs), 0.3 * cells);
  EXPECT_LT(static_cast<double>(roofs), 0.8 * cells);
  EXPECT_GT(static_cast<double>(level_roofs), 0.5 * static_cast<double>(roofs));
}

TEST(Urban, HasLevelRoofsOnSlopingGround) {
  const Heightfield field = generate("generate:urban?size=513&ground=60&relief=160");
  std::int64_t level = 0;
  for (int j = 0; j + 1 < field.rows(); ++j) {
    for (int i = 0; i + 1 < field.columns(); ++i) {
      const float here = field.heights_m(i, j);
      level += here == field.heights_m(i + 1, j) && here == field.heights_m(i, j + 1) ? 1 : 0;
    }
  }
  EXPECT_GT(static_cast<double>(level), 0.15 * static_cast<double>(field.heights_m.size()));
}

TEST(Landscapes, SayWhatIsWrongWithAParameter) {
  expect_says(refusal("generate:dunes?relief=20&wavelength=100"), "a seventh of the wavelength");
  expect_says(refusal("generate:dunes?wind_deg=361"), "a number from 0 to 360");
  expect_says(refusal("generate:dunes?bend=1.5"), "a number from 0 to 1");
  expect_says(refusal("generate:canyon?strata=0"), "a whole number from 1 to 100");
  expect_says(refusal("generate:canyon?relief=-1"), "relief '-1'");
  expect_says(refusal("generate:urban?ground=200"), "ground '200': expected at most the relief");
  expect_says(refusal("generate:urban?street=60&block=75"), "at most 0.7 of the block");
}

}  // namespace
}  // namespace plumb::terrain
