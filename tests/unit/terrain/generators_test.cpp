#include "terrain/generators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/check.h"
#include "support/test_terrain.h"
#include "terrain/terrain_source.h"

namespace plumb::terrain {
namespace {

std::string refusal(const std::string& argument, const ReadOptions& options = {}) {
  try {
    load_terrain(argument, options);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << argument << " was accepted";
  return "";
}

void expect_says(const std::string& message, const std::string& words) {
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

TEST(Generators, PlaneIsLevel) {
  Heightfield field = generate("generate:plane?size=3x2&height=12.5&spacing=2,4");
  EXPECT_EQ(field.columns(), 3);
  EXPECT_EQ(field.rows(), 2);
  EXPECT_EQ(field.dx_m, 2.0);
  EXPECT_EQ(field.dy_m, 4.0);
  EXPECT_EQ(field.heights_m.floats().values(), std::vector<float>(6, 12.5f));
}

TEST(Generators, TiltedPlaneRisesEastAndNorth) {
  const Heightfield field =
      generate("generate:tilted-plane?size=3&spacing=4,8&height=1&slope_x=0.5&slope_y=-0.25");
  EXPECT_EQ(field.heights_m(0, 0), 1.0f);
  EXPECT_EQ(field.heights_m(2, 0), 1.0f + 8 * 0.5f);
  EXPECT_EQ(field.heights_m(0, 2), 1.0f - 16 * 0.25f);
  EXPECT_EQ(field.heights_m(2, 1), 1.0f + 4.0f - 2.0f);
}

TEST(Generators, TiltedPlaneMayBeGivenItsRelief) {
  const Heightfield field =
      generate("generate:tilted-plane?size=5&spacing=1&slope_x=1&slope_y=1&relief=80");
  EXPECT_EQ(field.heights_m(4, 4) - field.heights_m(0, 0), 80.0f);
}

TEST(Generators, ParaboloidHasItsSummitInTheMiddle) {
  const Heightfield field = generate("generate:paraboloid?size=5&height=10&relief=400");
  EXPECT_EQ(field.heights_m(2, 2), 410.0f);
  EXPECT_EQ(field.heights_m(0, 0), 10.0f);
  EXPECT_EQ(field.heights_m(0, 2), 210.0f);          // u = -1, v = 0
  EXPECT_EQ(field.heights_m(3, 2), 10.0f + 350.0f);  // u = 1/2: 400 * (1 - 1/8)
  EXPECT_EQ(generate("generate:paraboloid?size=1&height=10&relief=4").heights_m(0, 0), 14.0f);
}

TEST(Generators, StepLiesBehindItsColumn) {
  const Heightfield field = generate("generate:step?size=5x2&height=1&relief=7&position=0.5");
  for (int j = 0; j < 2; ++j) {
    EXPECT_EQ(field.heights_m(2, j), 1.0f);  // floor(4 * 0.5) = 2 is the last low column
    EXPECT_EQ(field.heights_m(3, j), 8.0f);
  }
  const Heightfield north = generate("generate:step?size=2x5&relief=7&axis=y&position=0");
  EXPECT_EQ(north.heights_m(1, 0), 0.0f);
  EXPECT_EQ(north.heights_m(1, 1), 7.0f);
}

TEST(Generators, SpikeIsOneSample) {
  const Heightfield field = generate("generate:spike?size=4&height=2&relief=50&column=3&row=0");
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(field.heights_m(i, j), i == 3 && j == 0 ? 52.0f : 2.0f);
    }
  }
  EXPECT_EQ(generate("generate:spike?size=5&relief=50").heights_m(2, 2), 50.0f);
}

TEST(Generators, SinusoidRepeatsWithItsWavelength) {
  const Heightfield field =
      generate("generate:sinusoid?size=9&spacing=25&height=3&relief=20&wavelength=100");
  EXPECT_EQ(field.heights_m(1, 1), 13.0f);  // a quarter wave each way: both sines are 1
  EXPECT_EQ(field.heights_m(1, 3), -7.0f);
  EXPECT_EQ(field.heights_m(0, 1), 3.0f);
  EXPECT_EQ(field.heights_m(5, 5), field.heights_m(1, 1));
}

TEST(Generators, CheckerboardAlternates) {
  const Heightfield field = generate("generate:checkerboard?size=6&height=1&relief=4&tile=2");
  EXPECT_EQ(field.heights_m(1, 1), 1.0f);
  EXPECT_EQ(field.heights_m(2, 1), 5.0f);
  EXPECT_EQ(field.heights_m(3, 3), 1.0f);
  EXPECT_EQ(field.heights_m(0, 4), 1.0f);
}

TEST(Generators, AlpineHasAboutTheReliefThatIsAskedFor) {
  const Heightfield field = generate("generate:alpine?size=1025&spacing=60&height=200");
  const Box box = bounds(field);
  EXPECT_GE(box.low.z, 200.0);
  EXPECT_GT(box.high.z - box.low.z, 0.75 * 2500.0);
  EXPECT_LT(box.high.z - box.low.z, (1.0 / 0.58 - 0.25) / 1.2 * 2500.0);  // the formula's bound
}

TEST(Generators, AlpineOfAnotherSeedIsAnotherTerrain) {
  std::set<std::uint64_t> sums;
  for (const char* seed : {"0", "1", "2", "9223372036854775807"}) {
    sums.insert(checksum(generate(std::string("generate:alpine?size=33&seed=") + seed)));
  }
  EXPECT_EQ(sums.size(), 4u);
}

// The bits of the generator are part of every golden image: these change with its version only.
TEST(Generators, AlpineKeepsItsBits) {
  EXPECT_EQ(checksum(generate("generate:alpine?size=65&seed=7")), 10293829334047953874u);
}

TEST(Generators, ASmallerTerrainIsTheCornerOfALargerOne) {
  for (const char* name :
       {"alpine", "dunes", "urban", "sinusoid", "checkerboard", "tilted-plane"}) {
    const Heightfield small = generate(std::string("generate:") + name + "?size=17x9&seed=3");
    const Heightfield large = generate(std::string("generate:") + name + "?size=40&seed=3");
    for (int j = 0; j < 9; ++j) {
      for (int i = 0; i < 17; ++i) {
        ASSERT_EQ(small.heights_m(i, j), large.heights_m(i, j)) << name;
      }
    }
  }
}

TEST(Generators, VoidsCoverThePartThatIsAskedFor) {
  for (const double part : {0.01, 0.1, 0.5, 0.9}) {
    Heightfield field = generate(fmt::format("generate:alpine?size=200&voids={}&seed=5", part));
    std::int64_t voids = 0;
    for (const float height : field.heights_m.floats().values())
      voids += std::isnan(height) ? 1 : 0;
    EXPECT_EQ(field.provenance.voids_declared, voids);
    // Never more; less by what one of 65536 levels holds, at most 0.5 % of the samples.
    EXPECT_LE(static_cast<double>(voids), part * 40000.0);
    EXPECT_GE(static_cast<double>(voids), (part - 0.005) * 40000.0);
  }
  EXPECT_EQ(generate("generate:plane?size=9&voids=1").provenance.voids_declared, 81);
}

TEST(Generators, OriginMovesTheTerrainAndNotItsHeights) {
  const Heightfield here = generate("generate:alpine?size=9");
  const Heightfield there = generate("generate:alpine?size=9&origin=-12.5,1e6");
  const Heightfield utm = generate("generate:alpine?size=9&utm=1");
  EXPECT_EQ(there.origin_m, glm::dvec2(-12.5, 1e6));
  EXPECT_EQ(utm.origin_m, glm::dvec2(500000.0, 4500000.0));
  EXPECT_EQ(here.heights_m, there.heights_m);
  EXPECT_EQ(here.heights_m, utm.heights_m);
  expect_says(refusal("generate:alpine?utm=1&origin=1,2"), "not both");
}

TEST(Generators, TheSourceGivesTheSameTerrainAgain) {
  const Heightfield field = generate("generate:alpine?voids=0.2&size=31x17&seed=4&relief=900");
  const Heightfield again = generate(field.provenance.source);
  EXPECT_EQ(checksum(field), checksum(again));
  EXPECT_EQ(field.provenance.source, again.provenance.source);
  expect_says(field.provenance.source, "seed=4");
  expect_says(field.provenance.source, "octaves=0");
  const Heightfield utm = generate("generate:plane?size=3&utm=1");
  EXPECT_EQ(checksum(generate(utm.provenance.source)), checksum(utm));
}

TEST(Generators, OneSampleIsATerrain) {
  for (const GeneratorHelp& help : generator_help()) {
    const Heightfield field = generate(test_support::heights_of(help, "size=1"));
    EXPECT_EQ(field.heights_m.size(), 1u);
    EXPECT_TRUE(std::isfinite(field.heights_m(0, 0))) << help.name;
  }
}

TEST(Generators, DefaultsOfTheHelpAreAccepted) {
  for (const GeneratorHelp& help : generator_help()) {
    std::string argument = test_support::heights_of(help, "size=9");
    for (const GeneratorParameter& parameter : help.parameters) {
      EXPECT_FALSE(parameter.meaning.empty());
      if (parameter.name != "size" && parameter.name != "surface") {
        argument += "&" + parameter.name + "=" + parameter.default_value;
      }
    }
    if (argument.find("utm=0") != std::string::npos) {
      EXPECT_EQ(checksum(generate(argument)),
                checksum(generate(test_support::heights_of(help, "size=9"))));
    }
  }
}

TEST(Generators, UnknownNamesAndParametersListTheKnownOnes) {
  expect_says(
      refusal("generate:apline"),
      "known are alpine dunes canyon urban plane tilted-plane paraboloid step spike sinusoid "
      "checkerboard caves");
  expect_says(refusal("generate:"), "known are alpine");
  expect_says(refusal("generate:plane?hieght=3"),
              "known are size spacing seed voids utm origin height");
}

TEST(Generators, ValuesOutOfRangeSayWhatWasExpected) {
  expect_says(refusal("generate:alpine?size=0"), "size '0': expected a whole number from 1");
  expect_says(refusal("generate:alpine?size=3x"), "WIDTHxHEIGHT");
  expect_says(refusal("generate:alpine?seed=-1"), "whole number >= 0");
  expect_says(refusal("generate:alpine?spacing=0"), "spacing '0'");
  expect_says(refusal("generate:alpine?spacing=nan"), "spacing 'nan'");
  expect_says(refusal("generate:alpine?relief=inf"), "relief 'inf'");
  expect_says(refusal("generate:alpine?voids=1.5"), "a number from 0 to 1");
  expect_says(refusal("generate:alpine?seed"), "has no value");
  expect_says(refusal("generate:alpine?seed="), "has no value");
  expect_says(refusal("generate:alpine?seed=1&seed=2"), "given twice");
  expect_says(refusal("generate:step?axis=z"), "x or y");
  expect_says(refusal("generate:spike?size=4&column=4"), "from 0 to 3");
}

TEST(Generators, WhatCannotFitIsRefusedBeforeWorkStarts) {
  expect_says(refusal("generate:plane?size=2000000"), "need 16000000000000 bytes of memory");
}

TEST(Generators, OptionsOfFilesAreRefused) {
  ReadOptions options;
  options.decode = Decode::Grey;
  expect_says(refusal("generate:plane", options), "--decode is for files");
  options = {};
  options.crs = "EPSG:2056";
  expect_says(refusal("generate:plane", options), "--crs is for files");
}

TEST(Generators, AWindowIsCountedFromTheTopLeft) {
  ReadOptions options;
  options.window = Window{1, 0, 2, 3};
  const Heightfield whole = generate("generate:alpine?size=5&voids=0.3&spacing=10");
  const Heightfield part = load_terrain("generate:alpine?size=5&voids=0.3&spacing=10", options);
  EXPECT_EQ(part.rows(), 3);
  EXPECT_EQ(part.origin_m, glm::dvec2(10.0, 20.0));
  std::int64_t voids = 0;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 2; ++i) {
      if (part.is_void(i, j)) {
        EXPECT_TRUE(whole.is_void(i + 1, j + 2));
        ++voids;
      } else {
        EXPECT_EQ(part.heights_m(i, j), whole.heights_m(i + 1, j + 2));
      }
    }
  }
  EXPECT_EQ(part.provenance.voids_declared, voids);
}

}  // namespace
}  // namespace plumb::terrain
