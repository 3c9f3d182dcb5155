// plumb audit --depth: depth buffers of other renderers, right and wrong.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "image/image_files.h"
#include "support/run_command.h"

namespace plumb::testing {
namespace {

using nlohmann::json;

const std::string kTerrain = "generate:alpine?size=65&seed=3";
const std::vector<std::string> kFrame{"--size", "161x91", "--camera", "oblique"};

CommandResult run_with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), kFrame.begin(), kFrame.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_plumb(arguments);
}

CommandResult audit(const std::string& file, const std::vector<std::string>& options = {},
                    const std::string& terrain = kTerrain) {
  std::vector<std::string> more{"--depth", file};
  more.insert(more.end(), options.begin(), options.end());
  return run_with({"audit", terrain}, more);
}

// What the command says itself: a step that takes long is named on a line of its own before it.
std::size_t lines_of_its_own(const std::string& err) {
  std::size_t lines = 0;
  for (std::size_t at = 0; (at = err.find("plumb: ", at)) != std::string::npos; ++at)
    lines += at == 0 || err[at - 1] == '\n' ? 1 : 0;
  return lines;
}

void expect_one_line(const CommandResult& result, const std::string& words) {
  EXPECT_EQ(result.status, 2) << result.out;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(lines_of_its_own(result.err), 1U) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
}

class DepthAudit : public ::testing::Test {
 protected:
  // The frame that a method draws.
  std::string drawn(const std::string& tolerance = "2px") {
    const std::string file = folder_.file("depth" + tolerance + ".exr");
    const CommandResult result =
        run_with({"render", kTerrain}, {"--tolerance", tolerance, "-o", file});
    EXPECT_EQ(result.status, 0) << result.err;
    return file;
  }

  // Its depths, changed number by number, as raw singles.
  std::string raw(const std::function<float(float)>& change, bool big = false) {
    const std::string file = folder_.file("depth.raw");
    std::ofstream out(file, std::ios::binary);
    for (const float value : image::read_exr(drawn()).z) {
      const auto word = std::bit_cast<std::uint32_t>(change(value));
      for (int b = 0; b < 4; ++b) out.put(static_cast<char>(word >> (8 * (big ? 3 - b : b))));
    }
    return file;
  }

  TemporaryFolder folder_;
};

// What it drew within a tolerance keeps to it when it is read back; and not to a tenth.
TEST_F(DepthAudit, JudgesAFrameByTheTolerance) {
  const std::string file = drawn();
  const CommandResult held = audit(file, {"--tolerance", "2px", "--json"});
  EXPECT_EQ(held.status, 0) << held.out << held.err;
  const json result = json::parse(held.out);
  EXPECT_EQ(result.at("verdict"), "held");
  EXPECT_EQ(result.at("claims").size(), 2u);
  EXPECT_EQ(result.at("claims").at(0).at("measure"), "pixel-error");
  EXPECT_EQ(result.at("claims").at(0).at("claimed"), 2.0);
  EXPECT_EQ(result.at("method").at("name"), "depth " + file);
  EXPECT_EQ(result.at("method").at("parameters").at("convention"), "linear");
  EXPECT_EQ(result.at("coverage").at("set_aside"), 0);
  EXPECT_TRUE(result.at("topology").is_null());
  const CommandResult broken = audit(file, {"--tolerance", "0.2px"});
  EXPECT_EQ(broken.status, 1) << broken.err;
  EXPECT_NE(broken.out.find("Broken: pixel-error"), std::string::npos) << broken.out;
}

TEST_F(DepthAudit, JudgesMetresToo) {
  const std::string file = drawn("5m");
  EXPECT_EQ(audit(file, {"--tolerance", "5m"}).status, 0);
  const CommandResult broken = audit(file, {"--tolerance", "0.1m", "--json"});
  EXPECT_EQ(broken.status, 1);
  EXPECT_EQ(json::parse(broken.out).at("claims").at(0).at("unit"), "m");
}

TEST_F(DepthAudit, FindsNoErrorInTheTruthAndTellsWhatItCannotTell) {
  const std::string file = folder_.file("truth.exr");
  ASSERT_EQ(run_with({"truth", kTerrain}, {"-o", file}).status, 0);
  const CommandResult result = audit(file, {"--tolerance", "0px", "-o", folder_.file("report")});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("a depth buffer has no triangles"), std::string::npos);
  EXPECT_NE(result.out.find("assumed: the depth buffer holds floats of 24 binary digits"),
            std::string::npos)
      << result.out;
  std::ifstream page(folder_.file("report/report.html"));
  const std::string html{std::istreambuf_iterator<char>(page), {}};
  EXPECT_NE(html.find("a depth buffer has no triangles"), std::string::npos);
}

// n = 2, f = infinity: 1 - 2/w.
TEST_F(DepthAudit, ReadsWindowDepthThroughTheCamerasPlanes) {
  const std::string camera = folder_.file("camera.toml");
  std::ofstream(camera) << "preset = \"oblique\"\nnear = 2\n";
  const std::string file = raw([](float w) { return std::isinf(w) ? 1.0f : 1.0f - 2.0f / w; });
  for (const char* name : {"window", "opengl", "d3d", "vulkan"}) {
    const CommandResult result =
        run_plumb({"audit", kTerrain, "--size", "161x91", "--camera", camera, "--depth", file,
                   "--depth-raw", "little", "--depth-convention", name, "--tolerance", "2px"});
    EXPECT_EQ(result.status, 0) << name << result.out << result.err;
  }
  expect_one_line(run_plumb({"audit", kTerrain, "--size", "161x91", "--camera", camera, "--depth",
                             file, "--depth-raw", "little"}),
                  "its numbers are window depths, 0 near and 1 far (--depth-convention window)");
}

