#include "audit/sweep/scene.h"

#include <gtest/gtest.h>

#include "audit/scene.h"
#include "core/check.h"

namespace plumb::audit::sweep {
namespace {

SweepScene parse(const std::string& text) {
  return parse_sweep(text, "sweep.toml", built_in_methods(), "dem");
}

std::string error_of(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

constexpr const char* kSmall = R"(terrains = ["generate:alpine?size=9"]
methods = ["full"]
)";

TEST(SweepScene, NeedsTerrainsAndMethodsAlone) {
  const SweepScene scene = parse(kSmall);
  ASSERT_EQ(scene.methods.size(), 1u);
  EXPECT_EQ(scene.methods[0].variants, std::vector<std::string>{"conservative"});
  EXPECT_EQ(scene.methods[0].tolerances, (std::vector<Tolerance>{{1.0, Unit::Pixel}}));
  EXPECT_EQ(scene.methods[0].parameters.size(), 1u);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].frames[0].preset, "oblique");
  EXPECT_EQ(error_of("methods = [\"full\"]"), "sweep.toml: a sweep needs terrains = [...]");
  EXPECT_EQ(error_of("terrains = [\"generate:plane\"]"),
            "sweep.toml: a sweep needs methods = [...]");
}

TEST(SweepScene, NamesTerrainsAfterGeneratorsAndFiles) {
  const SweepScene scene = parse(R"(terrains = ["generate:step", "sub/alps.tif",
    { source = "generate:step?size=9", name = "wall", kind = "walls", diagonal = "fixed", window = [0, 0, 5, 5] }]
methods = ["full"])");
  ASSERT_EQ(scene.terrains.size(), 3u);
  EXPECT_EQ(scene.terrains[0].name, "step");
  EXPECT_EQ(scene.terrains[0].kind, "urban");
  EXPECT_EQ(scene.terrains[1].name, "alps");
  EXPECT_EQ(scene.terrains[1].kind, "alps");
  EXPECT_EQ(scene.terrains[1].source, "sub/alps.tif");
  EXPECT_EQ(scene.terrains[1].path, "dem/sub/alps.tif");
  EXPECT_EQ(scene.terrains[2].name, "wall");
  EXPECT_EQ(scene.terrains[2].kind, "walls");
  EXPECT_EQ(scene.terrains[2].diagonal, "fixed");
  EXPECT_EQ(scene.terrains[2].read.window->width, 5);
}

TEST(SweepScene, KnowsTheKindOfEveryGenerator) {
  const std::pair<const char*, const char*> kinds[] = {
      {"alpine", "alpine"}, {"canyon", "alpine"},       {"dunes", "smooth"},
      {"plane", "smooth"},  {"tilted-plane", "smooth"}, {"paraboloid", "smooth"},
      {"step", "urban"},    {"sinusoid", "smooth"},     {"spike", "urban"},
      {"urban", "urban"},   {"checkerboard", "urban"},  {"caves", "caves"}};
  for (const auto& [generator, kind] : kinds) {
    const std::string text =
        std::string("terrains = [\"generate:") + generator + "\"]\nmethods = [\"full\"]";
    EXPECT_EQ(parse(text).terrains[0].kind, kind) << generator;
  }
}

TEST(SweepScene, PutsTolerancesInPixelsBeforeThoseInMetres) {
  const SweepScene scene =
      parse(std::string(kSmall) + "tolerances_m = [5]\ntolerances_px = [2, 0.5]");
  EXPECT_EQ(scene.methods[0].tolerances,
            (std::vector<Tolerance>{{2.0, Unit::Pixel}, {0.5, Unit::Pixel}, {5.0, Unit::Metre}}));
}

TEST(SweepScene, GivesItsSizeToCamerasThatStateNone) {
  const SweepScene scene = parse(std::string(kSmall) + R"(width = 64
height = 36
cameras = ["top", { name = "mine", eye = [1, 2, 3], target = [4, 5, 6], width = 10 }])");
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.cameras[0].frames[0].width_px, 64);
  EXPECT_EQ(scene.cameras[1].frames[0].width_px, 10);
  EXPECT_EQ(scene.cameras[1].frames[0].height_px, 36);
  EXPECT_EQ(scene.cameras[1].name, "mine");
  EXPECT_FALSE(scene.cameras[1].is_path);
}

// What --camera takes for a table is the table.
TEST(SweepScene, WritesATableOfACameraAsOneLine) {
  const SweepScene scene = parse(std::string(kSmall) + R"(
cameras = [{ name = "mine", eye = [0.1, 2, 3], target = [4, 5, 6], near = 0.3, fov_y_deg = 33.3 }])");
  EXPECT_EQ(scene.cameras[0].argument,
            "{ eye = [0.1, 2.0, 3.0], target = [4.0, 5.0, 6.0], fov_y_deg = 33.3, near = 0.3 }");
  EXPECT_EQ(parse_inline_camera(scene.cameras[0].argument), scene.cameras[0].frames[0]);
}

