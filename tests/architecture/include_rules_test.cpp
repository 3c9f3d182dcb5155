#include "architecture/include_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

// A small house with one file of the given content; returns the walls that it breaks.
std::string broken_by(const std::string& file, const std::string& content) {
  const TemporaryFolder root;
  for (const std::string& name :
       {std::string("src/terrain/gdal_reader.h"), std::string("src/mesh/full/full.h"), file}) {
    std::filesystem::create_directories((root.path() / name).parent_path());
    std::ofstream(root.path() / name) << (name == file ? content : "#pragma once\n");
  }
  std::string all;
  for (const std::string& line : broken_walls(root.path())) all += line + "\n";
  return all;
}

// The same with that file in its module's list.
std::string broken_by_listed(const std::string& module, const std::string& name,
                             const std::string& content) {
  const TemporaryFolder root;
  const std::filesystem::path folder = root.path() / "src" / module;
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name) << content;
  std::ofstream(folder / "CMakeLists.txt") << "plumb_module(x HEADERS " << name << ")\n";
  std::string all;
  for (const std::string& line : broken_walls(root.path())) all += line + "\n";
  return all;
}

TEST(Walls, HoldInThisHouse) {
  for (const std::string& line : broken_walls(PLUMB_SOURCE_DIR)) ADD_FAILURE() << line;
}

TEST(Walls, AreLookedForInThisHouse) {
  EXPECT_TRUE(std::filesystem::exists(PLUMB_SOURCE_DIR "/src/core/camera.h"));
}

TEST(Walls, FallIfAMethodKnowsWhatJudgesIt) {
  EXPECT_EQ(broken_by("src/mesh/mine/mine.cpp", "\n#include \"reference/pyramid_caster.h\"\n"),
            "src/mesh/mine/mine.cpp:2: includes reference/pyramid_caster.h: mesh may not know "
            "reference\n");
  EXPECT_NE(broken_by("src/slicing/a.h", "#include \"reference/pyramid_caster.h\"\n"), "");
  EXPECT_NE(broken_by("src/mesh/mine/mine.h", "# include <audit/measures.h>\n"), "");
}

TEST(Walls, FallIfTheReferenceKnowsASubject) {
  EXPECT_NE(broken_by("src/reference/a.cpp", "#include \"raster/rasteriser.h\"\n"), "");
  EXPECT_NE(broken_by("src/reference/a.cpp", "#include \"mesh/full/full.h\"\n"), "");
  EXPECT_EQ(broken_by("src/reference/a.cpp", "#include \"terrain/heightfield.h\"\n"), "");
}

TEST(Walls, FallIfAMethodKnowsAnotherMethod) {
  EXPECT_NE(broken_by("src/mesh/mine/mine.h", "#include \"mesh/full/full.h\"\n"), "");
  EXPECT_EQ(broken_by("src/mesh/mine/mine.h", "#include \"mesh/mine/other.h\"\n"), "");
  EXPECT_EQ(broken_by("src/mesh/mine/mine.h", "#include \"mesh/patch_quadtree/patch.h\"\n"), "");
  EXPECT_NE(broken_by("src/mesh/mine/mine.h", "#include \"mesh/tessellation/a.h\"\n"), "");
}

TEST(Walls, FallIfAnEarlierStepKnowsALaterOne) {
  EXPECT_NE(broken_by("src/core/a.h", "#include \"terrain/heightfield.h\"\n"), "");
  EXPECT_NE(broken_by("src/report/a.h", "#include \"audit/audit.h\"\n"), "");
  EXPECT_NE(broken_by("src/terrain/a.h", "#include \"image/aov.h\"\n"), "");
}

TEST(Walls, FallIfAHeavyLibraryIsKnownElsewhere) {
  EXPECT_NE(broken_by("src/audit/a.cpp", "#include <embree3/rtcore.h>\n"), "");
  EXPECT_NE(broken_by("src/audit/a.h", "#include <embree4/rtcore.h>\n"), "");
  EXPECT_EQ(broken_by("src/reference/a.h", "#include <embree4/rtcore.h>\n"), "");
  EXPECT_NE(broken_by_listed("reference", "a.h", "#include <embree4/rtcore.h>\n"), "");
  EXPECT_EQ(broken_by("src/reference/a.cpp", "#include <embree3/rtcore.h>\n"), "");
  EXPECT_NE(broken_by("src/report/a.cpp", "#include <OpenImageIO/imageio.h>\n"), "");
  EXPECT_NE(broken_by("src/image/a.cpp", "#include <gdal_priv.h>\n"), "");
  EXPECT_NE(broken_by_listed("audit", "a.h", "#include <nlohmann/json.hpp>\n"), "");
  EXPECT_NE(broken_by("tools/plumb/a.h", "#include <CLI/CLI.hpp>\n"), "");
  EXPECT_NE(broken_by("tools/plumb/a.cpp", "#include <gdal.h>\n"), "");
  EXPECT_EQ(broken_by("src/audit/a.cpp", "#include <nlohmann/json.hpp>\n"), "");
}

TEST(Walls, StandForOurOwnHeadersOfALibrarysName) {
  EXPECT_EQ(broken_by("src/terrain/a.h", "#include \"terrain/gdal_reader.h\"\n"), "");
}

TEST(Walls, FallIfTheLibraryKnowsItsTools) {
  EXPECT_NE(broken_by("src/audit/a.cpp", "#include \"../tools/plumb/command.h\"\n"), "");
  EXPECT_NE(broken_by("src/audit/a.cpp", "#include \"tests/support/run_command.h\"\n"), "");
}

TEST(Walls, KnowEveryFolder) {
  EXPECT_EQ(broken_by("src/attic/a.h", "#pragma once\n"),
            "src/attic/a.h:1: no wall knows this folder\n");
}

}  // namespace
}  // namespace plumb::testing
