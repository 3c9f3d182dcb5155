// plumb audit and plumb truth, as a person would run them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

using nlohmann::json;

const std::vector<std::string> kSmall{"generate:alpine?size=65&seed=3", "--size", "160x90"};

std::vector<std::string> with(std::vector<std::string> front,
                              const std::vector<std::string>& back) {
  front.insert(front.end(), kSmall.begin(), kSmall.end());
  front.insert(front.end(), back.begin(), back.end());
  return front;
}

TEST(AuditCommand, HoldsForAMethodThatKeepsItsPromise) {
  for (const char* method : {"full", "restricted-quadtree"}) {
    const CommandResult result =
        run_plumb(with({"audit"}, {"--method", method, "--tolerance", "1px"}));
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("Every claim holds"), std::string::npos) << result.out;
  }
}

TEST(AuditCommand, JudgesSlicesByWhatAPictureHas) {
  for (const char* method : {"slicing", "hybrid-slicing"}) {
    const CommandResult held =
        run_plumb(with({"audit"}, {"--method", method, "--tolerance", "1px"}));
    EXPECT_EQ(held.status, 0) << held.err;
    EXPECT_NE(held.out.find("Every claim holds"), std::string::npos) << held.out;
    EXPECT_NE(held.out.find(" slices, "), std::string::npos);
    EXPECT_NE(held.out.find("set aside  0 pixels"), std::string::npos);
    EXPECT_EQ(held.out.find("topology"), std::string::npos);
  }
  TemporaryFolder folder;
  // The article's own rules do not keep what they promise.
  const CommandResult broken = run_plumb(
      {"audit", "generate:alpine?size=257&seed=3", "--size", "320x180", "--method", "slicing",
       "--variant", "published", "--tolerance", "1px", "-o", folder.file("report"), "--json"});
  EXPECT_EQ(broken.status, 1) << broken.err;
  const json result = json::parse(broken.out);
  EXPECT_EQ(result.at("claims").at(0).at("measure"), "pixel-error");
  EXPECT_TRUE(result.at("errors").at("sample_m").is_null());
  EXPECT_TRUE(result.at("topology").is_null());
  EXPECT_GT(result.at("errors").at("pixel_vertical_px").at("count"), 1000);
  EXPECT_EQ(result.at("coverage").at("set_aside"), 0);
  EXPECT_TRUE(std::filesystem::exists(folder.file("report") + "/report.html"));
}

