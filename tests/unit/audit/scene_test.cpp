#include "audit/scene.h"

#include <gtest/gtest.h>

#include <limits>

#include "audit/scene_picture.h"
#include "audit/toml_document.h"
#include "core/check.h"
#include "image/camera_metadata.h"
#include "terrain/terrain_source.h"

namespace plumb::audit {
namespace {

constexpr const char* kWhole = R"(# every key
[terrain]
source = "dem/alps.tif"
window = [4, 5, 60, 70]
spacing = "30,25.5"
band = 2
decode = "terrain-rgb"
height_scale = 0.1
height_offset = -3
nodata = -32768
no_data = "fill"
crs = "EPSG:2056"
raw = "10x20"
byte_order = "big"
origin = [8.5, -46]
diagonal = "blocks:8"

[camera]
eye = [1, 2, 3]
target = [4, 5, 6.25]
width = 64

[method]
name = "restricted-quadtree"
variant = "conservative"
tolerance = "0.5px"

[method.parameters]
patch_cells = 32

[render]
what = "truth"
)";

constexpr const char* kSmall = R"([terrain]
source = "generate:alpine?size=33&seed=4"
[camera]
preset = "oblique"
width = 40
height = 30
[method]
name = "restricted-quadtree"
tolerance = "2px"
)";

