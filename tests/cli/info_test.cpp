// plumb info on terrains whose figures are known.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

nlohmann::json info_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "info");
  arguments.push_back("--json");
  const CommandResult result = run_plumb(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return nlohmann::json::parse(result.out, nullptr, false);
}

TEST(Info, TellsSizeSpacingAndExtent) {
  const nlohmann::json info = info_of({"generate:alpine?size=65&seed=7&spacing=10"});
  EXPECT_EQ(info.at("schema"), "plumb.info/1");
  EXPECT_EQ(info.at("terrain").at("columns"), 65);
  EXPECT_EQ(info.at("terrain").at("spacing_m"), (std::vector<double>{10, 10}));
  EXPECT_EQ(info.at("terrain").at("extent_m"), (std::vector<double>{640, 640}));
  EXPECT_EQ(info.at("voids").at("samples"), 0);
  EXPECT_EQ(info.at("slopes").at("cells"), 64 * 64);
}

TEST(Info, HoldsTheCommandThatMakesItAgain) {
  const nlohmann::json info = info_of({"generate:alpine?size=65&seed=7"});
  EXPECT_EQ(info.at("command"), "plumb info 'generate:alpine?size=65&seed=7' --json");
  const std::string line = info.at("command");
  const CommandResult again = run_command({"sh", "-c", std::string(PLUMB_BIN_DIR) + "/" + line});
  EXPECT_EQ(nlohmann::json::parse(again.out), info);
}

TEST(Info, WritesAPreviewAndNothingElse) {
  const TemporaryFolder folder;
  const CommandResult result =
      run_plumb({"info", "generate:alpine?size=65", "--preview", folder.file("p.png")});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"p.png"}));
  EXPECT_GT(std::filesystem::file_size(folder.file("p.png")), 1000u);
}

TEST(Info, IsTheSameForAnyNumberOfThreads) {
  const std::vector<std::string> arguments{"info", "generate:alpine?size=257&seed=3", "--threads"};
  std::vector<std::string> one = arguments, seven = arguments;
  one.push_back("1");
  seven.push_back("7");
  EXPECT_EQ(run_plumb(one).out, run_plumb(seven).out);
}

// Three seconds of arc, big endian, every sample 258 m but two voids; its name says nothing.
TEST(Info, TakesAnHgtFileOfAnyNameWithItsOrigin) {
  const TemporaryFolder folder;
  const std::string file = folder.file("somewhere.hgt");
  {
    std::string bytes(2 * 1201 * 1201, '\x01');
    for (std::size_t k = 1; k < bytes.size(); k += 2) bytes[k] = '\x02';
    for (const std::size_t voids : {std::size_t{0}, bytes.size() / 2 - 1}) {
      bytes[voids - voids % 2] = '\x80';
      bytes[voids - voids % 2 + 1] = '\x00';
    }
    std::ofstream(file, std::ios::binary) << bytes;
  }
  const CommandResult without = run_plumb({"info", file});
  EXPECT_EQ(without.status, 2);
  EXPECT_NE(without.err.find("--origin LON,LAT"), std::string::npos) << without.err;
  const nlohmann::json info = info_of({file, "--origin", "8,46"});
  EXPECT_EQ(info.at("terrain").at("columns"), 1201);
  EXPECT_EQ(info.at("voids").at("samples"), 2);
  EXPECT_EQ(info.at("highest").at("height_m"), 258.0);
  EXPECT_NE(std::string(info.at("command")).find("--origin 8,46"), std::string::npos);
  EXPECT_EQ(run_plumb({"info", file, "--origin", "8,91"}).status, 2);
}

// As the folder's own README states it.
TEST(Info, FindsTheLowestAndHighestSampleOfARealFile) {
  const std::string file = PLUMB_SOURCE_DIR "/../shared/data/N29W014.hgt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const nlohmann::json info = info_of({file});
  EXPECT_EQ(info.at("terrain").at("columns"), 1201);
  EXPECT_EQ(info.at("lowest").at("height_m"), -14.0);
  EXPECT_EQ(info.at("highest").at("height_m"), 669.0);
  EXPECT_EQ(info.at("voids").at("samples"), 2);
  EXPECT_FALSE(info.at("assumptions").empty());
}

TEST(Info, NamesTheWindowInTheFilesOwnColumnsAndRows) {
  const std::string file = PLUMB_SOURCE_DIR "/../shared/data/bigtujunga_30m.tif";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const nlohmann::json info = info_of({file, "--window", "300,100,257,129"});
  EXPECT_EQ(info.at("terrain").at("window"), (std::vector<int>{300, 100, 257, 129}));
  for (const char* place : {"lowest", "highest"}) {
    EXPECT_GE(info.at(place).at("column"), 300);
    EXPECT_LT(info.at(place).at("column"), 557);
    EXPECT_GE(info.at(place).at("row"), 100);
    EXPECT_LT(info.at(place).at("row"), 229);
  }
}

TEST(Info, ShowsAFileWithoutSpacingAndSaysWhatItAssumed) {
  const std::string file = PLUMB_SOURCE_DIR "/../shared/data/martini_fuji_terrainrgb.png";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const nlohmann::json info = info_of({file, "--decode", "terrain-rgb"});
  EXPECT_EQ(info.at("terrain").at("columns"), 512);
  EXPECT_NEAR(info.at("highest").at("height_m").get<double>(), 3751.0, 0.05);  // stated to 0.1 m
  EXPECT_NE(info.at("assumptions").dump().find("spacing"), std::string::npos);
}

}  // namespace
}  // namespace plumb::testing
