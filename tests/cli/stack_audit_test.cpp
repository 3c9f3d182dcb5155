// plumb audit, truth, render and info of terrains of stacks, as a person would run them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

using nlohmann::json;

const std::string kCaves = "generate:caves?size=65";

CommandResult audit(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"audit", kCaves, "--size", "320x180"});
  return run_plumb(arguments);
}

CommandResult audit_published(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(),
                   {"--method", "stacks", "--variant", "published", "--tolerance", "200px"});
  return audit(std::move(arguments));
}

void expect_refused(const CommandResult& result, const std::string& words) {
  EXPECT_EQ(result.status, 2) << result.out;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
}

/// What was NaN or infinite is null; a number that is neither stands for what was measured.
void expect_finite(const json& value) {
  EXPECT_TRUE(!value.is_number_float() || std::isfinite(value.get<double>()));
  if (value.is_structured()) {
    for (const json& part : value) expect_finite(part);
  }
}

TEST(StackAudit, HoldsItsLimitOrBreaksItAsMeasured) {
  const CommandResult plain = audit_published({"--json"});
  EXPECT_EQ(plain.status, 0) << plain.err;
  const json result = json::parse(plain.out);
  expect_finite(result);
  const json& errors = result.at("errors");
  const double forward = errors.at("pixel_nearest_px").at("max"),
               reverse = errors.at("pixel_nearest_reverse_px").at("max"),
               most = std::max(forward, reverse);
  EXPECT_GT(most, 0.5);
  EXPECT_LT(most, 20.0);
  EXPECT_GT(errors.at("vertex_m").at("max"), 0.1);
  for (const char* of_heights : {"sample_m", "pixel_vertical_px", "between_samples"})
    EXPECT_TRUE(errors.at(of_heights).is_null()) << of_heights;
  EXPECT_TRUE(result.at("terrain").at("diagonal").is_null());
  EXPECT_EQ(result.at("topology").at("open_edges"), 0);
  EXPECT_EQ(result.at("coverage").at("holes"), 0);
  const auto limit = [](double px) { return "nearest-error=" + std::to_string(px) + "px"; };
  EXPECT_EQ(audit_published({"--limit", limit(1.01 * most)}).status, 0);
  const CommandResult broken = audit_published({"--limit", limit(0.99 * most)});
  EXPECT_EQ(broken.status, 1);
  EXPECT_NE(broken.out.find("Broken: nearest-error"), std::string::npos) << broken.out;
}

// In pixels: what is out of view may be coarser, and counts in metres.
TEST(StackAudit, FindsNoErrorInTheFinestLevel) {
  const TemporaryFolder folder;
  const CommandResult held =
      audit({"--method", "stacks", "--tolerance", "0px", "--limit", "nearest-error=0px", "--limit",
             "topology=0", "-o", folder.file("report")});
  EXPECT_EQ(held.status, 0) << held.out << held.err;
  EXPECT_NE(held.out.find("Every claim holds: 4"), std::string::npos) << held.out;
  EXPECT_EQ(held.out.find("vertical"), std::string::npos);
  for (const char* file : {"report.html", "nearest-error.png", "reverse-error.png", "summary.png"})
    EXPECT_TRUE(std::filesystem::exists(folder.file("report") + "/" + file)) << file;
  EXPECT_FALSE(std::filesystem::exists(folder.file("report") + "/pixel-error.png"));
}

// What render writes as a mesh is judged to the bit as what the method draws.
TEST(StackAudit, JudgesAMeshFromAFileAlike) {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("a.ply");
  ASSERT_EQ(
      run_plumb({"render", kCaves, "--method", "stacks", "--variant", "published", "--tolerance",
                 "200px", "--size", "320x180", "-o", folder.file("a.png"), "--mesh", mesh})
          .status,
      0);
  const json of_method = json::parse(audit_published({"--json"}).out);
  const CommandResult of_file = audit({"--mesh", mesh, "--tolerance", "200px", "--json"});
  EXPECT_EQ(of_file.status, 0) << of_file.err;
  const json result = json::parse(of_file.out);
  EXPECT_EQ(result.at("errors"), of_method.at("errors"));
  // The method's tolerance is a size: its silhouettes are judged as those of a mesh at a pixel.
  const json at_a_pixel = json::parse(audit({"--mesh", mesh, "--tolerance", "1px", "--json"}).out);
  EXPECT_EQ(at_a_pixel.at("coverage"), of_method.at("coverage"));
  EXPECT_EQ(result.at("claims").at(0).at("measure"), "nearest-error");
  EXPECT_EQ(audit({"--mesh", mesh, "--tolerance", "0.1m"}).status, 1);
}

