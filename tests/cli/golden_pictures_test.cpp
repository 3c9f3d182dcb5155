// plumb golden for another program's pictures: a manifest, and the folder that it writes into.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "golden_folder.h"
#include "image/image_files.h"
#include "support/run_command.h"

namespace plumb::testing {
namespace {

namespace fs = std::filesystem;
using image::Rgb8Image;
using nlohmann::json;

// A renderer's output folder with two pictures, and a manifest of them: "valley" within the default
// profile, "ridge" bit for bit.
class GoldenPictures : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const TemporaryFolder folder;
    ASSERT_EQ(run_plumb({"render", "generate:alpine?size=129&seed=4", "--size", "192x108", "-o",
                         folder.file("drawn.png")})
                  .status,
              0);
    drawn_ = image::read_png(folder.path() / "drawn.png");
  }
  void SetUp() override {
    fs::create_directories(out());
    image::write_png(out() / "valley.png", drawn_);
    image::write_png(out() / "ridge.png", mirrored(drawn_));
    ASSERT_EQ(add("valley", "default").status, 0);
    ASSERT_EQ(add("ridge", "none").status, 0);
  }
  CommandResult run(std::vector<std::string> arguments, bool with_actual = true) const {
    arguments.insert(arguments.begin(), "golden");
    arguments.insert(arguments.end(), {"--folder", golden().string()});
    if (with_actual) arguments.insert(arguments.end(), {"--actual", out().string()});
    return run_plumb(arguments);
  }
  CommandResult add(const std::string& name, const std::string& tolerance) const {
    return run({"add", name, (out() / (name + ".png")).string(), "--why", "It is seen from there.",
                "--tolerance", tolerance},
               false);
  }
  json checked() const { return json::parse(run({"check", "--json"}).out); }
  std::string verdict_of(const std::string& name) const {
    const json all = checked();
    for (const json& each : all.at("cases")) {
      if (each.at("name") == name) return each.at("verdict");
    }
    return "?";
  }
  fs::path golden() const { return folder_.path() / "golden"; }
  fs::path out() const { return folder_.path() / "out"; }

  inline static Rgb8Image drawn_;
  TemporaryFolder folder_;
};

TEST_F(GoldenPictures, AreTheSameAsLongAsNothingChanges) {
  const CommandResult result = run({"check"});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_TRUE(contains(result.out, "valley  same     default"));
  EXPECT_TRUE(contains(result.out, "ridge   same     none"));
  EXPECT_EQ(text_of(golden() / "ridge" / "ref" / "picture.png"), text_of(out() / "ridge.png"));
  const CommandResult list = run({"list"}, false);
  EXPECT_TRUE(contains(list.out, "valley  another program, picture.png  default")) << list.out;
  EXPECT_EQ(json::parse(run({"list", "--json"}, false).out).at("cases").at(0).at("kind"),
            "picture");
}

// The last bit of everything: within the tolerance, and said; not for a case without one.
TEST_F(GoldenPictures, PassWithinTheirTolerance) {
  image::write_png(out() / "valley.png", noisy(drawn_));
  const CommandResult result = run({"check"});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_TRUE(contains(result.out, "valley  within tolerance  default")) << result.out;
  EXPECT_TRUE(contains(result.out, "profile 'default': PASSES: "));
  EXPECT_EQ(verdict_of("valley"), "within tolerance");
  replace_in(golden() / "manifest.toml", "\"default\"", "\"none\"");
  EXPECT_EQ(run({"check"}).status, 1);
  EXPECT_EQ(verdict_of("valley"), "differs");
}

