// plumb compare, as a person would run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "image/colour_image.h"
#include "image/image_files.h"
#include "support/run_command.h"

namespace plumb::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A hill of grey steps below a pale sky, with single pixels changed.
image::Rgb8Image hill(const std::vector<std::pair<int, int>>& white = {}, int width = 64) {
  image::Rgb8Image picture{width, 36, {}};
  for (int y = 0; y < 36; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool sky = y < 9;
      const auto shade = static_cast<std::uint8_t>(sky ? 200 : 60 + (x + 2 * y) % 7);
      for (int c = 0; c < 3; ++c) picture.rgb.push_back(shade);
    }
  }
  for (const auto& [x, y] : white) {
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgb[3 * static_cast<std::size_t>(y * width + x) + c] = 255;
  }
  return picture;
}

class CompareCommand : public ::testing::Test {
 protected:
  std::string picture(const std::string& name, const image::Rgb8Image& pixels = hill()) {
    const fs::path path = folder_.path() / name;
    fs::create_directories(path.parent_path());
    image::write_png(path, pixels);
    return path.string();
  }
  TemporaryFolder folder_;
};

TEST_F(CompareCommand, TellsEqualPicturesFromHarmedOnes) {
  const std::string a = picture("a.png"), b = picture("b.png", hill({{20, 20}}));
  const CommandResult equal = run_plumb({"compare", a, a});
  EXPECT_EQ(equal.status, 0) << equal.err;
  EXPECT_TRUE(equal.out.starts_with("EQUAL")) << equal.out;
  const CommandResult harmed = run_plumb({"compare", a, b});
  EXPECT_EQ(harmed.status, 1) << harmed.err;
  EXPECT_TRUE(harmed.out.starts_with("FAILS")) << harmed.out;
  EXPECT_NE(harmed.out.find("(20, 20)"), std::string::npos);
  EXPECT_NE(harmed.out.find("255 255 255"), std::string::npos);
}

TEST_F(CompareCommand, WritesAReportJsonAndJUnit) {
  const std::string a = picture("a.png"), b = picture("b.png", hill({{20, 20}}));
  const std::string report = folder_.file("report"), junit = folder_.file("junit.xml");
  const CommandResult result =
      run_plumb({"compare", a, b, "-o", report, "--junit", junit, "--json"});
  EXPECT_EQ(result.status, 1) << result.err;
  const json printed = json::parse(result.out);
  EXPECT_EQ(printed["schema"], "plumb.compare/1");
  EXPECT_EQ(printed["verdict"], "fails");
  EXPECT_NE(printed["command"].get<std::string>().find("plumb compare"), std::string::npos);
  EXPECT_EQ(json::parse(text_of(fs::path(report) / "comparison.json")), printed);
  EXPECT_NE(text_of(fs::path(report) / "index.html").find("</html>"), std::string::npos);
  EXPECT_NE(text_of(junit).find("<failure"), std::string::npos);
}

TEST_F(CompareCommand, GivesTheSameBytesOnAnyNumberOfThreads) {
  const std::string a = picture("a.png"), b = picture("b.png", hill({{20, 20}, {31, 12}}));
  const auto numbers = [&](const std::string& threads) {
    json printed = json::parse(run_plumb({"compare", a, b, "--json", "--threads", threads}).out);
    printed.erase("command");
    return printed.dump();
  };
  EXPECT_EQ(numbers("1"), numbers("3"));
}

TEST_F(CompareCommand, NothingIsJudgedUnderAMask) {
  image::Rgb8Image mask = hill();
  std::fill(mask.rgb.begin(), mask.rgb.end(), std::uint8_t{255});
  for (std::size_t c = 0; c < 3; ++c) mask.rgb[3 * (20 * 64 + 20) + c] = 0;
  const std::string a = picture("a.png"), b = picture("b.png", hill({{20, 20}}));
  const CommandResult masked =
      run_plumb({"compare", a, b, "--mask", picture("mask.png", mask), "--json"});
  EXPECT_EQ(masked.status, 0) << masked.err;
  EXPECT_EQ(json::parse(masked.out)["mask"]["would_fail"], 1);
  const CommandResult wrong =
      run_plumb({"compare", a, b, "--mask", picture("m.png", hill({}, 32))});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("32 x 36 pixels"), std::string::npos) << wrong.err;
  std::fill(mask.rgb.begin(), mask.rgb.end(), std::uint8_t{0});
  const CommandResult nothing = run_plumb({"compare", a, b, "--mask", picture("black.png", mask)});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_NE(nothing.err.find("black everywhere"), std::string::npos) << nothing.err;
}

