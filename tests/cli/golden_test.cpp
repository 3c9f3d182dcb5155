// plumb golden, as a person would run it; and that it finds what it is there to find.
#include <gtest/gtest.h>

#include <algorithm>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kScene = R"([terrain]
source = "generate:alpine?size=33&seed=2"
[camera]
preset = "oblique"
width = 48
height = 27
[method]
name = "restricted-quadtree"
tolerance = "1px"
)";

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

void replace_in(const fs::path& path, const std::string& what, const std::string& with) {
  std::string text = text_of(path);
  ASSERT_NE(text.find(what), std::string::npos);
  write(path, text.replace(text.find(what), what.size(), with));
}

// A folder with one case, "hill".
class Golden : public ::testing::Test {
 protected:
  void SetUp() override {
    write(folder_.path() / "scene.toml", kScene);
    const CommandResult added =
        run({"add", "hill", folder_.file("scene.toml"), "--why", "A hill."});
    ASSERT_EQ(added.status, 0) << added.err;
  }
  CommandResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "golden");
    arguments.insert(arguments.end(), {"--folder", golden().string()});
    return run_plumb(arguments);
  }
  json checked() const { return json::parse(run({"check", "--json"}).out).at("cases").at(0); }
  fs::path golden() const { return folder_.path() / "golden"; }
  fs::path hill() const { return golden() / "hill"; }

  TemporaryFolder folder_;
};

TEST_F(Golden, HoldsAsLongAsNothingChanges) {
  const CommandResult result = run({"check"});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("hill  same"), std::string::npos) << result.out;
  for (const char* file : {"scene.toml", "why.md", "ref/picture.exr", "ref/picture.png"})
    EXPECT_TRUE(fs::exists(hill() / file)) << file;
  const std::string why = text_of(hill() / "why.md");
  EXPECT_EQ(std::count(why.begin(), why.end(), '\n'), 3);
}

TEST_F(Golden, FindsAChangedScene) {
  replace_in(hill() / "scene.toml", "1px", "3px");
  const CommandResult result = run({"check", "-o", folder_.file("found")});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("hill  differs"), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(folder_.path() / "found" / "hill.exr"));
  const json found = checked();
  EXPECT_EQ(found.at("verdict"), "differs");
  EXPECT_GT(found.at("channels").at(0).at("pixels"), 0);
}

// One bit of one number of the manifest, one pixel of the preview, and a picture of another case:
// each is found.
TEST_F(Golden, FindsAReferenceThatIsNotTheManifests) {
  const std::string digits = checked().at("expected");
  std::string other = digits;
  other.back() = other.back() == '0' ? '1' : '0';
  replace_in(golden() / "manifest.toml", digits, other);
  EXPECT_EQ(run({"check"}).status, 1);
  EXPECT_EQ(checked().at("verdict"), "differs");
  replace_in(golden() / "manifest.toml", other, digits);
  EXPECT_EQ(run({"check"}).status, 0);

  write(folder_.path() / "other.toml", kScene);
  replace_in(folder_.path() / "other.toml", "seed=2", "seed=3");
  ASSERT_EQ(run_plumb({"render", folder_.file("other.toml"), "-o", folder_.file("other")}).status,
            0);
  const auto swapped = [&](const char* file) {
    const fs::path kept = folder_.path() / "kept", ref = hill() / "ref" / file;
    fs::rename(ref, kept);
    fs::copy_file(folder_.path() / "other" / file, ref);
    const json found = checked();
    fs::remove(ref);
    fs::rename(kept, ref);
    return found;
  };
  EXPECT_EQ(swapped("picture.exr").at("verdict"), "stale");
  EXPECT_EQ(swapped("picture.png").at("verdict"), "stale");
  EXPECT_EQ(run({"check"}).status, 0);
}

TEST_F(Golden, FailsWithoutAReference) {
  fs::remove(hill() / "ref" / "picture.exr");
  EXPECT_EQ(run({"check"}).status, 1);
  EXPECT_EQ(checked().at("verdict"), "missing");
}

TEST_F(Golden, EndsWithTwoIfACaseCannotBeDrawn) {
  replace_in(hill() / "scene.toml", "[method]", "[methods]");
  const CommandResult result = run({"check"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.out.find("hill  failed"), std::string::npos);
  EXPECT_NE(result.err.find("unknown key"), std::string::npos) << result.err;
}

TEST_F(Golden, RefusesFilesThatNoCaseNames) {
  fs::create_directories(golden() / "forgotten");
  const CommandResult result = run({"check"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("no case names forgotten"), std::string::npos) << result.err;
  EXPECT_EQ(run({"check", "nobody"}).status, 2);
}

TEST_F(Golden, IsReplacedOnlyWhenThatIsAccepted) {
  EXPECT_NE(run({"update", "hill"}).out.find("nothing changes"), std::string::npos);
  replace_in(hill() / "scene.toml", "1px", "3px");
  const std::string manifest = text_of(golden() / "manifest.toml");
  const std::string exr = text_of(hill() / "ref" / "picture.exr");
  const CommandResult shown = run({"update", "hill"});
  EXPECT_EQ(shown.status, 1);
  EXPECT_NE(shown.out.find("Z: "), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("not replaced"), std::string::npos);
  EXPECT_EQ(text_of(golden() / "manifest.toml"), manifest);
  EXPECT_EQ(text_of(hill() / "ref" / "picture.exr"), exr);
  EXPECT_EQ(run({"update", "hill", "--accept"}).status, 0);
  EXPECT_NE(text_of(hill() / "ref" / "picture.exr"), exr);
  EXPECT_EQ(run({"check"}).status, 0);
}

TEST_F(Golden, TakesAPictureForASceneAndNoNameTwice) {
  ASSERT_EQ(run_plumb({"render", "generate:step?size=17", "--camera", "top", "--size", "20x20",
                       "-o", folder_.file("step.exr")})
                .status,
            0);
  EXPECT_EQ(run({"add", "step", folder_.file("step.exr"), "--why", "A step."}).status, 0);
  EXPECT_EQ(run({"check"}).status, 0);
  EXPECT_EQ(run({"add", "step", folder_.file("step.exr"), "--why", "Again."}).status, 2);
  EXPECT_EQ(run({"add", "steps", folder_.file("step.exr")}).status, 2);  // no reason given
  EXPECT_EQ(run({"check"}).status, 0);
}

// The house's own cases.
TEST(GoldenFolder, IsSmallAndSaysWhyEachCaseIsThere) {
  const fs::path folder = PLUMB_SOURCE_DIR "/tests/golden";
  std::uintmax_t bytes = 0;
  int cases = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
    if (entry.path().filename() != "why.md") continue;
    ++cases;
    const std::string why = text_of(entry.path());
    EXPECT_EQ(std::count(why.begin(), why.end(), '\n'), 3) << entry.path();
  }
  EXPECT_LT(bytes, 2'000'000u);
  EXPECT_GE(cases, 8);
}

}  // namespace
}  // namespace plumb::testing