TEST_F(DepthAudit, TakesUnitsSkyOrderAndTheWayOfRows) {
  const std::string feet = raw([](float w) { return std::isinf(w) ? -1.0f : w / 0.3048f; }, true);
  const std::vector<std::string> how{"--depth-raw", "big", "--depth-scale", "0.3048",
                                     "--depth-sky", "-1",  "--tolerance",   "2.1px"};
  EXPECT_EQ(audit(feet, how).status, 0) << audit(feet, how).out << audit(feet, how).err;
  std::vector<std::string> up = how;
  up.insert(up.end(), {"--depth-y", "up"});
  expect_one_line(audit(feet, up), "rows run from the top down (--depth-y down)");
}

TEST_F(DepthAudit, NamesWhatDoesNotFitBeforeAnyError) {
  const std::string file = drawn();
  expect_one_line(audit(file, {"--depth-convention", "distance"}), "--depth-convention linear");
  expect_one_line(audit(file, {"--depth-y", "up"}), "--depth-y down");
  const std::string other = "generate:alpine?size=65&seed=4";
  expect_one_line(audit(file, {}, other), "another terrain");
  // Unless somebody knows better.
  const CommandResult trusted = audit(file, {"--trust"}, other);
  EXPECT_EQ(trusted.status, 1);
  EXPECT_NE(trusted.err.find("another terrain"), std::string::npos);
  EXPECT_NE(trusted.out.find("Broken: pixel-error"), std::string::npos) << trusted.out;
  expect_one_line(run_with({"audit", kTerrain}, {"--trust"}), "--trust belongs to --mesh or");
  expect_one_line(audit(file, {"--depth-convention", "distance", "--json"}),
                  "--depth-convention linear");
  expect_one_line(audit(file, {"--depth-convention", "distance", "-o", folder_.file("report")}),
                  "--depth-convention linear");
  EXPECT_FALSE(std::filesystem::exists(folder_.file("report")));
}

TEST_F(DepthAudit, RefusesNumbersThatAreNone) {
  int k = 0;
  const std::string nan = raw([&](float w) {
    return ++k == 163 || k == 200 ? std::numeric_limits<float>::quiet_NaN() : w;
  });
  expect_one_line(audit(nan, {"--depth-raw", "little"}),
                  "2 of its 14651 numbers are NaN, the first in column 1 of row 1");
  k = 0;
  const std::string negative = raw([&](float w) { return ++k == 163 ? -3.0f : w; });
  expect_one_line(
      audit(negative, {"--depth-raw", "little", "--tolerance", "2px"}),
      "1 of its numbers are no depth of convention linear, the first -3 at pixel (1, 1)");
}

TEST_F(DepthAudit, RefusesFilesAndOptionsInOneLine) {
  const std::string file = drawn(), text = folder_.file("text.exr");
  std::ofstream(text) << "no picture";
  std::ofstream(folder_.file("camera.toml"))
      << "[[camera]]\npreset = \"oblique\"\n[[camera]]\npreset = \"top\"\n";
  expect_one_line(run_plumb({"audit", kTerrain, "--size", "160x90", "--depth", file}),
                  "the buffer has 161 x 91 pixels, the camera 160 x 90");
  expect_one_line(audit(text), "text.exr");
  expect_one_line(audit(folder_.file("none.exr")), "none.exr");
  expect_one_line(audit(file, {"--depth-channel", "depth"}), "it has R, G, B, Z");
  expect_one_line(audit(file, {"--depth-raw", "little"}), "161 x 91 floats are 58604 bytes");
  expect_one_line(audit(file, {"--mesh", "a.ply"}), "--mesh and --depth");
  expect_one_line(audit(file, {"--method", "full"}), "--method: nothing is drawn by a method");
  expect_one_line(audit(file, {"--up", "y"}), "--up belongs to --mesh");
  expect_one_line(audit(file, {"--depth-convention", "w-buffer"}), "linear");
  expect_one_line(audit(file, {"--depth-scale", "-1"}), "its numbers are positive depths");
  expect_one_line(audit(file, {"--depth-scale", "0"}), "--depth-scale 0: expected a number, not");
  expect_one_line(audit(file, {"--depth-bits", "12"}), "--depth-bits 12: expected 16, 24 or 32");
  expect_one_line(audit(file, {"--depth-scale", "2", "--depth-convention", "d3d"}),
                  "--depth-scale is of --depth-convention linear and distance");
  const std::vector<std::string> path{"audit",   kTerrain,   "--size",
                                      "161x91",  "--camera", folder_.file("camera.toml"),
                                      "--depth", file};
  expect_one_line(run_plumb(path), "has 2 cameras");
  std::vector<std::string> first = path;
  first.insert(first.end(), {"--frame", "1", "--tolerance", "2px"});
  EXPECT_EQ(run_plumb(first).status, 0);
  expect_one_line(audit(file, {"--limit", "sample-error=1m"}), "only of a mesh");
  for (const char* option : {"--depth-convention=d3d", "--depth-y=up", "--depth-sky=0",
                             "--depth-bits=16", "--depth-raw=big", "--depth-channel=Z"})
    expect_one_line(run_with({"audit", kTerrain}, {option}), "belongs to --depth");
  expect_one_line(run_with({"audit", kTerrain}, {"--scale", "2"}), "belongs to --mesh");
}

}  // namespace
}  // namespace plumb::testing
