// What the default profile catches: defects planted at many places in many scenes, with all
// channels and with colours alone. docs/comparing.md shows the table of a hundred seeds.
#include "compare/detection.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

#include "compare/calibration.h"
#include "compare/planted_defects.h"
#include "compare/planted_scene.h"
#include "core/check.h"

namespace plumb::compare {
namespace {

std::string text_of(const DetectionTable& table) {
  std::string text;
  for (const DetectionRow& row : table.rows) {
    text += fmt::format("{:14} {} of {} failed, by {}\n", row.kind->name, row.failed, row.pictures,
                        fmt::join(row.best_checks(3), ", "));
    if (!row.wrong.empty()) text += fmt::format("  wrong: {}\n", fmt::join(row.wrong, "; "));
  }
  return text;
}

DetectionTable table_of(int seeds, Channels channels, std::vector<std::string> terrains = {},
                        bool with_others = false) {
  DetectionOptions options;
  options.seeds = seeds;
  options.channels = channels;
  options.with_others = with_others;
  if (!terrains.empty()) options.terrains = std::move(terrains);
  return detection_power(built_in_profiles().front(), options);
}

TEST(DefaultProfile, CatchesEveryDefectAndNothingHarmlessWithAllChannels) {
  const DetectionTable table = table_of(1, Channels::All, {"canyon"});
  EXPECT_TRUE(table.as_wanted()) << text_of(table);
}

TEST(DefaultProfile, CatchesEveryDefectAndNothingHarmlessOnColoursAlone) {
  const DetectionTable table = table_of(1, Channels::ColoursAlone, {"alpine"});
  EXPECT_TRUE(table.as_wanted()) << text_of(table);
}

// Rates: of a hundred scenes one may hide what is planted (a crack as bright as the ground that it
// crosses), or show what is harmless (a gap between two walls that a tenth of a pixel opens).
void expect_rates(const DetectionTable& table) {
  for (const DetectionRow& row : table.rows)
    EXPECT_LE(100 * row.wrong.size(), static_cast<std::size_t>(row.pictures)) << row.kind->name;
}

TEST(LongDefaultProfile, CatchesDefectsOfAHundredScenesWithAllChannels) {
  const DetectionTable table = table_of(34, Channels::All);
  expect_rates(table);
  if (HasFailure()) std::cout << text_of(table);
}

TEST(LongDefaultProfile, CatchesDefectsOfAHundredScenesOnColoursAlone) {
  const DetectionTable table = table_of(34, Channels::ColoursAlone, {}, true);
  expect_rates(table);
  if (HasFailure()) std::cout << text_of(table);
  // None of the rules that others use gets every row right.
  for (std::size_t rule = 0; rule < table.others.size(); ++rule) {
    bool right = true;
    for (const DetectionRow& row : table.rows)
      right = right && row.failed_by_others[rule] == (row.kind->harmless ? 0 : row.pictures);
    EXPECT_FALSE(right) << table.others[rule];
  }
}

TEST(PlantedDefects, AreWhatTheySay) {
  PlantedSceneOptions options;
  options.samples = 65;
  options.width_px = 160;
  options.height_px = 90;
  const PlantedScene scene(options);
  const image::PlaneImage drawn = scene.drawn();
  const auto differing = [&](const image::PlaneImage& picture) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < drawn.size(); ++k)
      count += drawn.find("Z")->values[k] != picture.find("Z")->values[k];
    return count;
  };
  Places places(7);
  EXPECT_EQ(differing(with_pinholes(drawn, 1, places)), 1u);
  EXPECT_LE(differing(with_crack(drawn, 1, 20, places)), 20u);
  EXPECT_GE(differing(with_crack(drawn, 2, 20, places)), 2u);
  EXPECT_LE(differing(with_missing_tile(drawn, 5, places)), 25u);
  EXPECT_EQ(differing(scene.with_level_of_detail(1)), 0u);
  EXPECT_EQ(differing(scene.with_wrong_normals()), 0u);
  EXPECT_EQ(differing(moved(drawn, 0.0, 0.0)), 0u);
  EXPECT_EQ(differing(with_least_bit_noise(drawn, places)), 0u);
}

// The picture that is drawn through a camera moved by a whole pixel is the picture, moved.
TEST(PlantedScene, IsShiftedToTheRightAndDown) {
  PlantedSceneOptions options;
  options.samples = 65;
  options.width_px = 64;
  options.height_px = 36;
  options.rays_px = 1;
  const PlantedScene scene(options);
  const image::PlaneImage drawn = scene.drawn(), shifted = scene.shifted(1.0, 2.0);
  std::size_t alike = 0, all = 0;
  for (int y = 2; y < 36; ++y) {
    for (int x = 1; x < 64; ++x) {
      const auto here = static_cast<std::size_t>(y * 64 + x);
      const auto there = static_cast<std::size_t>((y - 2) * 64 + x - 1);
      ++all;
      alike += std::abs(shifted.find("R")->values[here] - drawn.find("R")->values[there]) < 1e-4f;
    }
  }
  // Rays that differ by a rounding may meet the other of two triangles: a few in ten thousand.
  EXPECT_GE(alike, all - 2);
}

TEST(Calibration, ProposesWhatWasReachedRoundedUp) {
  EXPECT_DOUBLE_EQ(rounded_outwards(0.1234, false), 0.13);
  EXPECT_DOUBLE_EQ(rounded_outwards(0.12, false), 0.12);
  EXPECT_DOUBLE_EQ(rounded_outwards(1234.0, false), 1300.0);
  EXPECT_DOUBLE_EQ(rounded_outwards(38.77, true), 38.0);
  EXPECT_EQ(rounded_outwards(0.0, false), 0.0);
}

TEST(Calibration, PassesWhatItWasCalibratedByAndIsTightest) {
  PlantedSceneOptions options;
  options.samples = 65;
  options.width_px = 160;
  options.height_px = 90;
  const PlantedScene scene(options);
  Calibrator calibrator(built_in_profiles().front());
  std::vector<HarmedPicture> harmless = harmless_pictures(scene, 1, Channels::ColoursAlone);
  for (const HarmedPicture& each : harmless)
    calibrator.add({"ref", each.kind->name, each.reference, each.picture, {}});
  const Calibration found = calibrator.finish();
  EXPECT_EQ(found.pairs, 2);
  EXPECT_TRUE(found.hopeless.empty());
  for (const HarmedPicture& each : harmless) {
    EXPECT_TRUE(compare_pictures({"ref", "out", each.reference, each.picture, {}}, found.proposed)
                    .passes());
  }
  for (const CalibratedLimit& each : found.limits) {
    EXPECT_LE(each.reached, each.limit.bound);
    if (!each.measured) continue;
    EXPECT_LE(each.limit.bound, each.reached * 1.1 + 1e-12);
  }
}

TEST(Calibration, NamesPairsThatNoLimitPasses) {
  PlantedSceneOptions options;
  options.samples = 65;
  const PlantedScene scene(options);
  const image::PlaneImage drawn = colours_alone(scene.drawn());
  Calibrator calibrator(built_in_profiles().front());
  calibrator.add({"ref", "out", drawn, encoded_twice(drawn), {}});
  ASSERT_FALSE(calibrator.finish().hopeless.empty());
  EXPECT_NE(calibrator.finish().hopeless.front().find("encoded twice"), std::string::npos);
  EXPECT_THROW(Calibrator(built_in_profiles().front()).finish(), InputError);
}

}  // namespace
}  // namespace plumb::compare