// A link is the name that it has, wherever it leads; a report among the pictures is none of them.
TEST_F(CompareCommand, GoesByTheNamesOfLinksAndLeavesReportsOut) {
  picture("ref/a.png");
  picture("out/b.png");
  picture("elsewhere/c.png", hill({{5, 30}}));
  fs::create_symlink("../elsewhere/c.png", folder_.file("out/a.png"));
  fs::create_directory_symlink("../elsewhere", folder_.file("ref/deep"));
  fs::create_directory_symlink("../elsewhere", folder_.file("out/deep"));
  fs::create_directory_symlink("..", folder_.file("out/deep/up"));
  const std::string ref = folder_.file("ref"), out = folder_.file("out"),
                    report = folder_.file("out/report");
  for (int run = 0; run < 2; ++run) {
    const json printed = json::parse(run_plumb({"compare", ref, out, "--json", "-o", report}).out);
    ASSERT_EQ(printed["pairs"].size(), 2u);
    EXPECT_EQ(printed["pairs"][0]["name"], "a.png");
    EXPECT_EQ(printed["pairs"][1]["name"], "deep/c.png");
    EXPECT_EQ(printed["missing"].size(), 1u);
  }
}

TEST_F(CompareCommand, WritesJUnitOfWhatCannotBeComparedAndToStandardOutput) {
  const std::string a = picture("a.png"), xml = folder_.file("junit.xml");
  EXPECT_EQ(run_plumb({"compare", a, folder_.file("none.png"), "--junit", xml}).status, 2);
  EXPECT_NE(text_of(xml).find("<error"), std::string::npos) << text_of(xml);
  const CommandResult printed = run_plumb({"compare", a, a, "--junit", "-"});
  EXPECT_EQ(printed.status, 0);
  EXPECT_EQ(printed.out.rfind("<?xml", 0), 0u) << printed.out;
  EXPECT_EQ(run_plumb({"compare", a, a, "--junit", "-", "--json"}).status, 2);
}

TEST_F(CompareCommand, JudgesByAProfileOfOnesOwnAndByThoseOfOthers) {
  const std::string a = picture("a.png"), b = picture("b.png", hill({{20, 20}}));
  const std::string mine = folder_.file("mine.toml");
  std::ofstream(mine) << "[colour]\nlargest = 1\n";
  EXPECT_EQ(run_plumb({"compare", a, b, "--profile", mine}).status, 0);
  std::ofstream(mine) << "[colour]\nlargest = 0.5\n";
  EXPECT_EQ(run_plumb({"compare", a, b, "--profile", mine}).status, 1);
  EXPECT_EQ(run_plumb({"compare", a, b, "--profile", "exact"}).status, 1);
  EXPECT_EQ(run_plumb({"compare", a, b, "--profile", "anari-psnr"}).status, 0);
  std::ofstream(mine) << "[colour]\nlargst = 0.5\n";
  const CommandResult unknown = run_plumb({"compare", a, b, "--profile", mine});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("largst: unknown key"), std::string::npos) << unknown.err;
}

TEST_F(CompareCommand, ComparesFoldersFileByFile) {
  picture("ref/one.png");
  picture("out/one.png");
  picture("ref/deep/two.png");
  picture("out/deep/two.png", hill({{5, 30}}));
  const std::string ref = folder_.file("ref"), out = folder_.file("out");
  const CommandResult result = run_plumb({"compare", ref, out, "--json"});
  EXPECT_EQ(result.status, 1) << result.err;
  const json printed = json::parse(result.out);
  EXPECT_EQ(printed["schema"], "plumb.compare-folder/1");
  EXPECT_EQ(printed["pairs"].size(), 2u);
  const std::string report = folder_.file("report");
  EXPECT_EQ(run_plumb({"compare", ref, out, "-o", report}).status, 1);
  EXPECT_TRUE(fs::exists(fs::path(report) / "pairs/deep/two.png/index.html"));
}

TEST_F(CompareCommand, AFileThatOneFolderLacksIsAFailureByName) {
  picture("ref/one.png");
  picture("out/one.png");
  picture("ref/two.png");
  const CommandResult result = run_plumb({"compare", folder_.file("ref"), folder_.file("out")});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.out.find("two.png"), std::string::npos);
}

