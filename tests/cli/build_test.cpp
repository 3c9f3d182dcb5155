// plumb build, info and decode: what one process wrote, another reads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "support/run_command.h"
#include "terrain/terrain_source.h"

namespace plumb::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using terrain::Heightfield;

constexpr const char* kTerrain = "generate:canyon?size=150&seed=5&voids=0.2";

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::vector<std::string> build(const std::string& output, const std::vector<std::string>& more = {},
                               const std::string& source = kTerrain) {
  std::vector<std::string> arguments{"build",   source, "--method", "tessellation",
                                     "--error", "1m",   "-o",       output};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

json json_of(std::vector<std::string> arguments) {
  arguments.push_back("--json");
  const CommandResult result = run_plumb(arguments);
  EXPECT_EQ(result.status, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

// The largest difference of one terrain's samples from every `step`-th of another's, from sample
// (i, j) on; infinite where a void is none, or the other way round.
double worst(const Heightfield& part, const Heightfield& whole, int step = 1, int first_i = 0,
             int first_j = 0) {
  double most = 0.0;
  for (int j = 0; j < part.rows(); ++j) {
    for (int i = 0; i < part.columns(); ++i) {
      const float a = part.heights_m(i, j),
                  b = whole.heights_m((first_i + i) * step, (first_j + j) * step);
      if (std::isnan(a) != std::isnan(b)) return std::numeric_limits<double>::infinity();
      if (!std::isnan(a)) most = std::max(most, std::abs(double{a} - double{b}));
    }
  }
  return most;
}

// One line that begins as every error does, and nothing on standard output.
void expect_one_line(const CommandResult& result, const std::string& words) {
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err.rfind("plumb: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
}

TEST(Build, KeepsItsErrorAndItsVoidsThroughFiles) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.plumb"), tif = folder.file("t.tif");
  const Heightfield source = terrain::load_terrain(kTerrain, {});
  for (const char* version : {"1", "2"}) {
    const json built = json_of(build(file, {"--format-version", version, "--patch-cells", "32"}));
    EXPECT_EQ(built.at("promised_m"), 1.0);
    EXPECT_EQ(built.at("bytes"), fs::file_size(file));
    EXPECT_EQ(built.at("raw_bytes"), 4 * 150 * 150);
    const json decoded = json_of({"decode", file, "-o", tif});
    EXPECT_EQ(decoded.at("columns"), 150);
    EXPECT_EQ(decoded.at("voids"), built.at("voids"));
    const Heightfield back = terrain::load_terrain(tif, {});
    ASSERT_EQ(back.columns(), 150);
    ASSERT_EQ(back.rows(), 150);
    EXPECT_LE(worst(back, source), 1.0);
    EXPECT_EQ(worst(back, source), built.at("largest_error_m"));
    EXPECT_EQ(back.origin_m, source.origin_m);
    EXPECT_EQ(back.dx_m, source.dx_m);
  }
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"t.plumb", "t.tif"}));
}

TEST(Build, KeepsItsErrorOnRealFiles) {
  const std::string data = PLUMB_SOURCE_DIR "/../shared/data/";
  if (!fs::exists(data)) GTEST_SKIP() << data << " is not there";
  const TemporaryFolder folder;
  const std::string file = folder.file("t.plumb"), tif = folder.file("t.tif");
  for (const auto& [name, window] :
       {std::pair{"taiwan_central_8193.tif", terrain::Window{4000, 3000, 300, 257}},
        {"narok_kenya_5840x4934.tif", terrain::Window{2000, 200, 1025, 900}},
        {"ahn_dsm_0p5m_963x840.tif", terrain::Window{0, 0, 300, 257}},
        {"N29W014.hgt", terrain::Window{500, 500, 300, 257}}}) {
    if (!fs::exists(data + name)) continue;
    terrain::ReadOptions read;
    read.window = window;
    const Heightfield source = terrain::load_terrain(data + name, read);
    json_of(build(
        file,
        {"--window", fmt::format("{},{},{},{}", window.x, window.y, window.width, window.height)},
        data + name));
    json_of({"decode", file, "-o", tif, "--compress", "zstd"});
    const Heightfield back = terrain::load_terrain(tif, {});
    EXPECT_LE(worst(back, source), 1.0) << name;
    EXPECT_EQ(back.dx_m, source.dx_m) << name;
    EXPECT_EQ(back.provenance.crs, terrain::system_of_coordinates(source.provenance)) << name;
  }
}

