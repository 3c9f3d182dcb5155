// plumb sweep and merge, as a person would run them.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

using Json = nlohmann::ordered_json;

// One terrain, two methods, two tolerances, two cameras: 8 runs, and 4 without a variant.
const std::string kScene = R"(terrains = ["generate:alpine?size=65"]
methods = ["restricted-quadtree", "tessellation"]
variants = ["conservative"]
tolerances_px = [1, 8]
cameras = ["oblique", { name = "down", preset = "top", fov_y_deg = 20 }]
width = 64
height = 36
)";

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> lines_of(const std::string& path) {
  std::vector<std::string> lines;
  std::istringstream text(text_of(path));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

// The file's bytes with `timing` taken out of each line.
std::string untimed(const std::string& path) {
  std::string text;
  for (const std::string& line : lines_of(path)) {
    Json json = Json::parse(line);
    json.erase("timing");
    text += json.dump() + "\n";
  }
  return text;
}

class Sweep : public ::testing::Test {
 protected:
  Sweep() { write_scene(kScene); }
  void write_scene(const std::string& text) { std::ofstream(file("scene.toml")) << text; }
  std::string file(const std::string& name) const { return folder_.file(name); }
  CommandResult sweep(const std::string& output, std::vector<std::string> more = {},
                      const CommandOptions& options = {}) const {
    more.insert(more.begin(), {"sweep", file("scene.toml"), "-o", file(output)});
    return run_plumb(more, options);
  }

  TemporaryFolder folder_;
};

TEST_F(Sweep, WritesALineARunInTheOrderOfTheScene) {
  const CommandResult result = sweep("r.jsonl");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out.substr(0, 16), "8 runs: 8 done\nw") << result.out;
  const std::vector<std::string> lines = lines_of(file("r.jsonl"));
  ASSERT_EQ(lines.size(), 8u);
  const Json line = Json::parse(lines[5]);
  EXPECT_EQ(line.begin().key(), "schema");
  EXPECT_EQ(line.at("index"), 5);
  EXPECT_EQ(line.at("asked").at("method"), "tessellation");
  EXPECT_EQ(line.at("asked").at("camera").at("name"), "down");
  EXPECT_EQ(line.at("asked").at("tolerance").at("value"), 1.0);
  EXPECT_EQ(line.at("asked").at("size_px"), (Json{64, 36}));
  EXPECT_TRUE(line.at("timing").at("shared").get<bool>());
  EXPECT_EQ(folder_.names(), (std::vector<std::string>{"r.jsonl", "scene.toml"}));
}

// What a line says is what plumb audit says.
TEST_F(Sweep, NamesTheAuditThatSaysTheSame) {
  ASSERT_EQ(sweep("r.jsonl").status, 0);
  for (const std::size_t run : {1u, 6u}) {
    const Json line = Json::parse(lines_of(file("r.jsonl")).at(run));
    const std::string command = line.at("command").get<std::string>() + " --json";
    const std::string path = std::string(PLUMB_BIN_DIR) + ":" + ::getenv("PATH");
    const CommandResult result =
        run_command({"sh", "-c", command}, {folder_.path().string(), {{"PATH", path}}});
    ASSERT_EQ(result.status, 0) << command << result.err;
    const Json audit = Json::parse(result.out);
    for (const char* member : {"verdict", "claims", "patch_claims", "errors", "samples", "coverage",
                               "topology", "registration", "cost"})
      EXPECT_EQ(line.at(member), audit.at(member)) << member;
    EXPECT_EQ(line.at("asked").at("terrain").at("checksum"), audit.at("terrain").at("checksum"));
    EXPECT_EQ(line.at("worst"),
              audit.at("offenders").empty() ? Json(nullptr) : audit.at("offenders").at(0));
  }
}

TEST_F(Sweep, HasTheSameBytesOnAnyNumberOfThreads) {
  ASSERT_EQ(sweep("one.jsonl", {"--threads", "1"}).status, 0);
  ASSERT_EQ(sweep("four.jsonl", {"--threads", "4"}).status, 0);
  EXPECT_EQ(untimed(file("one.jsonl")), untimed(file("four.jsonl")));
}

