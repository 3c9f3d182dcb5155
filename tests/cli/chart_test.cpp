// plumb chart, as a person would run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "support/run_command.h"
#include "support/sweep_lines.h"

namespace plumb::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string two_methods() {
  return line_of({.error_px = 0.0, .triangles = 5000}) +
         line_of({.method = "rough", .error_px = 0.7}) +
         line_of({.method = "rough", .camera = "top", .status = "failed"});
}

bool has(const json& files, const std::string& name) {
  return std::find(files.begin(), files.end(), name) != files.end();
}

TEST(ChartCommand, WritesAPageAndPicturesForPrint) {
  const TemporaryFolder folder;
  write(folder.file("r.jsonl"), two_methods());
  const CommandResult result =
      run_plumb({"chart", folder.file("r.jsonl"), "-o", folder.file("charts"), "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const json said = json::parse(result.out);
  EXPECT_EQ(said.at("runs"), 2);
  EXPECT_EQ(said.at("failed"), 1);
  for (const char* name :
       {"charts.html", "tables.md", "cost-error.svg", "claims.svg", "winners.svg"}) {
    EXPECT_TRUE(has(said.at("files"), name)) << name;
    EXPECT_FALSE(text_of(folder.file("charts/") + name).empty()) << name;
  }
  EXPECT_FALSE(has(said.at("files"), "path.svg"));  // no camera path
  EXPECT_NE(text_of(folder.file("charts/charts.html")).find("made up"), std::string::npos);
}

TEST(ChartCommand, WritesTheSameBytesAgain) {
  const TemporaryFolder folder;
  write(folder.file("r.jsonl"), two_methods());
  std::vector<std::string> files[2];
  for (std::vector<std::string>& all : files) {
    const CommandResult result = run_plumb({"chart", "r.jsonl", "-o", "charts", "--json"},
                                           {.folder = folder.path().string()});
    ASSERT_EQ(result.status, 0) << result.err;
    const json written = json::parse(result.out).at("files");
    for (const json& name : written)
      all.push_back(text_of(folder.file("charts/") + name.get<std::string>()));
    fs::remove_all(folder.file("charts"));
  }
  EXPECT_FALSE(files[0].empty());
  EXPECT_EQ(files[0], files[1]);
}

// Nothing in PATH: no node, no rsvg-convert.
TEST(ChartCommand, DrawsPlainlyWithoutNodeAndSaysSo) {
  const TemporaryFolder folder;
  write(folder.file("r.jsonl"), two_methods());
  const CommandResult result =
      run_plumb({"chart", folder.file("r.jsonl"), "-o", folder.file("charts"), "--json"},
                {.environment = {{"PATH", folder.path().string()}}});
  ASSERT_EQ(result.status, 0) << result.err;
  const json said = json::parse(result.out);
  EXPECT_EQ(said.at("files").back(), "winners.svg");
  const std::string left_out = said.at("left_out").dump();
  EXPECT_NE(left_out.find("node"), std::string::npos);
  EXPECT_NE(left_out.find("rsvg-convert"), std::string::npos);
  EXPECT_NE(text_of(folder.file("charts/cost-error.svg")).find("class=\"front\""),
            std::string::npos);
}

// The command by itself, away from the library that lies beside it.
TEST(ChartCommand, WritesAPageWithPlainChartsWithoutTheLibrary) {
  const TemporaryFolder folder;
  write(folder.file("r.jsonl"), two_methods());
  fs::create_directory(folder.path() / "bin");
  fs::copy_file(PLUMB_BIN_DIR "/plumb", folder.path() / "bin/plumb");
  const CommandResult result = run_command(
      {folder.file("bin/plumb"), "chart", folder.file("r.jsonl"), "-o", folder.file("charts")});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("vega.min.js"), std::string::npos);
  const std::string page = text_of(folder.file("charts/charts.html"));
  EXPECT_NE(page.find("data:image/svg+xml"), std::string::npos);
  EXPECT_EQ(page.find("unsafe-eval"), std::string::npos);
}

TEST(ChartCommand, SaysThatALastLineIsTorn) {
  const TemporaryFolder folder;
  write(folder.file("r.jsonl"), two_methods() + "{\"schema\":");
  const CommandResult result =
      run_plumb({"chart", folder.file("r.jsonl"), "-o", folder.file("charts"), "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("torn"), std::string::npos) << result.err;
  EXPECT_EQ(json::parse(result.out).at("torn"), true);
}

TEST(ChartCommand, MakesMapsOfARunByItsOwnCommand) {
  const TemporaryFolder folder;
  write(folder.file("r.jsonl"),
        line_of({.command = "plumb audit 'generate:alpine?size=17' --method restricted-quadtree "
                            "--tolerance 4px --size 64x36"}));
  const CommandResult result =
      run_plumb({"chart", folder.file("r.jsonl"), "-o", folder.file("charts"), "--maps",
                 "hills/oblique", "--json"});
  ASSERT_EQ(result.status, 0) << result.err;
  const json files = json::parse(result.out).at("files");
  for (const char* name : {"map-1-error.png", "map-1-overdraw.png", "map-1-triangles.png"})
    EXPECT_TRUE(has(files, name)) << name;
}

TEST(ChartCommand, EndsWithTwoAndOneLineForWhatItCannotRead) {
  const TemporaryFolder folder;
  const std::string results = folder.file("r.jsonl");
  const auto run = [&](const std::string& text, std::vector<std::string> more = {}) {
    write(results, text);
    std::vector<std::string> arguments{"chart", results, "-o", folder.file("charts")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandResult result = run_plumb(arguments);
    EXPECT_EQ(result.status, 2) << text;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(fs::exists(folder.file("charts")));
  };
  run("");
  run("no JSON\n");
  run("{\"schema\":\"plumb.audit/1\"}\n");
  run(line_of({.status = "failed"}));
  run(two_methods(), {"--maps", "hills/elsewhere"});
  run(two_methods(), {"--cost", "slices"});
  run(two_methods(), {"--cost", "beauty"});
}

}  // namespace
}  // namespace plumb::testing