// Of version 2 a coarser level has every second sample of the finer one, as decoded: 75 of the 150
// along a side, the last column and row of the terrain not among them.
TEST(Decode, GivesCoarserLevels) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.plumb");
  json_of(build(file, {"--patch-cells", "16"}));
  json_of({"decode", file, "-o", folder.file("0.tif")});
  const json decoded = json_of({"decode", file, "--level", "1", "-o", folder.file("1.tif")});
  EXPECT_EQ(decoded.at("columns"), 75);
  EXPECT_EQ(decoded.at("left_out"), (json{{"columns", 1}, {"rows", 1}}));
  const Heightfield fine = terrain::load_terrain(folder.file("0.tif"), {}),
                    coarse = terrain::load_terrain(folder.file("1.tif"), {});
  EXPECT_EQ(worst(coarse, fine, 2), 0.0);
  EXPECT_EQ(coarse.dx_m, 2 * fine.dx_m);
  EXPECT_EQ(coarse.origin_m, fine.origin_m);
}

// At level 3 sample 144 is the last of nineteen on the grid, five before the terrain's; at level 0
// all are on it. Of level 1 patch (4, 4) begins at sample 128; (3, 4) ends there, in the east
// alone.
TEST(Decode, SaysWhatACoarserLevelLeavesOut) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.plumb");
  json_of(build(file, {"--patch-cells", "16"}));
  const auto said = [&](const char* option, const char* part) {
    const std::string out =
        run_plumb({"decode", file, option, part, "-o", folder.file("p.tif")}).out;
    const std::size_t at = out.find("left out  ");
    return at == std::string::npos ? "" : out.substr(at + 10, out.find(", beyond") - at - 10);
  };
  EXPECT_EQ(said("--level", "3"), "5 of 150 columns in the east, 5 of 150 rows in the north");
  EXPECT_EQ(said("--level", "0"), "");
  EXPECT_EQ(said("--patch", "1,3,4"), "1 of 150 rows in the north");
  EXPECT_EQ(said("--patch", "1,3,3"), "");
}

// Patch (2, 1) of 16 cells begins at sample (32, 16); the last one ends with the terrain: samples
// 144 to 149.
TEST(Decode, GivesOnePatch) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.plumb");
  json_of(build(file, {"--patch-cells", "16"}));
  json_of({"decode", file, "-o", folder.file("all.tif")});
  const Heightfield all = terrain::load_terrain(folder.file("all.tif"), {});
  json_of({"decode", file, "--patch", "0,2,1", "-o", folder.file("p.tif")});
  const Heightfield patch = terrain::load_terrain(folder.file("p.tif"), {});
  EXPECT_EQ(patch.columns(), 17);
  EXPECT_EQ(patch.rows(), 17);
  EXPECT_EQ(worst(patch, all, 1, 32, 16), 0.0);
  EXPECT_EQ(patch.origin_m, all.origin_m + glm::dvec2(32 * all.dx_m, 16 * all.dy_m));
  EXPECT_EQ(json_of({"decode", file, "--patch", "0,9,9", "-o", folder.file("p.tif")}).at("columns"),
            6);
}

TEST(Decode, GivesBareSamples) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.plumb");
  json_of(build(file));
  json_of({"decode", file, "-o", folder.file("t.tif")});
  json_of({"decode", file, "-o", folder.file("t.r32")});
  terrain::ReadOptions read;
  read.raw_size = terrain::RawSize{150, 150};
  read.require_spacing = false;
  EXPECT_EQ(worst(terrain::load_terrain(folder.file("t.r32"), read),
                  terrain::load_terrain(folder.file("t.tif"), {})),
            0.0);
}