TEST_F(GoldenPictures, FailForACrackAndNameItsPixelWithBothValues) {
  image::write_png(out() / "valley.png", cracked(drawn_));
  const CommandResult result = run({"check", "-o", folder_.file("found")});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.out, "valley  differs")) << result.out;
  EXPECT_TRUE(contains(result.out, "ridge   same"));
  EXPECT_TRUE(contains(result.out, "profile 'default': FAILS: "));
  for (const char* file : {"actual.png", "golden.png", "difference.png", "index.html"}) {
    const fs::path written = folder_.path() / "found" / "valley" / file;
    EXPECT_TRUE(fs::exists(written)) << file;
    EXPECT_TRUE(contains(result.out, written.string())) << file;
  }
  EXPECT_EQ(text_of(folder_.path() / "found" / "valley" / "actual.png"),
            text_of(out() / "valley.png"));
  EXPECT_FALSE(fs::exists(folder_.path() / "found" / "ridge"));
  const json found = checked().at("cases").at(0);
  const json worst = found.at("comparison").at("worst").at(0);
  EXPECT_EQ(worst.at("pixel").at(0), 90);
  const int y = worst.at("pixel").at(1);
  EXPECT_TRUE(y >= 60 && y < 100) << y;
  const auto values = [](Rgb8Image& image, int x, int at) {
    return std::to_string(channel(image, x, at, 0)) + " " +
           std::to_string(channel(image, x, at, 1)) + " " +
           std::to_string(channel(image, x, at, 2));
  };
  EXPECT_EQ(worst.at("reference"), values(drawn_, 90, y));
  EXPECT_EQ(worst.at("candidate"), values(drawn_, 0, 0));
  EXPECT_TRUE(contains(result.out, values(drawn_, 90, y) + "  " + values(drawn_, 0, 0)));
}

TEST_F(GoldenPictures, AreJudgedByAProfileBesideTheManifest) {
  write(golden() / "loose.toml", "[colour]\nlargest = 1.0\n");
  EXPECT_EQ(run({"check"}).status, 2);  // nothing names it yet
  replace_in(golden() / "manifest.toml", "\"default\"", "\"loose.toml\"");
  image::write_png(out() / "valley.png", cracked(drawn_));
  EXPECT_EQ(run({"check"}).status, 0);
  write(golden() / "loose.toml", "[colour]\nlargest = 0.01\n");
  EXPECT_EQ(run({"check"}).status, 1);
  write(golden() / "loose.toml", "[colour]\nlargst = 0.01\n");
  EXPECT_EQ(run({"check"}).status, 2);
  replace_in(golden() / "manifest.toml", "\"loose.toml\"", "\"losse\"");
  fs::remove(golden() / "loose.toml");
  image::write_png(out() / "valley.png", drawn_);
  const CommandResult result = run({"check"});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(contains(result.err, "there is no profile 'losse'")) << result.err;
}

// A profile that says nothing about colours has no verdict of them.
TEST_F(GoldenPictures, HaveNoVerdictWhereTheToleranceHasNoLimit) {
  write(golden() / "deep.toml", "systematic = false\nnumbers = false\n[depth]\nlargest = 1.0\n");
  replace_in(golden() / "manifest.toml", "\"default\"", "\"deep.toml\"");
  image::write_png(out() / "valley.png", noisy(drawn_));
  EXPECT_EQ(run({"check"}).status, 2);
  EXPECT_EQ(verdict_of("valley"), "failed");
}

TEST_F(GoldenPictures, AreMissedByName) {
  fs::remove(out() / "valley.png");
  const CommandResult result = run({"check"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.out, "valley  missing")) << result.out;
  EXPECT_TRUE(contains(result.out, "ridge   same"));
  EXPECT_TRUE(contains(result.out, "there is no picture of it in " + out().string() +
                                       ": let the program that draws it write " +
                                       (out() / "valley.png").string() + " (or another format)"))
      << result.out;
  EXPECT_TRUE(
      contains(result.out, "take the case out of " + (golden() / "manifest.toml").string()));
  EXPECT_FALSE(contains(result.out, "--accept"));  // there is nothing to accept
  EXPECT_EQ(run({"update", "valley", "--accept"}).status, 2);
  image::write_png(out() / "valley.png", drawn_);
  fs::remove(golden() / "valley" / "ref" / "picture.png");
  EXPECT_EQ(run({"check"}).status, 1);
  EXPECT_EQ(verdict_of("valley"), "missing");
  EXPECT_FALSE(fs::exists(golden() / "valley" / "ref" / "picture.png"));
}

