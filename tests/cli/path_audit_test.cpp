// Paths through the command: popping, flicker, their limit, and the page of a path.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

using nlohmann::json;

const std::vector<std::string> kZoom{"audit",
                                     "generate:alpine?size=65",
                                     "--method",
                                     "restricted-quadtree",
                                     "--tolerance",
                                     "4px",
                                     "--size",
                                     "160x90",
                                     "--camera",
                                     "zoom",
                                     "--frames",
                                     "4",
                                     "--without-nearest"};

std::vector<std::string> with(std::vector<std::string> arguments,
                              const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(PathAudit, HasPoppingAndFlickerOfEveryFrame) {
  const CommandResult result = run_plumb(with(kZoom, {"--json"}));
  EXPECT_EQ(result.status, 0) << result.err;
  const json path = json::parse(result.out);
  EXPECT_EQ(path.at("schema"), "plumb.audit-path/1");
  const json& frames = path.at("frames");
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_TRUE(frames[0].at("popping").is_null());
  EXPECT_TRUE(frames[0].at("flicker").is_null());
  EXPECT_TRUE(frames[1].at("flicker").is_null());
  double largest = 0.0;
  for (int k = 1; k < 4; ++k) {
    const json& popping = frames[k].at("popping");
    EXPECT_GT(popping.at("pixels"), 5000) << k;
    largest = std::max(largest, popping.at("max_px").get<double>());
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LE(largest, 2.0 * 4.0 * 1.5);  // twice the tolerance, each frame a quarter nearer at most
  EXPECT_GE(frames[2].at("flicker").at("compared"), 5000);
}

TEST(PathAudit, TellsInATableWhatPops) {
  const CommandResult result = run_plumb(kZoom);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("popping, px"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("flickering pixels"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("Popping at most"), std::string::npos) << result.out;
}

TEST(PathAudit, JudgesALimitOfPopping) {
  EXPECT_EQ(run_plumb(with(kZoom, {"--limit", "popping=12px"})).status, 0);
  const CommandResult broken = run_plumb(with(kZoom, {"--limit", "popping=0px", "--json"}));
  EXPECT_EQ(broken.status, 1) << broken.err;
  const json frames = json::parse(broken.out).at("frames");
  const auto verdict_of = [](const json& frame) {
    for (const json& claim : frame.at("claims")) {
      if (claim.at("measure") == "popping") return claim.at("verdict").get<std::string>();
    }
    return std::string("no such claim");
  };
  EXPECT_EQ(verdict_of(frames[0]), "not measured");
  EXPECT_EQ(frames[0].at("verdict"), "held");
  EXPECT_EQ(verdict_of(frames[3]), "broken");
  EXPECT_EQ(frames[3].at("offenders").at(0).at("breaks"), "popping");
}

TEST(PathAudit, RefusesALimitOfPoppingForOneFrame) {
  for (const char* camera : {"oblique", "zoom"}) {
    std::vector<std::string> arguments{
        "audit", "generate:alpine?size=65", "--camera", camera, "--limit", "popping=1px"};
    if (std::string(camera) == "zoom") arguments.insert(arguments.end(), {"--frame", "2"});
    const CommandResult result = run_plumb(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("between the frames of a path, and this is one frame"),
              std::string::npos)
        << result.err;
  }
}

TEST(PathAudit, NeedsAPathForItsFrames) {
  const CommandResult result =
      run_plumb({"audit", "generate:alpine?size=65", "--camera", "top", "--frames", "3"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("flyover and zoom, not with 'top'"), std::string::npos) << result.err;
  const CommandResult one = run_plumb({"truth", "generate:alpine?size=65", "--camera", "flyover"});
  EXPECT_EQ(one.status, 2);
  EXPECT_NE(one.err.find("path of 60 cameras"), std::string::npos) << one.err;
}

TEST(PathAudit, WritesAPageThatLeadsToItsFrames) {
  const TemporaryFolder folder;
  const CommandResult result = run_plumb(with(kZoom, {"-o", folder.file("out")}));
  EXPECT_EQ(result.status, 0) << result.err;
  const auto text_of = [&](const char* name) {
    std::ifstream in(folder.path() / "out" / name, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string page = text_of("report.html");
  EXPECT_NE(page.find("data:image/svg+xml"), std::string::npos);
  for (int k = 1; k <= 4; ++k) {
    const std::string own = "frame_000" + std::to_string(k) + "/report.html";
    EXPECT_NE(page.find("href=\"" + own + "\""), std::string::npos) << own;
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / own)) << own;
  }
  EXPECT_NE(text_of("path.svg").find("largest popping, px"), std::string::npos);
  EXPECT_EQ(json::parse(text_of("audit.json")).at("frames").size(), 4u);
}

// Far above caves, then near, and there the camera stays. Without a budget the second frame has all
// that the camera asks for. With one of 40 node meshes it lags behind, is refined frame by frame
// under a camera that does not move, and comes to the same surface.
TEST(PathAudit, ShowsABudgetThatLagsBehindAndCatchesUp) {
  const TemporaryFolder folder;
  std::ofstream file(folder.file("fly.toml"));
  for (int k = 0; k < 8; ++k)
    file << "[[camera]]\neye = [128, -60, " << (k == 0 ? 9000 : 200)
         << "]\ntarget = [128, 128, 60]\nwidth = 120\nheight = 68\n";
  file.close();
  const auto frames = [&](const char* budget) {
    const CommandResult result =
        run_plumb({"audit", "generate:caves?size=65&spacing=4", "--method", "stacks", "--variant",
                   "published", "--tolerance", "2px", "--camera", folder.file("fly.toml"), "--set",
                   std::string("budget=") + budget, "--json"});
    return json::parse(result.out).at("frames");
  };
  const auto error = [](const json& frame) {
    return frame.at("errors").at("pixel_nearest_reverse_px").at("max").get<double>();
  };
  const auto popped = [](const json& frame) {
    return frame.at("popping").at("max_px").get<double>();
  };
  const json all = frames("0"), slow = frames("40");
  EXPECT_GT(popped(all[1]), 1.0);
  for (std::size_t k = 2; k < all.size(); ++k) EXPECT_EQ(popped(all[k]), 0.0) << k;
  EXPECT_LT(error(all[1]), 1.0);
  EXPECT_GT(error(slow[1]), 2.0);
  for (const std::size_t late : {2, 3}) EXPECT_GT(popped(slow[late]), 1.0) << late;
  EXPECT_EQ(error(slow.back()), error(all.back()));
  EXPECT_EQ(slow.back().at("cost").at("triangles"), all.back().at("cost").at("triangles"));
}

// Most nodes over caves have no surface: a budget is not spent on them, so that what is drawn moves
// on with the camera, and in the end comes near to what it asks for.
TEST(PathAudit, SpendsABudgetOnMeshesAlone) {
  const auto triangles = [](const char* budget) {
    const CommandResult result = run_plumb(
        {"audit", "generate:caves?size=129", "--method", "stacks", "--variant", "published",
         "--tolerance", "160px", "--camera", "flyover", "--frames", "8", "--size", "160x90",
         "--without-nearest", "--set", std::string("budget=") + budget, "--json"});
    std::vector<double> counts;
    const json audit = json::parse(result.out);
    for (const json& frame : audit.at("frames"))
      counts.push_back(frame.at("cost").at("triangles").get<double>());
    return counts;
  };
  const std::vector<double> all = triangles("0"), slow = triangles("40");
  ASSERT_EQ(slow.size(), 8u);
  EXPECT_EQ(slow[0], all[0]);
  EXPECT_LT(slow[1], 0.7 * all[1]);
  int changed = 0;
  for (std::size_t k = 1; k < 8; ++k) changed += slow[k] != slow[k - 1] ? 1 : 0;
  EXPECT_GE(changed, 5);
  EXPECT_GT(slow[7], 0.75 * all[7]);
}

}  // namespace
}  // namespace plumb::testing
