// plumb golden, as a person would run it; and that it finds what it is there to find.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "golden_folder.h"
#include "image/image_files.h"
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
  for (const char* file :
       {"actual.exr", "actual.png", "golden.exr", "difference.png", "index.html"})
    EXPECT_TRUE(fs::exists(folder_.path() / "found" / "hill" / file)) << file;
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
  EXPECT_EQ(checked().at("verdict"), "stale");
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
  EXPECT_FALSE(fs::exists(hill() / "ref" / "picture.exr"));  // nothing is made and passed
  EXPECT_EQ(run({"update", "hill"}).status, 1);
  EXPECT_FALSE(fs::exists(hill() / "ref" / "picture.exr"));
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
  EXPECT_NE(result.out.find("hill  same"), std::string::npos)
      << result.out;  // checked all the same
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

void expect_patch(const json& patch, const image::AovImage& picture, std::size_t pixel) {
  if (picture.id[pixel] < 0.0f) {
    EXPECT_TRUE(patch.is_null());
  } else {
    EXPECT_EQ(patch.at("id"), picture.id[pixel]);
    EXPECT_EQ(patch.at("lod"), picture.lod[pixel]);
  }
}

// The patch is the one that the picture's own channel has at the worst pixel.
TEST_F(Golden, SaysWhatToDoNext) {
  replace_in(hill() / "scene.toml", "1px", "3px");
  const CommandResult result = run({"check"});
  EXPECT_TRUE(contains(result.out, "worst pixel")) << result.out;
  EXPECT_TRUE(contains(result.out, "patch responsible: "));
  EXPECT_TRUE(contains(result.out, "golden:     " + (hill() / "ref/picture.exr").string()));
  EXPECT_TRUE(contains(result.out, "to see:     plumb golden check hill --folder "));
  EXPECT_TRUE(contains(result.out, "to accept:  plumb golden update hill --folder "));
  const json found = checked();
  ASSERT_EQ(run({"check", "-o", folder_.file("found")}).status, 1);
  const image::AovImage now = image::read_exr(folder_.path() / "found" / "hill" / "actual.exr");
  const image::AovImage before = image::read_exr(hill() / "ref" / "picture.exr");
  const json worst = found.at("comparison").at("worst");
  ASSERT_EQ(found.at("patches").size(), worst.size());
  for (std::size_t k = 0; k < worst.size(); ++k) {
    const json patch = found.at("patches").at(k), place = patch.at("pixel");
    EXPECT_EQ(worst.at(k).at("pixel"), place);
    const int pixel = place.at(1).get<int>() * now.width_px + place.at(0).get<int>();
    expect_patch(patch.at("golden"), before, static_cast<std::size_t>(pixel));
    expect_patch(patch.at("now"), now, static_cast<std::size_t>(pixel));
  }
  // The line that accepts is a shell's line, and works.
  const std::string accept = found.at("to_accept");
  EXPECT_EQ(run_command({"sh", "-c", "PATH=" PLUMB_BIN_DIR ":$PATH; " + accept}).status, 0);
  EXPECT_EQ(run({"check"}).status, 0);
}

// One bit of one number, planted in a copy of the reference.
TEST_F(Golden, FindsOneBit) {
  image::AovImage picture = image::read_exr(hill() / "ref" / "picture.exr");
  const std::size_t at = 20 * 48 + 7;
  picture.z[at] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(picture.z[at]) ^ 1u);
  fs::create_directories(folder_.path() / "out");
  image::write_exr(folder_.path() / "out" / "hill.exr", picture);
  const CommandResult result = run({"check", "--actual", folder_.file("out")});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.out, "  Z: 1 pixels, ")) << result.out;
  EXPECT_TRUE(contains(result.out, " at most, at (7, 20): "));
  EXPECT_TRUE(contains(result.out, "with 1 of the 1 pixels that differ"));
  EXPECT_EQ(run({"check"}).status, 0);  // what plumb draws is still the same
}

TEST_F(Golden, ListsItsCases) {
  const CommandResult table = run({"list"});
  EXPECT_EQ(table.status, 0);
  EXPECT_TRUE(contains(table.out, "hill  restricted-quadtree, 1px  none")) << table.out;
  const json listed = json::parse(run({"list", "--json"}).out).at("cases").at(0);
  EXPECT_EQ(listed.at("name"), "hill");
  EXPECT_EQ(listed.at("kind"), "scene");
  EXPECT_EQ(listed.at("why"), "A hill.");
  EXPECT_EQ(listed.at("checksum"), checked().at("expected"));
  replace_in(hill() / "scene.toml", "[method]", "[methods]");
  EXPECT_EQ(run({"list"}).status, 2);
}

// Never silently: an option that an action has no use for.
TEST_F(Golden, RefusesOptionsOfOtherActions) {
  EXPECT_EQ(run({"check", "--accept"}).status, 2);
  EXPECT_EQ(run({"check", "hill", "more"}).status, 2);
  EXPECT_EQ(run({"update", "hill", "--tolerance", "default"}).status, 2);
  EXPECT_EQ(run({"update"}).status, 2);
  EXPECT_EQ(run({"remove", "hill"}).status, 2);
  EXPECT_EQ(run({"check", "-o", (golden() / "report").string()}).status, 2);
  EXPECT_FALSE(fs::exists(golden() / "report"));
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

TEST_F(Golden, TakesATruthFromItsPicture) {
  ASSERT_EQ(run_plumb({"truth", "generate:alpine?size=33&voids=0.1", "--window", "2,3,25,28",
                       "--diagonal", "fixed", "--size", "40x30", "-o", folder_.file("truth.exr")})
                .status,
            0);
  EXPECT_EQ(run({"add", "truth", folder_.file("truth.exr"), "--why", "The truth."}).status, 0);
  EXPECT_EQ(run({"check"}).status, 0);
  EXPECT_EQ(text_of(golden() / "truth" / "ref" / "picture.exr"),
            text_of(folder_.file("truth.exr")));
}

// A picture whose header would draw something else is not taken for its scene.
TEST_F(Golden, RefusesAPictureThatItsSceneDoesNotDraw) {
  image::AovImage picture = image::read_exr(hill() / "ref" / "picture.exr");
  picture.r[0] += 0.5f;
  image::write_exr(folder_.path() / "other.exr", picture);
  const CommandResult result = run({"add", "other", folder_.file("other.exr"), "--why", "A."});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(contains(result.err, "--as-picture")) << result.err;
  EXPECT_EQ(run({"add", "other", folder_.file("other.exr"), "--why", "A.", "--as-picture"}).status,
            0);
  EXPECT_EQ(text_of(golden() / "other" / "ref" / "picture.exr"),
            text_of(folder_.file("other.exr")));
  EXPECT_FALSE(fs::exists(golden() / "other" / "scene.toml"));
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