std::string error_of(const std::string& text) {
  try {
    parse_scene(text, "s.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string with_line(const std::string& line) { return std::string(kSmall) + line + "\n"; }

TEST(Scene, GivesEveryValueThatItHolds) {
  const Scene scene = parse_scene(kWhole, "s.toml", "/data");
  EXPECT_EQ(scene.terrain, "/data/dem/alps.tif");
  EXPECT_EQ(scene.read.window, (terrain::Window{4, 5, 60, 70}));
  ASSERT_TRUE(scene.read.origin);
  EXPECT_EQ(scene.read.origin->longitude_deg, 8.5);
  EXPECT_EQ(scene.read.origin->latitude_deg, -46.0);
  EXPECT_EQ(scene.read.spacing_x_m, 30.0);
  EXPECT_EQ(scene.read.spacing_y_m, 25.5);
  EXPECT_EQ(scene.read.band, 2);
  EXPECT_EQ(scene.read.decode, terrain::Decode::TerrainRgb);
  EXPECT_EQ(scene.read.height_scale, 0.1);
  EXPECT_EQ(scene.read.height_offset_m, -3.0);
  EXPECT_EQ(scene.read.no_data, -32768.0);
  EXPECT_EQ(scene.read.no_data_policy, terrain::NoDataPolicy::Fill);
  EXPECT_EQ(scene.read.crs, "EPSG:2056");
  EXPECT_EQ(scene.read.raw_size, (terrain::RawSize{10, 20}));
  EXPECT_EQ(scene.read.byte_order, terrain::ByteOrder::Big);
  EXPECT_EQ(scene.diagonal, "blocks:8");
  EXPECT_EQ(scene.camera.target_m, glm::dvec3(4, 5, 6.25));
  EXPECT_EQ(scene.camera.width_px, 64);
  EXPECT_EQ(scene.method, "restricted-quadtree");
  EXPECT_EQ(scene.choice.variant, "conservative");
  EXPECT_EQ(scene.choice.parameters.at("patch_cells"), "32");
  EXPECT_EQ(scene.tolerance, (Tolerance{0.5, Unit::Pixel}));
  EXPECT_EQ(scene.painter, Painter::Truth);
}

TEST(Scene, IsTheSameOnceWrittenAndRead) {
  for (const char* text : {kWhole, kSmall}) {
    const Scene scene = parse_scene(text, "s.toml");
    const std::string written = to_toml(scene);
    const Scene again = parse_scene(written, "w.toml");
    EXPECT_EQ(to_toml(again), written);
    EXPECT_EQ(again.terrain, scene.terrain);
    EXPECT_EQ(again.camera, scene.camera);
    EXPECT_EQ(again.tolerance, scene.tolerance);
    EXPECT_EQ(again.choice.parameters, scene.choice.parameters);
    EXPECT_EQ(again.painter, scene.painter);
    EXPECT_EQ(again.read.height_scale, scene.read.height_scale);
    EXPECT_EQ(again.read.no_data, scene.read.no_data);
    EXPECT_EQ(again.read.spacing_y_m, scene.read.spacing_y_m);
  }
}

TEST(Scene, KeepsEveryBitOfANumberAndEveryLetterOfAText) {
  Scene scene = parse_scene(kSmall, "s.toml");
  scene.camera.preset = "";
  scene.camera.eye_m = glm::dvec3(0.1, 500000.0 + 1.0 / 3.0, -1e-300);
  scene.camera.target_m = glm::dvec3(1.0, 2.0, 4e6);
  scene.camera.far_m = std::numeric_limits<double>::infinity();
  scene.terrain = "a \"b\" \\ \t\n.tif";
  const Scene again = parse_scene(to_toml(scene), "w.toml");
  EXPECT_EQ(again.camera, scene.camera);
  EXPECT_EQ(again.terrain, scene.terrain);
}

TEST(Scene, LooksForFilesBesideIt) {
  const std::string text =
      "[terrain]\nsource = \"SOURCE\"\n[camera]\npreset = \"top\"\n[method]\nname = \"full\"\n";
  const auto source = [&](const std::string& name) {
    std::string with_name = text;
    with_name.replace(with_name.find("SOURCE"), 6, name);
    return parse_scene(with_name, "s.toml", "cases/a").terrain;
  };
  EXPECT_EQ(source("dem.tif"), "cases/a/dem.tif");
  EXPECT_EQ(source("../dem.tif"), "cases/dem.tif");
  EXPECT_EQ(source("/dem.tif"), "/dem.tif");
  EXPECT_EQ(source("generate:plane"), "generate:plane");
}

TEST(Scene, NamesTheKnownKeysForAnUnknownOne) {
  EXPECT_EQ(error_of(with_line("tolerence = \"1px\"")),
            "s.toml, line 10: method.tolerence: unknown key; a scene's method has name, variant, "
            "tolerance, parameters");
  EXPECT_EQ(error_of(with_line("[sky]\nblue = 1")),
            "s.toml, line 10: sky: unknown key; a scene has terrain, camera, method, render");
  EXPECT_NE(
      error_of("[terrain]\nsize = 3\n")
          .find("s.toml, line 2: terrain.size: unknown key; a scene's terrain has source, window"),
      std::string::npos);
  EXPECT_NE(error_of("[camera]\neyes = 3\n")
                .find("s.toml, line 2: camera.eyes: unknown key; a camera has eye"),
            std::string::npos);
}

TEST(Scene, SaysWhereAValueIsWrong) {
  EXPECT_EQ(error_of("[terrain]\nwindow = \"1,2\"\n")
                .rfind("s.toml, line 2: terrain.window: window '1,2'", 0),
            0u);
  EXPECT_EQ(error_of("[terrain]\nband = 0\n"),
            "s.toml, line 2: terrain.band: expected a whole number from 1 to 65535");
  EXPECT_EQ(error_of("[method]\ntolerance = 1\n")
                .rfind("s.toml, line 2: method.tolerance: tolerance '1'", 0),
            0u);
  EXPECT_EQ(error_of("[render]\nwhat = \"all\"\n"),
            "s.toml, line 2: render.what: expected \"method\" or \"truth\", got \"all\"");
  EXPECT_EQ(error_of("terrain = 3\n"), "s.toml, line 1: terrain: expected a table");
  EXPECT_EQ(error_of("[terrain\n").rfind("s.toml, line 1: ", 0), 0u);
}

TEST(Scene, SaysWhatIsMissing) {
  EXPECT_EQ(error_of(""), "s.toml: a scene needs a source in its [terrain]");
  EXPECT_EQ(error_of("[terrain]\nsource = \"generate:plane\"\n"),
            "s.toml: a scene needs a [camera]");
  EXPECT_NE(error_of("[terrain]\nsource = \"generate:plane\"\n[camera]\npreset = \"top\"\n")
                .find("a scene needs a name in its [method]"),
            std::string::npos);
  EXPECT_THROW(read_scene_file("/no/such/scene.toml"), InputError);
}

std::string text_in(const image::AovImage& picture, const std::string& name) {
  return std::get<std::string>(picture.metadata.at(name));
}

TEST(ScenePicture, IsMadeAgainFromItsOwnHeader) {
  for (const char* what : {"[render]\nwhat = \"truth\"", ""}) {
    const DrawnScene first =
        draw_scene(parse_scene(with_line(what), "s"), built_in_methods(), "1.2.3");
    const Scene scene = parse_scene(text_in(first.picture, "scene"), "header");
    const DrawnScene again = draw_scene(scene, built_in_methods(), "1.2.3");
    EXPECT_EQ(image::raw_checksum(again.picture), image::raw_checksum(first.picture));
    EXPECT_EQ(again.picture.metadata, first.picture.metadata);
    EXPECT_EQ(again.camera, first.camera);
  }
}

// A drawer that has drawn other cameras draws what a new one does.
TEST(ScenePicture, DoesNotDependOnWhatWasDrawnBefore) {
  for (const char* what : {"[render]\nwhat = \"truth\"", ""}) {
    const Scene scene = parse_scene(with_line(what), "s");
    SceneDrawer drawer(terrain::load_terrain(scene.terrain, scene.read), scene, built_in_methods(),
                       "1.2.3");
    for (const char* preset : {"top", "grazing", "valley", "top"}) {
      Scene alone = scene;
      alone.camera.preset = preset;
      const DrawnScene expected = draw_scene(alone, built_in_methods(), "1.2.3");
      const DrawnScene drawn = drawer.draw(alone.camera);
      EXPECT_EQ(image::raw_checksum(drawn.picture), image::raw_checksum(expected.picture));
      EXPECT_EQ(drawn.picture.metadata, expected.picture.metadata);
    }
  }
}

TEST(ScenePicture, SaysInItsHeaderHowItWasMade) {
  const DrawnScene drawn = draw_scene(parse_scene(kSmall, "s"), built_in_methods(), "1.2.3");
  EXPECT_EQ(text_in(drawn.picture, "method"), "restricted-quadtree");
  EXPECT_EQ(text_in(drawn.picture, "variant"), "conservative");
  EXPECT_EQ(text_in(drawn.picture, "tolerance"), "2px");
  EXPECT_EQ(text_in(drawn.picture, "diagonal"), "alternating");
  EXPECT_EQ(text_in(drawn.picture, "program"), "plumb 1.2.3");
  EXPECT_EQ(text_in(drawn.picture, "terrain.window"), "0,0,33,33");
  EXPECT_EQ(text_in(drawn.picture, "terrain.checksum"),
            fmt::format("{:016x}", terrain::checksum(*drawn.field)));
  EXPECT_EQ(image::camera_of(drawn.picture.metadata), drawn.camera);
}

TEST(ScenePicture, HasEveryChannel) {
  const DrawnScene drawn = draw_scene(parse_scene(kSmall, "s"), built_in_methods(), "1");
  for (const image::Channel& channel : image::channels())
    EXPECT_EQ((drawn.picture.*channel.values).size(), 1200u) << channel.name;
  EXPECT_EQ(drawn.hits.size(), 1200u);
  const DrawnScene truth = draw_scene(parse_scene(with_line("[render]\nwhat = \"truth\""), "s"),
                                      built_in_methods(), "1");
  EXPECT_TRUE(truth.picture.overdraw.empty());  // rays have no fragments
  EXPECT_EQ(truth.picture.nx.size(), 1200u);
  EXPECT_EQ(truth.surface.mesh, nullptr);
}

TEST(ScenePicture, RefusesWhatIsNotThere) {
  const auto error = [](const std::string& change, const std::string& to) {
    std::string text = kSmall;
    text.replace(text.find(change), change.size(), to);
    try {
      draw_scene(parse_scene(text, "s"), built_in_methods(), "1");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(
      error("restricted-quadtree", "quadtree").find("expected one of full, restricted-quadtree"),
      std::string::npos);
  EXPECT_NE(error("tolerance", "variant = \"published\"\ntolerance").find("no variant 'published'"),
            std::string::npos);
  EXPECT_NE(error("oblique", "sideways").find("sideways"), std::string::npos);
  EXPECT_NE(error("width = 40\nheight = 30", "width = 65536\nheight = 65536")
                .find("a picture of 65536 x 65536 pixels needs"),
            std::string::npos);
}

}  // namespace
}  // namespace plumb::audit