TEST_F(CompareCommand, ComparesAllPairsBeforeItEndsOnABadOne) {
  picture("ref/a.png", hill({}, 32));
  picture("out/a.png");
  std::ofstream(folder_.file("ref/b.png")) << "no picture";
  picture("out/b.png");
  picture("ref/c.png");
  picture("out/c.png", hill({{3, 33}}));
  const CommandResult result =
      run_plumb({"compare", folder_.file("ref"), folder_.file("out"), "--json"});
  EXPECT_EQ(result.status, 2);
  const json printed = json::parse(result.out);
  EXPECT_EQ(printed["errors"].size(), 2u);
  EXPECT_EQ(printed["pairs"].size(), 1u);
}

TEST_F(CompareCommand, SaysInOneLineWhatCannotBeCompared) {
  const std::string a = picture("a.png"), narrow = picture("narrow.png", hill({}, 32));
  const auto line = [](const CommandResult& result) {
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    return result.err;
  };
  EXPECT_NE(line(run_plumb({"compare", a, narrow})).find("64 x 36 pixels"), std::string::npos);
  EXPECT_NE(line(run_plumb({"compare", a})).find("needs a REFERENCE and a CANDIDATE"),
            std::string::npos);
  EXPECT_NE(line(run_plumb({"compare", a, folder_.path().string()})).find("is a folder"),
            std::string::npos);
  EXPECT_NE(line(run_plumb({"compare", a, "nothing.png"})).find("nothing.png"), std::string::npos);
  EXPECT_NE(line(run_plumb({"compare", a, a, "--profile", "strict"})).find("there are default"),
            std::string::npos);
  std::ofstream(folder_.file("cut.png"), std::ios::binary) << text_of(a).substr(0, 150);
  EXPECT_NE(line(run_plumb({"compare", a, folder_.file("cut.png")})).find("cut.png"),
            std::string::npos);
}

TEST_F(CompareCommand, CalibratesByPairsThatShouldPass) {
  image::Rgb8Image noisy = hill();
  for (std::size_t k = 0; k < noisy.rgb.size(); k += 5) ++noisy.rgb[k];
  const std::string a = picture("a.png"), b = picture("b.png", noisy);
  const std::string mine = folder_.file("mine.toml");
  const CommandResult result =
      run_plumb({"compare", "--calibrate", a, b, "--seeds", "2", "-o", mine, "--json"});
  EXPECT_LE(result.status, 1) << result.err;
  const json printed = json::parse(result.out);
  EXPECT_EQ(printed["schema"], "plumb.calibration/1");
  EXPECT_EQ(printed["profile_toml"], text_of(mine));
  EXPECT_EQ(run_plumb({"compare", a, b, "--profile", mine}).status, 0);
  EXPECT_EQ(run_plumb({"compare", a, picture("c.png", hill({{20, 20}})), "--profile", mine}).status,
            1);
  const CommandResult wrong =
      run_plumb({"compare", "--calibrate", a, b, "-o", folder_.file("mine.txt")});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_FALSE(fs::exists(folder_.file("mine.txt")));
}

// A profile that lets everything pass misses every defect, and is told so.
TEST_F(CompareCommand, TellsWhatAProfileCatchesAsItIs) {
  const std::string a = picture("a.png"), lax = folder_.file("lax.toml"),
                    planted = folder_.file("planted");
  std::ofstream(lax) << "systematic = false\n[colour]\nlargest = 1.0\n";
  const CommandResult result =
      run_plumb({"compare", "--detection", a, "--profile", lax, "--seeds", "1", "--json"});
  EXPECT_EQ(result.status, 1) << result.err;
  const json printed = json::parse(result.out);
  EXPECT_EQ(printed["schema"], "plumb.detection/1");
  for (const json& row : printed["detection"][0]["rows"]) {
    EXPECT_EQ(row["failed"], 0);
    EXPECT_EQ(row["wrong"].size(), row["as_wanted"] ? 0u : row["pictures"].get<std::size_t>());
  }
  const CommandResult shown =
      run_plumb({"compare", "--detection", a, "--seeds", "1", "-o", planted});
  EXPECT_LE(shown.status, 1) << shown.err;
  EXPECT_TRUE(fs::exists(fs::path(planted) / "index.html"));
  EXPECT_TRUE(fs::exists(fs::path(planted) / "pairs" / "crack-1px" / "index.html"));
  EXPECT_EQ(image::read_png(fs::path(planted) / "planted.png").width_px, 1104);
  EXPECT_EQ(run_plumb({"compare", "--detection", a, a}).status, 2);
  EXPECT_EQ(run_plumb({"compare", "--detection", "--calibrate"}).status, 2);
}

}  // namespace
}  // namespace plumb::testing