// Killed again and again, each time a little later, until one gets to the end.
TEST_F(Sweep, GoesOnWhereItWasKilled) {
  ASSERT_EQ(sweep("whole.jsonl").status, 0);
  std::set<std::string> finished;
  CommandOptions options;
  options.signal = SIGKILL;
  int kills = 0;
  for (double delay_ms = 20.0; delay_ms < 60'000.0; delay_ms *= 1.25) {
    options.signal_after = std::chrono::milliseconds(static_cast<int>(delay_ms));
    const CommandResult result = sweep("r.jsonl", {"--threads", "1"}, options);
    std::string text = text_of(file("r.jsonl"));
    text.resize(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
    for (const std::string& line : finished)
      ASSERT_NE(text.find(line), std::string::npos) << "was lost, or run again: " << line;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) finished.insert(line);
    if (result.status == 0) break;
    ASSERT_EQ(result.status, 128 + SIGKILL) << result.err;
    ++kills;
  }
  EXPECT_GE(kills, 1);
  EXPECT_EQ(untimed(file("r.jsonl")), untimed(file("whole.jsonl")));
}

TEST_F(Sweep, DropsATornLineAndRepeatsNothingElse) {
  ASSERT_EQ(sweep("r.jsonl").status, 0);
  const std::string whole = text_of(file("r.jsonl"));
  std::ofstream(file("r.jsonl")) << whole.substr(0, whole.size() - 100);
  const CommandResult again = sweep("r.jsonl");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("8 of 8 runs of the scene, 1 of them now"), std::string::npos)
      << again.out;
  const std::vector<std::string> lines = lines_of(file("r.jsonl"));
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_EQ(whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1),
            text_of(file("r.jsonl")).substr(0, whole.rfind('\n', whole.size() - 2) + 1));
  EXPECT_NE(sweep("r.jsonl").out.find(" 0 of them now"), std::string::npos);
}

TEST_F(Sweep, JoinsPartsIntoTheWhole) {
  ASSERT_EQ(sweep("whole.jsonl").status, 0);
  std::vector<std::string> merge{"merge", "-o", file("all.jsonl")};
  for (const char* part : {"3/3", "1/3", "2/3"}) {
    const std::string name = std::string("part") + part[0] + ".jsonl";
    ASSERT_EQ(sweep(name, {"--shard", part}).status, 0);
    EXPECT_LE(lines_of(file(name)).size(), 3u);
    merge.push_back(file(name));
  }
  const CommandResult result = run_plumb(merge);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(untimed(file("all.jsonl")), untimed(file("whole.jsonl")));
  merge.pop_back();
  const CommandResult lacking = run_plumb(merge);
  EXPECT_NE(lacking.out.find("are missing"), std::string::npos) << lacking.out;
  EXPECT_EQ(run_plumb({"sweep", file("scene.toml"), "-o", file("all.jsonl")}).status, 0);
  EXPECT_EQ(untimed(file("all.jsonl")), untimed(file("whole.jsonl")));
}

TEST_F(Sweep, RefusesPartsThatDisagree) {
  ASSERT_EQ(sweep("a.jsonl", {"--shard", "1/8"}).status, 0);
  std::string text = text_of(file("a.jsonl"));
  const std::string key = Json::parse(text).at("key");
  text.replace(text.find("\"verdict\":\"held\""), 16, "\"verdict\":\"none\"");
  std::ofstream(file("b.jsonl")) << text;
  const CommandResult result =
      run_plumb({"merge", file("a.jsonl"), file("b.jsonl"), "-o", file("all.jsonl")});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("run " + key), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
}