TEST(StackAudit, RefusesWhatIsNotOfStacks) {
  const TemporaryFolder folder;
  const std::string depth = folder.file("d.exr");
  ASSERT_EQ(run_plumb({"truth", kCaves, "--size", "320x180", "-o", depth}).status, 0);
  expect_refused(audit({"--depth", depth}), "depth buffers are not audited yet");
  expect_refused(audit({}), "method restricted-quadtree draws heights");
  expect_refused(audit_published({"--diagonal", "fixed"}), "--diagonal");
  expect_refused(audit_published({"--limit", "pixel-error=1px"}), "nearest-error is");
  expect_refused(run_plumb({"truth", kCaves, "--witness"}), "Embree alone");
  expect_refused(run_plumb({"truth", kCaves, "--caster", "pyramid"}), "Embree alone");
}

// Of the two commands that cast at the truth.
TEST(StackTruth, IsTheSameOfTruthAndOfAScene) {
  const TemporaryFolder folder;
  const CommandResult cast =
      run_plumb({"truth", kCaves, "--size", "160x90", "-o", folder.file("t.png"), "--json"});
  ASSERT_EQ(cast.status, 0) << cast.err;
  EXPECT_EQ(json::parse(cast.out).at("caster"), "embree");
  std::ofstream(folder.file("s.toml"))
      << "[terrain]\nsource = \"" << kCaves
      << "\"\n[camera]\npreset = \"oblique\"\nwidth = 160\nheight = 90\n"
         "[render]\nwhat = \"truth\"\n";
  const CommandResult drawn =
      run_plumb({"render", folder.file("s.toml"), "-o", folder.file("s.png"), "--json"});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_EQ(json::parse(drawn.out).at("counters").at("pixels_with_terrain"),
            json::parse(cast.out).at("hits"));
  const auto bytes = [&](const char* file) {
    std::ifstream in(folder.file(file), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  EXPECT_EQ(bytes("t.png"), bytes("s.png"));
}

TEST(StackInfo, TellsWhatAGeneratedTerrainOfStacksIs) {
  const CommandResult result = run_plumb({"info", kCaves, "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  const json info = json::parse(result.out);
  EXPECT_EQ(info.at("schema"), "plumb.stacks/1");
  EXPECT_TRUE(info.at("file").is_null());
  EXPECT_EQ(info.at("terrain").at("columns"), 65);
  EXPECT_EQ(info.at("voxels"), 128);
  EXPECT_EQ(info.at("materials").size(), 5u);
  EXPECT_GT(info.at("memory_bytes"), 10'000);
  EXPECT_NE(run_plumb({"info", kCaves}).out.find("limestone"), std::string::npos);
}

// Heights as stacks, with voids: claims hold, coverage among them, out of reach or not; nothing is
// drawn over a void, nothing that exists is left out.
TEST(StackAudit, OfHeightsKeepsWhatItClaims) {
  for (const char* terrain :
       {"generate:alpine?size=65&voids=0.1", "generate:urban?size=49&voids=0.05",
        "generate:dunes?size=65&spacing=30"}) {
    for (const char* tolerance : {"1px", "16px"}) {
      for (const char* voxel : {"1", "10"}) {
        const CommandResult result =
            run_plumb({"audit", terrain, "--method", "stacks", "--tolerance", tolerance, "--set",
                       std::string("voxel=") + voxel, "--size", "160x90", "--json"});
        ASSERT_EQ(result.status, 0) << terrain << result.err;
        const json audit = json::parse(result.out);
        EXPECT_EQ(audit.at("verdict"), "held");
        EXPECT_EQ(audit.at("claims").size(), 3u);
        EXPECT_EQ(audit.at("claims")[0].at("measure"), "surface-error");
        EXPECT_EQ(audit.at("topology").at("open_edges"), 0);
        EXPECT_EQ(audit.at("samples").at("uncovered"), 0);
        EXPECT_EQ(audit.at("samples").at("drawn_over_void"), 0);
      }
    }
  }
}

}  // namespace
}  // namespace plumb::testing