TEST_F(GoldenPictures, ThatNoCaseNamesAreErrorsAfterAllElse) {
  fs::create_directories(out() / "more");
  image::write_png(out() / "extra.png", drawn_);
  image::write_png(out() / "more" / "valley.png", drawn_);
  write(out() / "log.txt", "no picture");
  image::write_png(out() / "ridge.png", drawn_);
  const CommandResult result = run({"check", "--junit", folder_.file("junit.xml")});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(contains(result.out, "ridge   differs")) << result.out;
  EXPECT_TRUE(contains(result.err, "no case names " + (out() / "extra.png").string() + ", " +
                                       (out() / "more" / "valley.png").string()))
      << result.err;
  EXPECT_FALSE(contains(result.err, "log.txt"));
  EXPECT_EQ(checked().at("strays").size(), 2u);
  const std::string junit = text_of(folder_.path() / "junit.xml");
  EXPECT_TRUE(contains(junit, "tests=\"4\" failures=\"1\" errors=\"2\"")) << junit;
  EXPECT_TRUE(contains(junit, "worst pixel"));
}

TEST_F(GoldenPictures, AreOneFileEach) {
  fs::copy_file(out() / "valley.png", out() / "valley.PNG");
  const CommandResult result = run({"check"});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(contains(result.err, "more than one picture of the case: valley.PNG, valley.png"))
      << result.err;
  EXPECT_TRUE(contains(result.out, "ridge   same")) << result.out;
}

TEST_F(GoldenPictures, ThatCannotBeReadAreErrorsAndThoseOfAnotherSizeDiffer) {
  write(out() / "valley.png", text_of(out() / "valley.png").substr(0, 400));
  EXPECT_EQ(run({"check"}).status, 2);
  EXPECT_EQ(verdict_of("valley"), "failed");
  EXPECT_EQ(verdict_of("ridge"), "same");
  Rgb8Image shorter = drawn_;
  shorter.height_px -= 1;
  shorter.rgb.resize(static_cast<std::size_t>(shorter.width_px) * shorter.height_px * 3);
  image::write_png(out() / "valley.png", shorter);
  const CommandResult result = run({"check", "-o", folder_.file("found")});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.out, "192 x 107")) << result.out;
  EXPECT_TRUE(fs::exists(folder_.path() / "found" / "valley" / "actual.png"));
}

TEST_F(GoldenPictures, NeedTheirFolder) {
  const CommandResult result = run({"check"}, false);
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(contains(result.err, "--actual")) << result.err;
  EXPECT_EQ(run_plumb({"golden", "check", "--folder", golden().string(), "--actual",
                       folder_.file("nowhere")})
                .status,
            2);
  EXPECT_EQ(run({"check", "-o", (out() / "report").string()}).status, 2);
}

// The reference's file changed by hand, though the picture is what the manifest says.
TEST_F(GoldenPictures, AreNotHeldAgainstAReferenceThatIsNotTheManifests) {
  image::write_png(golden() / "valley" / "ref" / "picture.png", noisy(drawn_));
  EXPECT_EQ(run({"check"}).status, 1);
  EXPECT_EQ(verdict_of("valley"), "stale");
}