// The conservative variant has nothing to mend.
TEST_F(Sweep, TellsWhatFailedAndWhatWasSkipped) {
  write_scene(kScene +
              "[parameters.tessellation]\nmend = \"all\"\n[only.restricted-quadtree]\n"
              "variants = [\"conservative\", \"published\"]\n");
  const CommandResult result = sweep("r.jsonl");
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')), "12 runs: 4 done, 4 failed, 4 skipped");
  EXPECT_NE(result.out.find("failed 4: parameter mend: the conservative variant has nothing to "
                            "mend (the first: alpine, tessellation, conservative, 1px, oblique)"),
            std::string::npos)
      << result.out;
  EXPECT_NE(
      result.out.find("skipped 4: method restricted-quadtree has no variant 'published': it has "
                      "conservative"),
      std::string::npos)
      << result.out;
  const Json line = Json::parse(lines_of(file("r.jsonl")).at(8));
  EXPECT_EQ(line.at("status"), "failed");
  EXPECT_FALSE(line.contains("verdict"));
  const CommandResult again = sweep("r.jsonl", {"--json"});
  EXPECT_EQ(again.status, 1);
  EXPECT_EQ(Json::parse(again.out).at("failed"), 4);
  EXPECT_NE(sweep("r.jsonl", {"--retry"}).out.find(" 4 of them now"), std::string::npos);
}

TEST_F(Sweep, RefusesRunsOfAnotherScene) {
  ASSERT_EQ(sweep("r.jsonl").status, 0);
  const std::string before = text_of(file("r.jsonl"));
  std::string changed = kScene;
  changed.replace(changed.find("[1, 8]"), 6, "[8, 2]");
  write_scene(changed);
  const CommandResult refused = sweep("r.jsonl");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("4 of its 8 runs are none of"), std::string::npos) << refused.err;
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1);
  EXPECT_EQ(text_of(file("r.jsonl")), before);
  const CommandResult pruned = sweep("r.jsonl", {"--prune"});
  EXPECT_EQ(pruned.status, 0) << pruned.err;
  EXPECT_NE(pruned.out.find("8 of 8 runs of the scene, 4 of them now"), std::string::npos);
  ASSERT_EQ(sweep("fresh.jsonl").status, 0);
  EXPECT_EQ(untimed(file("r.jsonl")), untimed(file("fresh.jsonl")));
}

TEST_F(Sweep, TimesOneRunAtATime) {
  ASSERT_EQ(sweep("r.jsonl", {"--shard", "1/4"}).status, 0);
  const CommandResult refused = sweep("r.jsonl", {"--time"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("were timed while others ran"), std::string::npos) << refused.err;
  ASSERT_EQ(sweep("r.jsonl", {"--time", "--repeat", "3", "--prune"}).status, 0);
  for (const std::string& text : lines_of(file("r.jsonl"))) {
    const Json timing = Json::parse(text).at("timing");
    EXPECT_FALSE(timing.at("shared").get<bool>());
    const Json& draw = timing.at("draw");
    EXPECT_EQ(draw.at("runs"), 3);
    EXPECT_GT(draw.at("cpu_s"), 0.0);
    EXPECT_GE(draw.at("wall_spread_s"), 0.0);
  }
  ASSERT_EQ(sweep("plain.jsonl").status, 0);
  EXPECT_EQ(untimed(file("r.jsonl")), untimed(file("plain.jsonl")));
}

TEST_F(Sweep, RefusesWhatMakesNoSense) {
  const auto error = [&](std::vector<std::string> arguments) {
    const CommandResult result = run_plumb(std::move(arguments));
    EXPECT_EQ(result.status, 2) << result.out;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    return result.err;
  };
  const std::string scene = file("scene.toml"), output = file("r.jsonl");
  EXPECT_NE(error({"sweep", scene}).find("sweep needs -o"), std::string::npos);
  EXPECT_NE(error({"sweep", scene, "-o", output, "--shard", "3/2"}).find("I/N"), std::string::npos);
  EXPECT_NE(error({"sweep", scene, "-o", output, "--time", "--threads", "2"}).find("--time"),
            std::string::npos);
  EXPECT_NE(error({"sweep", scene, "-o", scene}).find("line 1: this is no result"),
            std::string::npos);
  EXPECT_EQ(text_of(scene), kScene);
  EXPECT_FALSE(std::filesystem::exists(output));
}

}  // namespace
}  // namespace plumb::testing
