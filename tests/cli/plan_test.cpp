// plumb plan, as a person would run it.
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

using nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const std::string kScene = R"(terrains = ["generate:alpine?size=65"]
methods = ["full", "restricted-quadtree", "tessellation"]
variants = ["conservative"]
tolerances_px = [0.5, 2, 8]
cameras = ["oblique", "valley", "top"]
width = 96
height = 54
)";

class Plan : public ::testing::Test {
 protected:
  Plan() { std::ofstream(scene()) << kScene; }
  std::string scene() const { return folder_.file("scene.toml"); }
  std::string results() const { return folder_.file("results.jsonl"); }
  void sweep() const {
    const CommandResult run = run_plumb({"sweep", scene(), "-o", results()});
    ASSERT_EQ(run.status, 0) << run.err;
  }

 private:
  TemporaryFolder folder_;
};

// What a reader of the file finds by himself: of "oblique" and "valley", the first two of three
// views, the method and tolerance of fewest triangles whose error is at most a pixel in both.
TEST_F(Plan, ChoosesWhatAReaderOfTheResultsWould) {
  sweep();
  struct Found {
    double triangles = 0.0, error = 0.0;
  };
  std::map<std::pair<std::string, double>, Found> settings;
  std::ifstream file(results());
  for (std::string line; std::getline(file, line);) {
    const json run = json::parse(line);
    const json& asked = run.at("asked");
    if (run.at("status") != "done" || asked.at("camera").at("name") == "top") continue;
    Found& found = settings[{asked.at("method"), asked.at("tolerance").at("value")}];
    found.triangles += run.at("cost").at("triangles").get<double>() / 2.0;
    found.error =
        std::max(found.error, run.at("errors").at("pixel_vertical_px").at("max").get<double>());
  }
  ASSERT_EQ(settings.size(), 9u);
  std::pair<std::string, double> best;
  double fewest = kInfinity;
  for (const auto& [setting, found] : settings) {
    if (found.error > 1.0 || found.triangles >= fewest) continue;
    fewest = found.triangles;
    best = setting;
  }

  const CommandResult run = run_plumb(
      {"plan", "--results", results(), "--error", "1px", "--cost", "triangles", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json plan = json::parse(run.out);
  EXPECT_EQ(plan.at("schema"), "plumb.plan/1");
  EXPECT_EQ(plan.at("met"), true);
  const json& terrain = plan.at("terrains").at(0);
  const json& choice = terrain.at("choice");
  EXPECT_EQ(choice.at("method"), best.first);
  EXPECT_EQ(choice.at("tolerance").at("value"), best.second);
  EXPECT_EQ(choice.at("cost"), fewest);
  EXPECT_EQ(terrain.at("held_out").at("views"), json::array({"top"}));
  EXPECT_LE(terrain.at("held_out").at("error_px"), 1.0);
  EXPECT_NE(terrain.at("runner_up").at("method"), best.first);
}

TEST_F(Plan, MeasuresTheSceneItselfAndChoosesTheSame) {
  sweep();
  const auto choice = [](const CommandResult& run) {
    return json::parse(run.out).at("terrains").at(0).at("choice");
  };
  const std::vector<std::string> how{"--error", "1px", "--cost", "triangles", "--json"};
  std::vector<std::string> own{"plan", scene()}, read{"plan", "--results", results()};
  own.insert(own.end(), how.begin(), how.end());
  read.insert(read.end(), how.begin(), how.end());
  EXPECT_EQ(choice(run_plumb(own)), choice(run_plumb(read)));
}

TEST_F(Plan, SaysHowNearTheBestCameWhereNothingKeepsTheError) {
  std::ofstream(scene()) << R"(terrains = ["generate:alpine?size=65"]
methods = ["restricted-quadtree"]
tolerances_px = [4]
cameras = ["oblique", "valley"]
width = 96
height = 54
)";
  sweep();
  const CommandResult run =
      run_plumb({"plan", "--results", results(), "--error", "0.01px", "--cost", "triangles"});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.out.find("Nothing keeps 0.01 px"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("nearest"), std::string::npos) << run.out;
}

TEST_F(Plan, NeedsOneSourceOfRunsAnErrorInPixelsAndACostThatThereIs) {
  sweep();
  const auto expect_line = [](const CommandResult& run, const std::string& words) {
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
  };
  expect_line(run_plumb({"plan"}), "one of the two");
  expect_line(run_plumb({"plan", scene(), "--results", results()}), "one of the two");
  expect_line(run_plumb({"plan", "--results", results(), "--error", "1m"}), "expected pixels");
  expect_line(run_plumb({"plan", "--results", results(), "--cost", "gold"}), "draw-cpu");
  expect_line(run_plumb({"plan", "--results", results() + "x"}), "results.jsonlx");
}

}  // namespace
}  // namespace plumb::testing
