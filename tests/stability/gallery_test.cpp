// Every scene of the failure gallery, by what it states.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "audit/method.h"
#include "audit/stability/failure_scene.h"
#include "audit/stability/gallery_page.h"
#include "audit/stability/gallery_text.h"
#include "audit/stability/grounds.h"
#include "audit/stability/printed_quadtree.h"
#include "audit/stability/reading.h"
#include "audit/stability/run_scene.h"
#include "core/check.h"
#include "core/parallel.h"
#include "support/run_command.h"

namespace plumb::audit::stability {

struct SceneOfMethod {
  const Scene* scene;
  std::string method;
};

static void PrintTo(const SceneOfMethod& of, std::ostream* out) {
  *out << of.scene->name << ", " << of.method;
}

namespace {

std::vector<SceneOfMethod> all_scenes() {
  std::vector<SceneOfMethod> all;
  for (const Scene& scene : failure_scenes())
    for (const std::string& method : scene.methods) all.push_back({&scene, method});
  return all;
}

// Names of tests have no hyphens.
std::string test_name(const ::testing::TestParamInfo<SceneOfMethod>& info) {
  std::string name = info.param.scene->name + "_of_" + info.param.method;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class Gallery : public ::testing::TestWithParam<SceneOfMethod> {};

TEST_P(Gallery, IsAsStated) {
  const SceneRun run = run_scene(*GetParam().scene, GetParam().method);
  const auto check = [&](const std::optional<VariantRun>& variant,
                         const std::optional<Expected>& expected) {
    if (!variant) return;
    EXPECT_TRUE(variant->is_as_expected)
        << "expected " << expected_text(*run.scene, *expected) << "; "
        << measured_text(run, variant, expected) << ": " << variant->sentence << variant->refused;
    EXPECT_FALSE(variant->has_nan);
  };
  check(run.published, run.expected_published);
  check(run.conservative, run.expected_conservative);
  EXPECT_TRUE(run.published || run.conservative);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Gallery, ::testing::ValuesIn(all_scenes()), test_name);

TEST(GalleryTable, HasUniqueNamesAndKnownMethods) {
  std::set<std::string> names;
  for (const Scene& scene : failure_scenes()) {
    EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
    EXPECT_FALSE(scene.fails.empty()) << scene.name;
    for (const std::string& method : scene.methods)
      EXPECT_NO_THROW(find_method(built_in_methods(), method)) << scene.name;
  }
}

// A scene that says nothing of a variant would pass whatever is drawn.
TEST(GalleryTable, StatesSomethingOfEveryVariantThatThereIs) {
  for (const Scene& scene : failure_scenes()) {
    for (const std::string& name : scene.methods) {
      const Method& method = find_method(built_in_methods(), name);
      for (const std::string& variant : method.variants) {
        const auto& stated = variant == "published" ? scene.published : scene.conservative;
        EXPECT_TRUE(stated || scene.otherwise.contains(name)) << scene.name << ", " << name;
      }
    }
  }
}

std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The first line of `text` that is another in `other`; empty where there is none.
std::string first_difference(const std::string& text, const std::string& other) {
  std::istringstream lines(text), others(other);
  std::string line, its;
  while (std::getline(lines, line)) {
    if (!std::getline(others, its) || line != its) return line;
  }
  return std::getline(others, its) ? "and more: " + its : "";
}

// The page says what the program says: after a change `plumb stability -o FOLDER` makes it anew.
TEST(GalleryPage, OfTheDocsIsWhatTheProgramMakes) {
  std::vector<SceneRun> runs;
  for (const SceneOfMethod& of : all_scenes()) runs.push_back(run_scene(*of.scene, of.method));
  const std::string docs = PLUMB_SOURCE_DIR "/docs/";
  EXPECT_EQ(first_difference(gallery_markdown(runs), file_text(docs + "failures.md")), "");
  std::set<std::string> meant;
  for (const SceneRun& run : runs)
    if (!figure_name(run).empty()) meant.insert(figure_name(run));
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(docs + "figures/failures"))
    found.insert("figures/failures/" + entry.path().filename().string());
  EXPECT_EQ(found, meant);
}

SceneRun one(const std::string& name, bool with_pictures = false) {
  const Scene& scene = find_scene(name);
  return run_scene(scene, scene.methods.front(), with_pictures);
}

// Three panels of 160 x 120, 4 pixels between them, 22 below for two lines of 9 and what is around.
TEST(GalleryPage, HasThreePanelsWhereBothVariantsAreDrawn) {
  const image::Rgb8Image picture = scene_picture(one("spike-straight-down", true));
  EXPECT_EQ(picture.width_px, 3 * 160 + 2 * 4);
  EXPECT_EQ(picture.height_px, 120 + 22);
}

TEST(GalleryPage, IsWrittenWithTheFiguresThatItShows) {
  const testing::TemporaryFolder folder;
  write_gallery_page(folder.path(),
                     {one("spike-straight-down", true), one("infinite-height", true)});
  const std::string text = file_text(folder.path() / "failures.md");
  EXPECT_NE(text.find("(figures/failures/spike-straight-down.png)"), std::string::npos);
  EXPECT_NE(text.find("| infinite-height | full | - | - | refused |"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "figures/failures/spike-straight-down.png"));
  EXPECT_NE(file_text(folder.path() / "failures.html").find("2 of 2 scenes"), std::string::npos);
}

TEST(GalleryJson, HasTheSameBytesOnAnyNumberOfThreads) {
  const auto on = [](int threads) {
    const ThreadLimit limit(threads);
    return gallery_json({one("vertical-walls"), one("mixed-factors"), one("masks-back-to-back"),
                         one("holes-of-no-data")},
                        "plumb stability");
  };
  const std::string alone = on(1);
  EXPECT_EQ(alone, on(3));
  EXPECT_NE(alone.find("\"as_expected\": true"), std::string::npos);
}

// What is not as stated is found: the same scene with another word of it.
TEST(GalleryVerdict, IsFalseForAStatementThatIsNot) {
  Scene scene = find_scene("spike-straight-down");
  EXPECT_TRUE(run_scene(scene, "tessellation").is_as_expected());
  scene.published = breaks(Reading::SampleError, 6.0);  // it is 5.8 px
  EXPECT_FALSE(run_scene(scene, "tessellation").is_as_expected());
  scene.published = holds(Reading::SampleError);
  EXPECT_FALSE(run_scene(scene, "tessellation").is_as_expected());
  scene.published = refused("2 x 2 samples");
  EXPECT_FALSE(run_scene(scene, "tessellation").is_as_expected());
  scene.published = sound();
  EXPECT_TRUE(run_scene(scene, "tessellation").is_as_expected());
  scene.conservative = strays(Reading::SampleError, 0.5);  // it is 0
  EXPECT_FALSE(run_scene(scene, "tessellation").is_as_expected());
}

TEST(GalleryTable, RefusesAnUnknownSceneAndNamesTheKnownOnes) {
  try {
    find_scene("spike");
    FAIL() << "found";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("spike-straight-down"), std::string::npos);
  }
}

// A wall of 12 m over 4 m drawn as a plain at 4 m: 8 m, over the samples of the wall.
TEST(GalleryReading, OfTopsIsFromTheHighestSurfaceDrawn) {
  const terrain::Heightfield field =
      ground(5, 5, 1.0, [](int i, int) { return i == 2 ? 12.0 : 4.0; });
  DrawnSurface plain;
  plain.mesh = std::make_shared<const TriangleMesh>(
      TriangleMesh{{}, {{0, 0, 4}, {4, 0, 4}, {4, 4, 4}, {0, 4, 4}}, {{0, 1, 2}, {0, 2, 3}}});
  const HeightfieldTruth truth(field, terrain::Diagonal::Alternating);
  EXPECT_EQ(value_of(Reading::TopError, Unit::Pixel, truth, plain, {}, {}), 8.0);
}

// Of a patch as printed: a plane keeps every vertex at threshold 0, and two triangles above it.
TEST(PrintedQuadtree, DropsNothingOfAPlaneAtThresholdZeroAlone) {
  const terrain::Heightfield plane = ground(5, 5, 1.0, [](int i, int j) { return i + 2.0 * j; });
  EXPECT_EQ(printed_quadtree(plane, {0.0, Unit::Metre}).cost.triangles, 32);
  EXPECT_EQ(printed_quadtree(plane, {0.01, Unit::Metre}).cost.triangles, 2);
  EXPECT_EQ(printed_quadtree(plane, {0.0, Unit::Metre}, {.step = 2}).cost.triangles, 8);
}

TEST(PrintedQuadtree, RefusesOtherSizesVoidsAndUnits) {
  const auto flat = [](int, int) { return 0.0; };
  const Tolerance metre{1.0, Unit::Metre};
  EXPECT_THROW(printed_quadtree(ground(5, 4, 1.0, flat), metre), InputError);
  EXPECT_THROW(printed_quadtree(ground(6, 6, 1.0, flat), metre), InputError);
  EXPECT_THROW(printed_quadtree(ground(5, 5, 1.0, flat), {1.0, Unit::Pixel}), InputError);
  EXPECT_THROW(
      printed_quadtree(ground(5, 5, 1.0, [](int i, int) { return i == 1 ? NAN : 0.0; }), metre),
      InputError);
}

}  // namespace
}  // namespace plumb::audit::stability