TEST(AuditCommand, RefusesWhatSlicesDoNotHave) {
  const std::vector<std::vector<std::string>> wrong{
      {"--tolerance", "5m"},          {"--tolerance", "0px"},    {"--limit", "topology=0"},
      {"--set", "heights=cubic"},     {"--set", "leaf_cells=7"}, {"--set", "descend=0"},
      {"--set", "profile=none.toml"}, {"--variant", "printed"}};
  for (std::vector<std::string> options : wrong) {
    options.insert(options.begin(), {"--method", "slicing"});
    const CommandResult result = run_plumb(with({"audit"}, options));
    EXPECT_EQ(result.status, 2) << options.back();
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST(AuditCommand, EndsWithOneIfALimitIsBroken) {
  const CommandResult result =
      run_plumb(with({"audit"}, {"--tolerance", "20px", "--limit", "pixel-error=0.01px"}));
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("Broken: pixel-error"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("worst:"), std::string::npos);
}

TEST(AuditCommand, GivesTheSameJsonOnAnyNumberOfThreads) {
  const auto run = [](const char* threads) {
    json result = json::parse(
        run_plumb(with({"audit"}, {"--tolerance", "2px", "--json", "--threads", threads})).out);
    EXPECT_EQ(result.at("schema"), "plumb.audit/1");
    result.erase("timing");
    result.erase("command");  // it names the threads
    return result;
  };
  const json one = run("1");
  EXPECT_EQ(one, run("2"));
  EXPECT_EQ(one, run("7"));
  EXPECT_EQ(one.at("verdict"), "held");
}

TEST(AuditCommand, WritesAReportThatNeedsNothingElse) {
  TemporaryFolder folder;
  const std::string out = folder.file("report");
  const CommandResult result = run_plumb(with({"audit"}, {"-o", out}));
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* name : {"report.html", "audit.json", "truth.png", "drawn.png", "difference.png",
                           "pixel-error.png", "nearest-error.png", "coverage.png"}) {
    EXPECT_TRUE(std::filesystem::file_size(std::filesystem::path(out) / name) > 0) << name;
  }
  std::ifstream page(out + "/report.html");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  EXPECT_EQ(text.find("http://"), std::string::npos);
  EXPECT_EQ(text.find("https://"), std::string::npos);
  EXPECT_NE(text.find("pixel-error"), std::string::npos);
}

TEST(AuditCommand, MakesAResultAgainFromItsOwnCommand) {
  const CommandResult first = run_plumb(with({"audit"}, {"--tolerance", "0.5px", "--json"}));
  json a = json::parse(first.out);
  const std::string command = a.at("command");
  ASSERT_EQ(command.rfind("plumb ", 0), 0u);
  const CommandResult second = run_command({"sh", "-c", "exec " PLUMB_BIN_DIR "/" + command});
  json b = json::parse(second.out);
  a.erase("timing");
  b.erase("timing");
  EXPECT_EQ(a, b);
}

TEST(AuditCommand, RefusesWhatItCannotJudgeInOneLine) {
  const auto refuses = [](const std::vector<std::string>& arguments, const std::string& part) {
    const CommandResult result = run_plumb(with({"audit"}, arguments));
    EXPECT_EQ(result.status, 2) << part;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  };
  refuses({"--tolerance", "1"}, "tolerance '1'");
  refuses({"--method", "unknown"}, "unknown");
  refuses({"--variant", "published"}, "has no variant 'published'");
  refuses({"--set", "patch_cells=3"}, "patch_cells");
  refuses({"--set", "nothing=3"}, "has no parameter 'nothing'");
  refuses({"--limit", "beauty=1px"}, "beauty");
  refuses({"--camera", "nowhere"}, "nowhere");
  refuses({"--mesh", "no-such.ply"}, "no-such.ply");
  refuses({"--limit", "nearest-error=1px", "--without-nearest"}, "nearest-error");
}

// A square sheet one metre above a plane, written by hand.
TEST(AuditCommand, JudgesAStrangersMeshByTheLimitsThatItIsGiven) {
  TemporaryFolder folder;
  const std::string mesh = folder.file("sheet.ply");
  std::ofstream(mesh) << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty "
                         "float y\nproperty float z\n"
                         "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                         "0 0 1\n640 0 1\n640 640 1\n0 640 1\n3 0 1 2\n3 0 2 3\n";
  const std::vector<std::string> common{"audit",    "generate:plane?size=65&spacing=10&height=0",
                                        "--mesh",   mesh,
                                        "--camera", "top",
                                        "--size",   "100x100",
                                        "--json"};
  const CommandResult measured = run_plumb(common);
  ASSERT_EQ(measured.status, 0) << measured.err << measured.out;
  EXPECT_DOUBLE_EQ(json::parse(measured.out).at("errors").at("sample_m").at("max").get<double>(),
                   1.0);
  std::vector<std::string> limited = common;
  limited.insert(limited.end(), {"--limit", "sample-error=0.9m"});
  EXPECT_EQ(run_plumb(limited).status, 1);
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The method keeps its promise at the samples; the truth that it is held against is cut along other
// diagonals, and is far off between them.
TEST(AuditCommand, ShowsWhereTheSurfaceErrorIsBroken) {
  TemporaryFolder folder;
  const std::vector<std::string> arguments{
      "audit", "generate:alpine?size=129", "--diagonal", "fixed", "--tolerance", "1m", "--size",
      "160x90"};
  std::vector<std::string> with_json = arguments;
  with_json.insert(with_json.end(), {"--json", "-o", folder.file("report")});
  const CommandResult result = run_plumb(arguments);
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.out.find("worst: surface-error 14.33 m "), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("worst: sample-error"), std::string::npos) << result.out;
  const json written = json::parse(run_plumb(with_json).out);
  const json& claim = written.at("claims").at(1);
  EXPECT_EQ(claim.at("measure"), "surface-error");
  EXPECT_EQ(claim.at("verdict"), "broken");
  EXPECT_GT(claim.at("violations").get<int>(), 1000);  // places, of 26 thousand triangles
  const json& worst = written.at("offenders").at(0);
  EXPECT_EQ(worst.at("breaks"), "surface-error");
  EXPECT_EQ(worst.at("value"), claim.at("measured"));
  EXPECT_EQ(worst, claim.at("worst"));
  EXPECT_TRUE(worst.at("triangle").is_number());
  const std::string page = text_of(folder.file("report") + "/report.html");
  EXPECT_NE(page.find("<td>surface-error</td><td class=\"number\">14.33 m</td>"),
            std::string::npos);
}

// Two squares on a plane, with a gap of one between them; the eye looks at none of it.
TEST(AuditCommand, ShowsWhereTheTopologyIsBrokenOutOfView) {
  TemporaryFolder folder;
  const std::string mesh = folder.file("squares.obj");
  std::ofstream(mesh) << "v 0 0 0\nv 160 0 0\nv 160 640 0\nv 0 640 0\n"
                         "v 320 0 0\nv 640 0 0\nv 640 640 0\nv 320 640 0\n"
                         "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n";
  const std::vector<std::string> arguments{"audit",    "generate:plane?size=65&spacing=10&height=0",
                                           "--mesh",   mesh,
                                           "--camera", "320,320,500,320,320,900",
                                           "--size",   "60x60",
                                           "--limit",  "topology=0",
                                           "-o",       folder.file("report")};
  const CommandResult result = run_plumb(arguments);
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.out.find("worst: topology (open edge) out of view, world ("), std::string::npos)
      << result.out;
  EXPECT_EQ(result.out.find(" 0 px at"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("not measured"), std::string::npos) << result.out;  // coverage
  const json written = json::parse(text_of(folder.file("report") + "/audit.json"));
  EXPECT_EQ(written.at("claims").at(2).at("violations"), 2);  // after the tolerance and coverage
  EXPECT_EQ(written.at("offenders").at(0).at("what"), "open edge");
  EXPECT_TRUE(written.at("offenders").at(0).at("pixel").is_null());
  EXPECT_NE(text_of(folder.file("report") + "/report.html").find("out of view"), std::string::npos);
}

TEST(AuditCommand, HasNoVerdictWhereNothingIsInView) {
  const std::vector<std::string> away{"--tolerance", "1px", "--camera",
                                      "300,300,90000,300,300,100000"};
  TemporaryFolder folder;
  std::vector<std::string> written = away;
  written.insert(written.end(), {"-o", folder.file("report")});
  const CommandResult result = run_plumb(with({"audit"}, written));
  EXPECT_EQ(result.status, 2) << result.out;
  EXPECT_NE(result.out.find("\nNo verdict: nothing of the terrain is in view of this camera.\n"),
            std::string::npos)
      << result.out;
  EXPECT_EQ(result.out.find("holds"), std::string::npos) << result.out;
  EXPECT_NE(text_of(folder.file("report") + "/report.html").find("<strong>No verdict</strong>"),
            std::string::npos);
  std::vector<std::string> as_json = away;
  as_json.push_back("--json");
  const CommandResult told = run_plumb(with({"audit"}, as_json));
  EXPECT_EQ(told.status, 2);
  EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
  const json j = json::parse(told.out);
  EXPECT_EQ(j.at("verdict"), "none");
  EXPECT_EQ(j.at("no_verdict"), "nothing of the terrain is in view of this camera");
  EXPECT_EQ(j.at("claims").at(0).at("verdict"), "not measured");
  EXPECT_TRUE(j.at("claims").at(0).at("holds").is_null());
  EXPECT_TRUE(j.at("claims").at(0).at("measured").is_null());
}

TEST(AuditCommand, HasNoVerdictOfATerrainWithoutASurface) {
  const CommandResult result = run_plumb({"audit", "generate:plane?size=1", "--size", "40x30"});
  EXPECT_EQ(result.status, 2) << result.out;
  EXPECT_NE((result.out + result.err).find("No verdict: the terrain has no surface (1 x 1 samples"),
            std::string::npos)
      << result.out << result.err;
}

// Bounds in metres do not depend on the view: what can be measured is judged.
TEST(AuditCommand, JudgesWhatCanBeMeasuredOutOfView) {
  const CommandResult result =
      run_plumb(with({"audit"}, {"--tolerance", "5m", "--camera", "300,300,90000,300,300,100000"}));
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("not measured: coverage"), std::string::npos) << result.out;
}