TEST(SweepScene, RunsAMethodWithEachOfItsParameterSets) {
  const SweepScene one = parse(R"(terrains = ["generate:plane"]
methods = ["full", "slicing"]
[parameters.slicing]
leaf_cells = 4)");
  EXPECT_EQ(one.methods[0].parameters[0].size(), 0u);
  ASSERT_EQ(one.methods[1].parameters.size(), 1u);
  EXPECT_EQ(one.methods[1].parameters[0].at("leaf_cells"), "4");
  const SweepScene two = parse(R"(terrains = ["generate:plane"]
methods = ["slicing"]
[[parameters.slicing]]
[[parameters.slicing]]
leaf_cells = 4)");
  ASSERT_EQ(two.methods[0].parameters.size(), 2u);
  EXPECT_EQ(two.methods[0].parameters[0].size(), 0u);
}

TEST(SweepScene, LetsAMethodRunOtherLists) {
  const SweepScene scene = parse(R"(terrains = ["generate:plane", "generate:step"]
methods = ["full", "slicing"]
variants = ["published"]
tolerances_px = [1, 2]
[only.full]
terrains = ["step"]
variants = ["conservative"]
tolerances_px = [4])");
  EXPECT_EQ(scene.methods[0].terrains, std::vector<std::string>{"step"});
  EXPECT_EQ(scene.methods[0].variants, std::vector<std::string>{"conservative"});
  EXPECT_EQ(scene.methods[0].tolerances, (std::vector<Tolerance>{{4.0, Unit::Pixel}}));
  EXPECT_EQ(scene.methods[1].terrains, (std::vector<std::string>{"plane", "step"}));
  EXPECT_EQ(scene.methods[1].variants, std::vector<std::string>{"published"});
  EXPECT_EQ(scene.methods[1].tolerances.size(), 2u);
}

TEST(SweepScene, SaysWhatIsWrongAndWhere) {
  const std::string small = kSmall;  // two lines
  EXPECT_EQ(error_of(small + "tolerances = [1]"),
            "sweep.toml, line 3: tolerances: unknown key; a sweep has terrains, methods, variants, "
            "tolerances_px, tolerances_m, sizes_px, cameras, width, height, parameters, only");
  EXPECT_EQ(error_of(small + "tolerances_px = [1, -2]"),
            "sweep.toml, line 3: tolerances_px: expected numbers of at least zero, got -2");
  EXPECT_EQ(error_of(small + "tolerances_px = [1, 2, 1]"),
            "sweep.toml, line 3: tolerances_px: 1 stands in it twice");
  EXPECT_EQ(error_of(small + "tolerances_px = 1"),
            "sweep.toml, line 3: tolerances_px: expected a list of numbers, [..., ...]");
  EXPECT_EQ(error_of(small + "cameras = [{ eye = [1, 2, 3], target = [4, 5, 6] }]"),
            "sweep.toml, line 3: cameras: a camera of a sweep needs a name");
  EXPECT_EQ(error_of(small + "cameras = [\"oblique\", \"oblique\"]"),
            "sweep.toml, line 3: cameras: two cameras are called 'oblique': give one of them "
            "another name");
  EXPECT_EQ(error_of(small + "cameras = [\"obliq\"]"),
            "sweep.toml, line 3: cameras: 'dem/obliq' is neither a preset (oblique, top, grazing, "
            "valley, flyover, zoom) nor a file");
  EXPECT_EQ(error_of(small + "[parameters.full]\nsize = 3"),
            "sweep.toml, line 4: parameters.full.size: unknown key; method full has none");
  EXPECT_EQ(error_of(small + "[parameters.slicing]\nleaf_cells = 4"),
            "sweep.toml: parameters.slicing: the sweep does not run that method");
  EXPECT_EQ(error_of(small + "variants = [\"publishd\"]"),
            "sweep.toml: variants: no method has a variant 'publishd': there are conservative, "
            "published");
  EXPECT_EQ(error_of(small + "[only.full]\nterrains = [\"plain\"]"),
            "sweep.toml: only.full.terrains: no terrain is called 'plain'");
  EXPECT_EQ(error_of("terrains = [\"generate:plane\"]\nmethods = [\"ful\"]"),
            "sweep.toml, line 2: methods: method 'ful': expected one of full, restricted-quadtree, "
            "tessellation, chunked, stacks, slicing, hybrid-slicing");
  EXPECT_EQ(error_of("terrains = [\"generate:step\", \"generate:step?size=9\"]\nmethods = "
                     "[\"full\"]"),
            "sweep.toml, line 1: terrains: two terrains are called 'step': give one of them "
            "another name");
  EXPECT_EQ(
      error_of("terrains = [{ sorce = \"generate:plane\" }]\nmethods = [\"full\"]").substr(0, 80),
      "sweep.toml, line 1: terrains.sorce: unknown key; a sweep's terrain has name, kin");
}

}  // namespace
}  // namespace plumb::audit::sweep
