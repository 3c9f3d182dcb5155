// plumb render, as a person would run it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

using nlohmann::json;

constexpr const char* kTerrain = "generate:alpine?size=65&seed=3";

std::vector<std::string> render(const std::string& output,
                                const std::vector<std::string>& more = {},
                                const std::string& terrain = kTerrain) {
  std::vector<std::string> arguments{"render", terrain, "-o", output};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

json summary(std::vector<std::string> arguments) {
  arguments.push_back("--json");
  const CommandResult result = run_plumb(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return json::parse(result.out);
}

TEST(RenderCommand, WritesTheFileThatItIsAskedFor) {
  const TemporaryFolder folder;
  const std::vector<std::string> size{"--size", "64x36"};
  EXPECT_EQ(run_plumb(render(folder.file("a.exr"), size)).status, 0);
  EXPECT_EQ(run_plumb(render(folder.file("a.png"), size)).status, 0);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.exr", "a.png"}));
  EXPECT_EQ(bytes_of(folder.file("a.exr")).substr(0, 4), "\x76\x2f\x31\x01");
  EXPECT_EQ(bytes_of(folder.file("a.png")).substr(1, 3), "PNG");
  const CommandResult piped = run_plumb(render("-", size));
  EXPECT_EQ(piped.out, bytes_of(folder.file("a.exr")));
}

TEST(RenderCommand, LaysAPictureOverTheGround) {
  const TemporaryFolder folder;
  const std::string drape = folder.file("drape.png");
  ASSERT_EQ(run_plumb({"info", kTerrain, "--preview", drape}).status, 0);
  const std::vector<std::string> plain{"--size", "64x36"};
  const std::vector<std::string> draped{"--size", "64x36", "--drape", drape};
  EXPECT_EQ(run_plumb(render(folder.file("plain.png"), plain)).status, 0);
  EXPECT_EQ(run_plumb(render(folder.file("draped"), draped)).status, 0);
  const std::string picture = bytes_of(folder.file("draped/picture.png"));
  EXPECT_NE(picture, bytes_of(folder.file("plain.png")));
  // From the scene that was written, and by rays.
  EXPECT_EQ(
      run_plumb(render(folder.file("again.png"), {}, folder.file("draped/scene.toml"))).status, 0);
  EXPECT_EQ(bytes_of(folder.file("again.png")), picture);
  const CommandResult truth = run_plumb(
      {"truth", kTerrain, "--size", "64x36", "--drape", drape, "-o", folder.file("truth.png")});
  EXPECT_EQ(truth.status, 0) << truth.err;
  const CommandResult none = run_plumb(render(folder.file("none.png"), {"--drape", "nowhere.png"}));
  EXPECT_EQ(none.status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.file("none.png")));
}

TEST(RenderCommand, BlendsSlicesInColourAlone) {
  const TemporaryFolder folder;
  const std::vector<std::string> sharp{"--size", "64x36", "--method", "slicing", "--tilt", "40"};
  std::vector<std::string> soft = sharp;
  for (const char* more : {"--set", "antialias=2", "--set", "fog=5", "--set", "fog_height=50"})
    soft.emplace_back(more);
  const json first = summary(render(folder.file("sharp"), sharp));
  const json second = summary(render(folder.file("soft"), soft));
  EXPECT_EQ(first.at("counters"), second.at("counters"));
  EXPECT_NE(first.at("picture"), second.at("picture"));
  const json again = summary(render(folder.file("again.exr"), {}, folder.file("soft/scene.toml")));
  EXPECT_EQ(again.at("picture"), second.at("picture"));
  const CommandResult refused =
      run_plumb(render(folder.file("no.png"), {"--method", "slicing", "--set", "antialias=-1"}));
  EXPECT_EQ(refused.status, 2);
}

TEST(TruthCommand, WritesToStandardOutputWhatItWritesToAFile) {
  const TemporaryFolder folder;
  const std::vector<std::string> cast{"truth", kTerrain, "--size", "64x36", "-o"};
  std::vector<std::string> piped = cast, filed = cast;
  piped.push_back("-");
  filed.push_back(folder.file("a.exr"));
  EXPECT_EQ(run_plumb(filed).status, 0);
  EXPECT_EQ(run_plumb(piped).out, bytes_of(folder.file("a.exr")));
}

TEST(RenderCommand, DrawsTheSameFromTheSceneThatItWrote) {
  const TemporaryFolder folder;
  const std::vector<std::string> options{"--size",      "64x36", "--camera", "valley",
                                         "--tolerance", "5m",    "--set",    "patch_cells=16"};
  const json first = summary(render(folder.file("out"), options));
  const json again = summary(render(folder.file("again.exr"), {}, folder.file("out/scene.toml")));
  EXPECT_EQ(first.at("picture"), again.at("picture"));
  EXPECT_EQ(first.at("counters"), again.at("counters"));
  EXPECT_EQ(first.at("scene"), again.at("scene"));
  EXPECT_EQ(bytes_of(folder.file("out/picture.exr")), bytes_of(folder.file("again.exr")));
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/picture.png")));
}

TEST(RenderCommand, GivesTheSameBitsOnAnyNumberOfThreads) {
  const TemporaryFolder folder;
  for (const char* threads : {"1", "2", "7"})
    run_plumb(render(folder.file(threads) + std::string(".exr"),
                     {"--size", "64x36", "--threads", threads}));
  ASSERT_GT(bytes_of(folder.file("1.exr")).size(), 1000u);
  EXPECT_EQ(bytes_of(folder.file("1.exr")), bytes_of(folder.file("2.exr")));
  EXPECT_EQ(bytes_of(folder.file("1.exr")), bytes_of(folder.file("7.exr")));
}

TEST(RenderCommand, CountsWhatItDrew) {
  const TemporaryFolder folder;
  const json full = summary(render(folder.file("a.exr"), {"--method", "full", "--size", "64x36",
                                                          "--mesh", folder.file("a.ply")}));
  EXPECT_EQ(full.at("schema"), "plumb.render/1");
  EXPECT_EQ(full.at("counters").at("triangles"), 2 * 64 * 64);
  EXPECT_EQ(full.at("counters").at("vertices"), 65 * 65);
  EXPECT_EQ(full.at("files").size(), 2u);
  EXPECT_TRUE(full.contains("timing"));
  EXPECT_NE(bytes_of(folder.file("a.ply")).find("element face 8192\n"), std::string::npos);
}

TEST(RenderCommand, SaysWhatItCannotDo) {
  const TemporaryFolder folder;
  const auto error = [](const std::vector<std::string>& arguments) {
    const CommandResult result = run_plumb(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(error({"render", kTerrain}), "render needs -o"));
  EXPECT_TRUE(has(error(render(folder.file("a.jpg"))), ".exr or .png"));
  EXPECT_TRUE(
      has(error(render(folder.file("a.exr"), {"--set", "patch=3"})), "no parameter 'patch'"));
  EXPECT_TRUE(has(error(render(folder.file("a.exr"), {"--tolerance", "3"})), "tolerance '3'"));
  EXPECT_TRUE(has(error(render("-", {"--json"})), "standard output"));
  std::ofstream(folder.file("s.toml"))
      << "[terrain]\nsource = \"generate:plane?size=9\"\n"
         "[camera]\npreset = \"top\"\n[render]\nwhat = \"truth\"\n";
  EXPECT_TRUE(has(error(render(folder.file("a.exr"), {"--size", "8x8"}, folder.file("s.toml"))),
                  "leave their options out"));
  EXPECT_TRUE(has(
      error(render(folder.file("a.exr"), {"--mesh", folder.file("a.ply")}, folder.file("s.toml"))),
      "rays draw no mesh"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"s.toml"});
}

constexpr const char* kPath =
    "[path]\nframes = 2\nwidth = 48\nheight = 27\n"
    "[[key]]\neye = [0, -100, 2900]\ntarget = [600, 600, 1200]\n"
    "[[key]]\neye = [50, -50, 2950]\ntarget = [600, 600, 1200]\n";

TEST(RenderCommand, DrawsEveryFrameOfAPath) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("fly.toml")) << kPath;
  const CommandResult all =
      run_plumb({"render", "generate:alpine?size=33", "--camera", "fly.toml", "-o", "frames"},
                {.folder = folder.path().string()});
  EXPECT_EQ(all.status, 0) << all.err;
  for (const char* name : {"frame_0001.exr", "frame_0001.png", "frame_0002.exr", "frame_0002.png"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "frames" / name)) << name;
  const CommandResult one = run_plumb({"render", "generate:alpine?size=33", "--camera", "fly.toml",
                                       "--frame", "2", "-o", "one.exr"},
                                      {.folder = folder.path().string()});
  EXPECT_EQ(one.status, 0) << one.err;
  const CommandResult none = run_plumb({"truth", "generate:alpine?size=33", "--camera", "fly.toml"},
                                       {.folder = folder.path().string()});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("path of 2 cameras"), std::string::npos) << none.err;
}

TEST(RenderCommand, AuditsEveryFrameOfAPath) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("fly.toml")) << kPath;
  const CommandResult result =
      run_plumb({"audit", "generate:alpine?size=33", "--camera", "fly.toml", "--tolerance", "1px"},
                {.folder = folder.path().string()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("2 of 2 frames keep every claim"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace plumb::testing