TEST(Decode, TellsDamageInOneLine) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.plumb"), harmed = folder.file("harmed.plumb");
  json_of(build(file));
  const std::string whole = bytes_of(file);
  const auto harm = [&](std::size_t at) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 4);
    write(harmed, bytes);
  };
  for (const std::size_t at : {std::size_t{0}, std::size_t{9}, std::size_t{30}, whole.size() / 2}) {
    harm(at);
    expect_one_line(run_plumb({"decode", harmed, "-o", folder.file("t.tif")}), harmed);
  }
  harm(whole.size() - 1);  // of the bounds, which only drawing reads
  expect_one_line(run_plumb({"render", kTerrain, "--method", "tessellation", "--prepared", harmed,
                             "-o", folder.file("t.png")}),
                  harmed);
  write(harmed, whole.substr(0, whole.size() - 1));
  expect_one_line(run_plumb({"decode", harmed, "-o", folder.file("t.tif")}), harmed);
  expect_one_line(run_plumb({"info", harmed}), harmed);
  expect_one_line(run_plumb({"decode", folder.file("none"), "-o", folder.file("t.tif")}), "none");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"harmed.plumb", "t.plumb"}));
}

TEST(Decode, TellsWhatItCannotGive) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.plumb");
  json_of(build(file));  // 2 x 2 patches and one above
  const std::string tif = folder.file("t.tif");
  expect_one_line(run_plumb({"decode", file}), "-o");
  expect_one_line(run_plumb({"decode", file, "-o", folder.file("t.png")}), ".tif or .r32");
  expect_one_line(run_plumb({"decode", file, "-o", tif, "--level", "2"}), "the coarsest is 1");
  expect_one_line(run_plumb({"decode", file, "-o", tif, "--patch", "0,2,0"}), "2 x 2 patches");
  expect_one_line(run_plumb({"decode", file, "-o", tif, "--patch", "0,2"}), "LEVEL,PX,PY");
  expect_one_line(run_plumb({"decode", file, "-o", tif, "--patch", "0,0,0", "--level", "0"}),
                  "--level");
  expect_one_line(run_plumb({"decode", file, "-o", tif, "--samples", "int16"}), "whole metres");
  expect_one_line(run_plumb({"decode", file, "-o", folder.file("no/t.tif")}), "no/t.tif");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"t.plumb"}));
}

TEST(Info, TellsWhatIsInACodedTerrainOfAnyName) {
  const TemporaryFolder folder;
  const std::string file = folder.file("something.tif");
  const json built = json_of(build(file, {"--format-version", "1", "--patch-cells", "32"}));
  const json info = json_of({"info", file});
  EXPECT_EQ(info.at("schema"), "plumb.container/1");
  EXPECT_EQ(info.at("format_version"), 1);
  EXPECT_EQ(info.at("error_m"), 1.0);
  EXPECT_EQ(info.at("terrain").at("columns"), 150);
  EXPECT_EQ(info.at("patch_cells"), 32);
  EXPECT_EQ(info.at("bytes"), built.at("bytes"));
  EXPECT_EQ(info.at("bits_per_sample"), built.at("bits_per_sample"));
  ASSERT_EQ(info.at("levels").size(), 4u);  // 5 x 5 patches, 3 x 3, 2 x 2, 1
  EXPECT_EQ(info.at("levels")[1].at("patches"), (std::vector<int>{3, 3}));
  EXPECT_EQ(info.at("levels")[1].at("promised_m"), 2.0);
  // All but the header: what stands before it, and 8 bytes for each of 40 and 39 records.
  std::int64_t records = 0;
  for (const json& level : info.at("levels")) {
    EXPECT_GT(level.at("heights_bytes"), 0);
    records += level.at("heights_bytes").get<std::int64_t>();
    records += level.at("payload_bytes").get<std::int64_t>();
  }
  EXPECT_LT(records, info.at("bytes").get<std::int64_t>() - 24 - 8 * 79);
  // And its texts, and the parameters: 25 contexts of 16 frequencies of at most two bytes.
  EXPECT_GT(records, info.at("bytes").get<std::int64_t>() - 24 - 8 * 79 - 400 - 25 * 32 - 16);
  EXPECT_NE(run_plumb({"info", file}).out.find("at most 1 m"), std::string::npos);
  expect_one_line(run_plumb({"info", file, "--band", "2"}), "coded terrain");
}