TEST(AuditCommand, PassesOverFramesOfAPathThatShowNothing) {
  TemporaryFolder folder;
  const std::string away = "[[camera]]\neye = [300, 300, 90000]\ntarget = [300, 300, 100000]\n";
  const std::string down = "[[camera]]\neye = [300, 300, 9000]\ntarget = [300, 301, 0]\n";
  std::ofstream(folder.file("some.toml")) << away << down;
  std::ofstream(folder.file("none.toml")) << away << away;
  const CommandResult some =
      run_plumb(with({"audit"}, {"--tolerance", "1px", "--camera", folder.file("some.toml")}));
  EXPECT_EQ(some.status, 0) << some.out << some.err;
  EXPECT_NE(some.out.find("1 of 2 frames keep every claim; 1 without a verdict: nothing of the "
                          "terrain is in view of this camera."),
            std::string::npos)
      << some.out;
  const CommandResult none =
      run_plumb(with({"audit"}, {"--tolerance", "1px", "--camera", folder.file("none.toml")}));
  EXPECT_EQ(none.status, 2) << none.out << none.err;
  EXPECT_NE(none.out.find("No verdict"), std::string::npos) << none.out;
}

TEST(TruthCommand, HasAWitnessThatAgrees) {
  for (const char* camera : {"oblique", "top", "grazing", "valley"}) {
    const CommandResult result =
        run_plumb(with({"truth"}, {"--camera", camera, "--witness", "--json"}));
    EXPECT_EQ(result.status, 0) << camera << result.out << result.err;
    const json j = json::parse(result.out);
    EXPECT_TRUE(j.at("witness").at("agrees"));
    EXPECT_GT(j.at("hits").get<int>(), 1000);
  }
}

TEST(TruthCommand, WritesPictures) {
  TemporaryFolder folder;
  EXPECT_EQ(run_plumb(with({"truth"}, {"-o", folder.file("a.exr")})).status, 0);
  EXPECT_EQ(run_plumb(with({"truth"}, {"-o", folder.file("a.png")})).status, 0);
  EXPECT_EQ(run_plumb(with({"truth"}, {"-o", folder.file("a.jpg")})).status, 2);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.exr", "a.png"}));
}

}  // namespace
}  // namespace plumb::testing
