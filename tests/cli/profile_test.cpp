// plumb profile, and what is drawn by the profile that it wrote.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

const std::string kTerrain = "generate:alpine?size=65&seed=3";

TEST(ProfileCommand, WritesAProfileThatMethodsTake) {
  const TemporaryFolder folder;
  const std::string mine = folder.file("mine.toml"), table = folder.file("views.csv");
  const CommandResult result = run_plumb({"profile", kTerrain, "--size", "64x36", "--views", "3",
                                          "-o", mine, "--table", table, "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const json measured = json::parse(result.out);
  EXPECT_GT(measured.at("vertices_per_s"), 0.0);
  EXPECT_GT(measured.at("pixels_per_s"), 0.0);
  EXPECT_EQ(measured.at("model").at("views"), 3);
  const std::string rows = text_of(table);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 4);

  // The picture that was drawn by it can be drawn again without the file.
  const CommandResult drawn =
      run_plumb({"render", kTerrain, "--method", "hybrid-slicing", "--tolerance", "1px", "--set",
                 "profile=" + mine, "--size", "64x36", "-o", folder.file("out"), "--json"});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  const json first = json::parse(drawn.out);
  EXPECT_EQ(
      first.at("method").at("parameters").at("profile").get<std::string>().rfind("measured,", 0),
      0u);
  fs::remove(mine);
  const CommandResult again = run_plumb(
      {"render", folder.file("out") + "/scene.toml", "-o", folder.file("b.exr"), "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(json::parse(again.out).at("picture").at("checksum"),
            first.at("picture").at("checksum"));
}

TEST(ProfileCommand, EndsWithTwoForWhatMakesNoSense) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> wrong{{"--table", folder.file("t.csv")},
                                                    {"--name", "a,b"},
                                                    {"--size", "0x4"},
                                                    {"--views", "-1"},
                                                    {"-o", folder.file("no/such/mine.toml")}};
  for (std::vector<std::string> options : wrong) {
    options.insert(options.begin(), {"profile", kTerrain});
    const CommandResult result = run_plumb(options);
    EXPECT_EQ(result.status, 2) << options.back() << result.out;
    EXPECT_FALSE(result.err.empty());
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(RenderCommand, RefusesAMeshOfSlices) {
  const TemporaryFolder folder;
  const CommandResult result =
      run_plumb({"render", kTerrain, "--method", "slicing", "--size", "64x36", "-o",
                 folder.file("a.exr"), "--mesh", folder.file("a.ply")});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("draws no mesh"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace plumb::testing