TEST_F(GoldenPictures, AreReplacedOnlyWhenThatIsAccepted) {
  image::write_png(out() / "valley.png", cracked(drawn_));
  const std::string manifest = text_of(golden() / "manifest.toml");
  const std::string before = text_of(golden() / "valley" / "ref" / "picture.png");
  const CommandResult shown = run({"update", "valley", "-o", folder_.file("found")});
  EXPECT_EQ(shown.status, 1);
  EXPECT_TRUE(contains(shown.out, "limit of 'default'")) << shown.out;  // the whole comparison
  EXPECT_TRUE(contains(shown.out, "not replaced"));
  EXPECT_TRUE(fs::exists(folder_.path() / "found" / "valley" / "index.html"));
  EXPECT_EQ(text_of(golden() / "manifest.toml"), manifest);
  EXPECT_EQ(text_of(golden() / "valley" / "ref" / "picture.png"), before);
  ASSERT_EQ(run({"update", "valley", "--accept"}).status, 0);
  EXPECT_EQ(text_of(golden() / "valley" / "ref" / "picture.png"), text_of(out() / "valley.png"));
  EXPECT_EQ(run({"check"}).status, 0);
  EXPECT_EQ(verdict_of("valley"), "same");
}

// The same numbers in another format are the same picture; others replace the file of the old one.
TEST_F(GoldenPictures, MayComeInAnotherFormat) {
  fs::remove(out() / "valley.png");
  image::write_png(out() / "valley.png", drawn_);
  ASSERT_EQ(run_plumb({"render", "generate:step?size=17", "--camera", "top", "--size", "20x20",
                       "-o", (out() / "ridge.exr").string()})
                .status,
            0);
  fs::remove(out() / "ridge.png");
  EXPECT_EQ(run({"check"}).status, 1);
  ASSERT_EQ(run({"update", "ridge", "--accept"}).status, 0);
  EXPECT_FALSE(fs::exists(golden() / "ridge" / "ref" / "picture.png"));
  EXPECT_TRUE(fs::exists(golden() / "ridge" / "ref" / "picture.exr"));
  EXPECT_EQ(run({"check"}).status, 0);
}

TEST_F(GoldenPictures, AreAddedOnceAndWithAToleranceThatExists) {
  EXPECT_EQ(add("valley", "default").status, 2);
  image::write_png(out() / "third.png", drawn_);
  EXPECT_EQ(add("third", "nobody").status, 2);
  EXPECT_FALSE(fs::exists(golden() / "third"));
  EXPECT_EQ(run({"add", "third", folder_.file("none.png"), "--why", "A."}, false).status, 2);
  EXPECT_EQ(add("third", "exact").status, 0);
  EXPECT_EQ(run({"check"}).status, 0);
}

// One manifest holds both kinds: what the folder has is taken from there, the rest plumb draws.
TEST_F(GoldenPictures, StandBesideScenes) {
  const auto render = [](const std::string& tolerance, const std::string& file) {
    return run_plumb({"render", "generate:alpine?size=33&seed=2", "--size", "48x27", "--tolerance",
                      tolerance, "-o", file})
        .status;
  };
  ASSERT_EQ(render("1px", folder_.file("hill.exr")), 0);
  ASSERT_EQ(run({"add", "hill", folder_.file("hill.exr"), "--why", "A hill."}, false).status, 0);
  EXPECT_EQ(run({"check"}).status, 0);
  ASSERT_EQ(render("3px", (out() / "hill.exr").string()), 0);
  const CommandResult result = run({"check"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.out, "patch responsible: ")) << result.out;
  ASSERT_EQ(run({"update", "hill", "--accept"}).status, 0);
  EXPECT_EQ(text_of(golden() / "hill" / "ref" / "picture.exr"), text_of(out() / "hill.exr"));
  EXPECT_EQ(run({"check"}).status, 0);
  fs::remove(out() / "hill.exr");
  EXPECT_EQ(run({"check"}).status, 1);  // the scene still says 1px
  image::write_png(out() / "hill.png", drawn_);
  EXPECT_EQ(run({"check"}).status, 1);
  EXPECT_EQ(run({"update", "hill", "--accept"}).status, 2);  // no picture with plumb's channels
}

}  // namespace
}  // namespace plumb::testing
