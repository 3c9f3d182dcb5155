// plumb audit --mesh: where a file's mesh lies, and what is said of its numbers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "support/run_command.h"
#include "terrain/terrain_source.h"

namespace plumb::testing {
namespace {

using nlohmann::json;

const std::string kUtm = "generate:alpine?size=65&seed=3&utm=1";  // from (500000, 4500000) on

CommandResult audit(const std::string& terrain, const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"audit",  terrain,      "--size",
                                     "160x90", "--diagonal", "alternating"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run_plumb(arguments);
}

json audit_json(const std::string& terrain, std::vector<std::string> options, int status) {
  options.push_back("--json");
  const CommandResult result = audit(terrain, options);
  EXPECT_EQ(result.status, status) << result.err;
  return json::parse(result.out);
}

// The full-detail mesh of `terrain` as OBJ, its vertices relative to (x, y), with every digit.
void write_full_obj(const std::string& terrain, const std::string& path, double x, double y) {
  const terrain::Heightfield field = terrain::load_terrain(terrain, {});
  std::ofstream file(path);
  for (int j = 0; j < field.rows(); ++j) {
    for (int i = 0; i < field.columns(); ++i)
      file << fmt::format("v {} {} {}\n", field.origin_m.x + i * field.dx_m - x,
                          field.origin_m.y + j * field.dy_m - y,
                          static_cast<double>(field.heights_m(i, j)));
  }
  for (int j = 0; j < field.cell_rows(); ++j) {
    for (int i = 0; i < field.cell_columns(); ++i) {
      const int sw = j * field.columns() + i + 1, se = sw + 1, nw = sw + field.columns(),
                ne = nw + 1;
      file << ((i + j) % 2 == 0 ? fmt::format("f {} {} {}\nf {} {} {}\n", sw, se, ne, sw, ne, nw)
                                : fmt::format("f {} {} {}\nf {} {} {}\n", sw, se, nw, se, ne, nw));
    }
  }
}

void expect_exact(const json& result) {
  EXPECT_EQ(result.at("verdict"), "held");
  EXPECT_EQ(result.at("errors").at("sample_m").at("max"), 0.0);
  EXPECT_EQ(result.at("errors").at("sample_m").at("count"), 65 * 65);
  EXPECT_EQ(result.at("samples").at("uncovered"), 0);
  EXPECT_EQ(result.at("coverage").at("holes"), 0);
  EXPECT_EQ(result.at("topology").at("open_edges"), 0);
  EXPECT_TRUE(result.at("method").at("hints").empty());
}

// What --method full draws has no error; read back from its file it is judged to the bit alike.
TEST(MeshAudit, OfARenderedMeshIsThatOfTheMethod) {
  for (const std::string terrain : {"generate:alpine?size=65&seed=3", kUtm.c_str()}) {
    const TemporaryFolder folder;
    const std::string mesh = folder.file("a.ply");
    ASSERT_EQ(run_plumb({"render", terrain, "--method", "full", "--size", "64x36", "-o",
                         folder.file("a.png"), "--mesh", mesh})
                  .status,
              0);
    const json of_method = audit_json(terrain, {"--method", "full"}, 0);
    const json of_file = audit_json(terrain, {"--mesh", mesh}, 0);
    expect_exact(of_file);
    for (const char* part : {"errors", "samples", "coverage", "topology", "registration"})
      EXPECT_EQ(of_file.at(part), of_method.at(part)) << part;
    EXPECT_EQ(of_file.at("method").at("assumptions").size(), 1u);
    EXPECT_TRUE(of_method.at("method").at("assumptions").empty());
  }
}

TEST(MeshAudit, SaysThatItTookTheFilesOwnOrigin) {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("a.ply");
  run_plumb({"render", kUtm, "--method", "full", "--size", "64x36", "-o", folder.file("a.png"),
             "--mesh", mesh});
  const CommandResult own = audit(kUtm, {"--mesh", mesh, "-o", folder.file("report")});
  EXPECT_EQ(own.status, 0) << own.err;
  EXPECT_EQ(own.err, "");
  const std::string line =
      "the mesh's origin is the one that its file states: 500000, 4500000, 0 m";
  EXPECT_NE(own.out.find("assumed: " + line), std::string::npos) << own.out;
  std::ifstream page(folder.file("report/report.html"));
  const std::string html{std::istreambuf_iterator<char>(page), {}};
  EXPECT_NE(html.find("origin is the one that its file states"), std::string::npos);
  const json given = audit_json(kUtm, {"--mesh", mesh, "--offset", "500000,4500000,1"}, 0);
  EXPECT_TRUE(given.at("method").at("assumptions").empty());
  EXPECT_EQ(given.at("errors").at("sample_m").at("max"), 1.0);  // it wins, and is a metre too high
}

TEST(MeshAudit, FindsNoErrorInAnExactMeshFarFromZero) {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("a.obj");
  for (const std::string& terrain : {kUtm, kUtm + "&spacing=0.7"}) {
    write_full_obj(terrain, mesh, 0.0, 0.0);
    expect_exact(audit_json(terrain, {"--mesh", mesh}, 0));
  }
  write_full_obj(kUtm, mesh, 500000.0, 4500000.0);
  expect_exact(audit_json(kUtm, {"--mesh", mesh, "--offset", "500000,4500000,0"}, 0));
}

void expect_refused(const CommandResult& result, const std::string& words) {
  EXPECT_EQ(result.status, 2) << result.out;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
}

TEST(MeshAudit, NamesWhereTheMeshLiesBeforeAnyError) {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("a.obj");
  write_full_obj(kUtm, mesh, 500000.0, 4500000.0);
  expect_refused(audit(kUtm, {"--mesh", mesh, "--json", "-o", folder.file("report")}),
                 "(--offset 500000,4500000,0)");
  EXPECT_FALSE(std::filesystem::exists(folder.file("report")));
  expect_exact(audit_json(kUtm, {"--mesh", mesh, "--offset", "500000,4500000,0"}, 0));
  expect_refused(audit("generate:alpine?size=65&seed=4", {"--mesh", mesh}),
                 "another terrain or place");
  std::ofstream(mesh) << "v 0 0 300\nv 10 0 300\nv 0 10 300\nf 1 2 3\n";
  expect_refused(audit(kUtm, {"--mesh", mesh}), "do not overlap");
}

// Feet with y upwards, as many an exporter writes them.
TEST(MeshAudit, TakesTheUpwardAxisAndTheUnit) {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("a.obj"), turned = folder.file("b.obj");
  const std::string terrain = "generate:alpine?size=65&seed=3";
  write_full_obj(terrain, mesh, 0.0, 0.0);
  std::ifstream in(mesh);
  std::ofstream out(turned);
  for (std::string line; std::getline(in, line);) {
    double x = 0.0, y = 0.0, z = 0.0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3)
      line = fmt::format("v {} {} {}", x / 0.25, z / 0.25, -y / 0.25);
    out << line << "\n";
  }
  out.close();
  expect_exact(audit_json(terrain, {"--mesh", turned, "--up", "y", "--scale", "0.25"}, 0));
  expect_refused(audit(terrain, {"--mesh", turned, "--scale", "0.25"}), "(--up y)");
  expect_refused(audit(terrain, {"--mesh", turned, "--up", "y"}), "(--scale 0.25)");
  expect_refused(audit(terrain, {"--mesh", turned}), "(--up y), and its unit is");
}

// A metre too high, everywhere.
TEST(MeshAudit, ClaimsTheTolerance) {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("a.obj");
  const std::string terrain = "generate:alpine?size=65&seed=3";
  write_full_obj(terrain, mesh, 0.0, 0.0);
  // A metre too high everywhere is a mistake that is named, unless it is to be audited.
  const std::vector<std::string> high{"--mesh", mesh,      "--offset",
                                      "0,0,1",  "--trust", "--tolerance"};
  const auto with = [&](const char* tolerance) {
    std::vector<std::string> options = high;
    options.push_back(tolerance);
    return options;
  };
  const json metres = audit_json(terrain, with("1m"), 0);
  EXPECT_EQ(metres.at("claims").at(0).at("measure"), "sample-error");
  EXPECT_EQ(metres.at("claims").at(0).at("measured"), 1.0);
  audit_json(terrain, with("0.99m"), 1);
  const json pixels = audit_json(terrain, with("1px"), 0);
  EXPECT_EQ(pixels.at("claims").at(0).at("measure"), "pixel-error");
  audit_json(terrain, with("0.01px"), 1);
}

// Floats near 4,500,000 lie half a metre apart.
TEST(MeshAudit, SaysThatSinglePrecisionMovesTheMesh) {
  const TemporaryFolder folder;
  const std::string mesh = folder.file("a.stl");
  std::ofstream(mesh) << "solid a\nfacet normal 0 0 1\nouter loop\nvertex 500000 4500000 300\n"
                         "vertex 501920 4500000 300\nvertex 500000 4501920 300\nendloop\nendfacet\n"
                         "endsolid a\n";
  const CommandResult result = audit(kUtm, {"--mesh", mesh, "--json"});
  EXPECT_EQ(result.status, 1);  // half of the terrain is bare
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find("coordinates of up to 4501920 m may be rounded by up to 0.25 m"),
            std::string::npos)
      << result.err;
  const json assumptions = json::parse(result.out).at("method").at("assumptions");
  ASSERT_EQ(assumptions.size(), 1u);
  EXPECT_EQ(result.err, "plumb: warning: " + assumptions[0].get<std::string>() + "\n");
}

TEST(MeshAudit, RefusesABrokenFileInOneLine) {
  const TemporaryFolder folder;
  const std::string ply = folder.file("a.ply"), obj = folder.file("a.obj");
  std::ofstream(ply) << "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000000000000\n"
                        "property double x\nproperty double y\nproperty double z\nelement face 1\n"
                        "property list uchar int vertex_indices\nend_header\n";
  std::ofstream(obj) << "v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n";
  for (const auto& [file, words] : {std::pair{ply, ": the header promises 1000000000000000000"},
                                    std::pair{obj, ": line 3: expected three finite numbers"}}) {
    const CommandResult result = audit(kUtm, {"--mesh", file});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_NE(result.err.find("mesh '" + file + "'" + words), std::string::npos) << result.err;
  }
}

}  // namespace
}  // namespace plumb::testing