TEST(Build, IsTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  json one = json_of(build(folder.file("t.plumb"), {"--threads", "1"}));
  const std::string bytes = bytes_of(folder.file("t.plumb"));
  json seven = json_of(build(folder.file("t.plumb"), {"--threads", "7"}));
  EXPECT_EQ(bytes_of(folder.file("t.plumb")), bytes);
  for (json* result : {&one, &seven}) {
    result->erase("timing");
    result->erase("command");
  }
  EXPECT_EQ(one, seven);
}

TEST(Build, TellsBadInputInOneLineAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.plumb");
  const auto with_error = [&](const std::string& error) {
    return run_plumb({"build", kTerrain, "--error", error, "-o", file});
  };
  expect_one_line(with_error("0m"), "--error");
  expect_one_line(with_error("-1m"), "--error");
  expect_one_line(with_error("nanm"), "--error");
  expect_one_line(with_error("1"), "--error");
  expect_one_line(with_error("1px"), "in metres");
  expect_one_line(with_error("1e-7m"), "single precision");
  expect_one_line(run_plumb({"build", kTerrain, "-o", file}), "--error is required");
  expect_one_line(run_plumb({"build", kTerrain, "--error", "1m"}), "-o");
  expect_one_line(run_plumb(build("-")), "-o -");
  expect_one_line(run_plumb(build(file, {"--window", "0,0,150,1"})), "2 x 2 samples");
  expect_one_line(run_plumb(build(file, {"--patch-cells", "100"})), "power of two");
  expect_one_line(run_plumb(build(file, {"--format-version", "3"})), "--format-version");
  expect_one_line(run_plumb(build(file, {"--method", "full"})), "tessellation");
  expect_one_line(run_plumb(build(folder.file("no/t.plumb"))), "no/t.plumb");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Build, RefusesATerrainThatIsAllVoidAndOneThatIsItsOwnOutput) {
  const TemporaryFolder folder;
  const std::string grid = folder.file("grid.asc");
  write(grid,
        "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9\n"
        "-9 -9 -9\n-9 -9 -9\n");
  const std::string before = bytes_of(grid);
  expect_one_line(run_plumb(build(folder.file("t.plumb"), {}, grid)), "every sample is void");
  expect_one_line(run_plumb(build(grid, {"--nodata", "5"}, grid)), "the terrain itself");
  EXPECT_EQ(bytes_of(grid), before);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"grid.asc"}));
}

// A file that may not grow beyond a block or two of 512 bytes is a disk that is full.
TEST(Build, LeavesNothingOnAFullDisk) {
  const TemporaryFolder folder;
  json_of(build(folder.file("t.plumb")));
  const std::string limited = "trap '' XFSZ; ulimit -f 2; exec " PLUMB_BIN_DIR "/plumb ";
  expect_one_line(run_command({"sh", "-c",
                               limited + "build '" + kTerrain + "' --error 1m -o '" +
                                   folder.file("u.plumb") + "'"}),
                  "u.plumb");
  expect_one_line(run_command({"sh", "-c",
                               limited + "decode '" + folder.file("t.plumb") + "' -o '" +
                                   folder.file("u.tif") + "'"}),
                  "u.tif");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"t.plumb"}));
}

}  // namespace
}  // namespace plumb::testing
