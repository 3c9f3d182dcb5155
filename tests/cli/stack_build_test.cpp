// plumb build --method stacks, and plumb info of what it wrote.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "support/run_command.h"
#include "terrain/stacks/stack_file.h"
#include "terrain/terrain_source.h"

namespace plumb::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kTerrain = "generate:canyon?size=50&seed=5&voids=0.2";

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> stacks(const std::string& output, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"build", "--method", "stacks", "-o", output};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

json json_of(std::vector<std::string> arguments) {
  arguments.push_back("--json");
  const CommandResult result = run_plumb(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

void expect_one_line(const CommandResult& result, const std::string& words) {
  EXPECT_EQ(result.status, 2) << result.out;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

// Two rows of two samples, 2 m apart.
std::string grid(const std::string& heights) {
  return "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 2\nNODATA_value -9\n" + heights;
}

TEST(BuildStacks, KeepsATerrainToTheBit) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.stacks");
  const json built = json_of(stacks(file, {kTerrain}));
  const terrain::StackField field = terrain::read_stacks(file),
                            source = terrain::stacks_of(terrain::load_terrain(kTerrain, {}));
  EXPECT_EQ(checksum(field), checksum(source));
  EXPECT_EQ(built.at("schema"), "plumb.stacks/1");
  EXPECT_EQ(built.at("bytes"), fs::file_size(file));
  json info = json_of({"info", file});
  EXPECT_EQ(info.at("terrain").at("columns"), 50);
  EXPECT_EQ(info.at("layers"), field.end_m.size());
  EXPECT_EQ(info.at("voxel_bytes"), 2500.0 * field.voxels);
  EXPECT_EQ(info.at("materials").size(), 2u);
  EXPECT_EQ(info.at("materials")[1].at("share"), 1.0);
  info["command"] = built.at("command");
  EXPECT_EQ(info, built);
  const CommandResult text = run_plumb({"info", file});
  EXPECT_EQ(text.status, 0);
  EXPECT_NE(text.out.find("50 x 50 stacks"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("rock"), std::string::npos);
  const std::string one = bytes_of(file);
  json_of(stacks(file, {kTerrain, "--threads", "7"}));
  EXPECT_EQ(bytes_of(file), one);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"t.stacks"});
}

// Rock to 1 m, air to 3 m and a roof of 1 m over one sample of four: 4 square metres each.
TEST(BuildStacks, LaysLayersOnEachOther) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.stacks"), low = folder.file("low.asc"),
                    gap = folder.file("gap.asc"), high = folder.file("high.asc");
  write(low, grid("1 1\n1 1\n"));
  write(gap, grid("1 1\n3 1\n"));
  write(high, grid("1 1\n4 1\n"));
  const json built = json_of(
      stacks(file, {"--layer", "rock=" + low, "--layer", "air=" + gap, "--layer", "roof=" + high}));
  const json& materials = built.at("materials");
  ASSERT_EQ(materials.size(), 3u);
  EXPECT_EQ(materials[0].at("volume_m3"), 8.0);
  EXPECT_EQ(materials[1].at("volume_m3"), 4 * 4.0 * (1.0 - built.at("low_m").get<double>()));
  EXPECT_EQ(materials[2].at("name"), "roof");
  EXPECT_EQ(materials[2].at("volume_m3"), 4.0);
  EXPECT_EQ(built.at("most_layers"), 3);
}

TEST(BuildStacks, TakesVoxelsAndMeshes) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.stacks"), raw = folder.file("v.raw"),
                    mesh = folder.file("m.obj");
  write(raw, std::string("\1\0\1\0\0\0\2\0", 8));
  const json voxels = json_of(stacks(
      file, {"--voxels", raw, "--voxel-grid", "2x1x4", "--spacing", "3", "--voxel-height", "0.5"}));
  EXPECT_EQ(voxels.at("materials")[1].at("volume_m3"), 9.0);
  EXPECT_EQ(voxels.at("materials")[2].at("volume_m3"), 4.5);
  // A tetrahedron with legs of 4 m to the south, wound inwards: y up in the file.
  write(mesh, "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  const json solid = json_of(stacks(file, {"--mesh", mesh, "--up", "y", "--spacing", "1"}));
  EXPECT_GT(solid.at("materials")[1].at("volume_m3"), 0.0);
  const json cave = json_of(
      stacks(file, {"--mesh", mesh, "--up", "y", "--spacing", "1", "--subtract", "--margin", "2"}));
  EXPECT_EQ(cave.at("materials")[0].at("volume_m3"), solid.at("materials")[1].at("volume_m3"));
  EXPECT_EQ(cave.at("terrain").at("columns"), 4 + 2 + 2 * 2);
}

TEST(BuildStacks, TellsBadInputInOneLineAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.stacks");
  const auto refused = [&](const std::vector<std::string>& more, const std::string& words) {
    expect_one_line(run_plumb(stacks(file, more)), words);
  };
  refused({}, "needs one of TERRAIN");
  refused({kTerrain, "--mesh", "m.ply"}, "got 2 of them");
  refused({kTerrain, "--error", "1m"}, "exact");
  refused({kTerrain, "--subtract"}, "--subtract is for --mesh");
  refused({kTerrain, "--voxel-height", "-1"}, "--voxel-height");
  refused({"--layer", "rock"}, "NAME=FILE");
  refused({"--layer", std::string("rock=") + kTerrain, "--layer", "soil=generate:plane?size=9"},
          "must have one size");
  refused({"--voxels", "v.raw"}, "--spacing is required");
  refused({"--voxels", "v.raw", "--spacing", "1"}, "--voxel-grid");
  refused({"--voxels", "v.raw", "--spacing", "1", "--voxel-grid", "2x2"}, "EASTxNORTHxUP");
  refused({"--voxels", "v.raw", "--spacing", "1", "--voxel-grid", "2x2x2"}, "v.raw");
  refused({"--mesh", "m.ply", "--spacing", "1", "--band", "2"}, "--spacing alone");
  expect_one_line(run_plumb(stacks(folder.file("no/t.stacks"), {kTerrain})), "no/t.stacks");
  expect_one_line(run_plumb({"build", "--error", "1m", "-o", file}), "TERRAIN is required");
  expect_one_line(run_plumb({"build", kTerrain, "--error", "1m", "--subtract", "-o", file}),
                  "--method stacks");
  EXPECT_TRUE(fs::is_empty(folder.path()));
  const std::string low = folder.file("low.asc");
  write(low, grid("1 1\n1 1\n"));
  expect_one_line(run_plumb(stacks(low, {"--layer", "rock=" + low})), "the terrain itself");
  expect_one_line(run_plumb(stacks(low, {low})), "the terrain itself");
  EXPECT_EQ(bytes_of(low), grid("1 1\n1 1\n"));
  json_of(stacks(file, {kTerrain}));
  expect_one_line(run_plumb({"info", file, "--band", "2"}), "file of stacks");
  const std::string whole = bytes_of(file);
  write(file, whole.substr(0, whole.size() - 1));
  expect_one_line(run_plumb({"info", file}), "its table says");
}

}  // namespace
}  // namespace plumb::testing
