#include "audit/picture.h"

#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include "audit/ply_file.h"
#include "core/check.h"
#include "raster/shading/shade.h"
#include "reference/pyramid_caster.h"
#include "support/run_command.h"
#include "terrain/generators.h"
#include "terrain/mesh_file.h"

namespace plumb::audit {
namespace {

// Two triangles over the unit square's double, at height 7, seen from straight above: each pixel is
// one metre, the diagonal runs from south-west to north-east.
struct Square {
  terrain::Heightfield field;
  DrawnSurface surface;
  Camera camera;
  HitImage hits{2, 2};

  Square() {
    field.heights_m = Grid<float>(2, 2, 7.0f);
    field.dx_m = field.dy_m = 2.0;
    TriangleMesh mesh;
    mesh.vertices_m = {{0, 0, 7}, {2, 0, 7}, {2, 2, 7}, {0, 2, 7}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    surface.mesh = std::make_shared<const TriangleMesh>(mesh);
    surface.patches = {{0, 1, 3, "south-east"}, {1, 1, 5, "north-west"}};
    camera.eye_m = {1.0, 1.0, 17.0};
    camera.right = {1.0, 0.0, 0.0};
    camera.up = {0.0, 1.0, 0.0};
    camera.forward = {0.0, 0.0, -1.0};
    camera.width_px = camera.height_px = 2;
    camera.gamma_h = camera.gamma_v = 10.0;
    camera.centre_px = {1.0, 1.0};
    see(0, 1);
    see(3, 0);
    see(2, 0);  // the pixel at the top right, 1, sees nothing
  }
  void see(std::size_t pixel, std::uint32_t triangle) {
    hits.depth_m[pixel] = 10.0;
    hits.from_eye_m[pixel] = {pixel % 2 == 0 ? -0.5 : 0.5, pixel < 2 ? 0.5 : -0.5, -10.0};
    hits.primitive[pixel] = triangle;
  }
};

TEST(Picture, NamesPatchAndLevelOfEachPixel) {
  const Square square;
  const image::AovImage picture =
      draw_picture(square.field, square.hits, square.surface, square.camera, {});
  EXPECT_EQ(picture.id, (std::vector<float>{1, -1, 0, 0}));
  EXPECT_EQ(picture.lod, (std::vector<float>{5, -1, 3, 3}));
  EXPECT_EQ(picture.nz, (std::vector<float>{1, 0, 1, 1}));
  EXPECT_EQ(picture.z[0], 10.0f);
  EXPECT_TRUE(std::isinf(picture.z[1]));
  EXPECT_EQ(picture.px, (std::vector<float>{-0.5f, 0, -0.5f, 0.5f}));
}

TEST(Picture, TakesTheTrianglesOwnLevelWhereItHasOne) {
  Square square;
  square.surface.triangle_lod = {8, 9};
  const image::AovImage picture =
      draw_picture(square.field, square.hits, square.surface, square.camera, {});
  EXPECT_EQ(picture.lod, (std::vector<float>{9, -1, 8, 8}));
}

// The lowest tint of level ground, under a sky that is all the light there is from above.
TEST(Picture, ColoursByTheTerrainsOwnHeights) {
  Square square;
  square.field.heights_m.floats()(0, 0) = 5.0f;  // so that 7 is the highest
  const image::AovImage picture =
      draw_picture(square.field, square.hits, square.surface, square.camera, {});
  const glm::dvec3 top = raster::hypsometric_tint(1.0);
  // One factor of light for all three colours: their ratios are the tint's, to float's rounding.
  EXPECT_NEAR(picture.r[0] / picture.g[0], top.x / top.y, 1e-6);
  EXPECT_NEAR(picture.b[0] / picture.g[0], top.z / top.y, 1e-6);
}

TEST(Picture, OfTheTruthHasTheTrianglesNormals) {
  const terrain::Heightfield field =
      terrain::generate("generate:tilted-plane?size=9&slope_x=0.75&slope_y=0");
  const Square square;
  Camera camera = square.camera;
  camera.eye_m = {40.0, 40.0, 500.0};
  const reference::PyramidCaster caster(field, terrain::Diagonal::Fixed);
  PictureMaker maker;
  maker.method = "truth";
  maker.diagonal = terrain::Diagonal::Fixed;
  const image::AovImage picture =
      draw_truth_picture(field, caster.cast_frame(camera), camera, maker);
  // A rise of 3 over 4: the normal is (-3, 0, 4) / 5, to float's rounding.
  EXPECT_NEAR(picture.nx[0], -0.6f, 1e-6);
  EXPECT_NEAR(picture.ny[0], 0.0f, 1e-6);
  EXPECT_NEAR(picture.nz[0], 0.8f, 1e-6);
  EXPECT_EQ(picture.id[0], 0.0f);
  EXPECT_EQ(std::get<std::string>(picture.metadata.at("diagonal")), "fixed");
  EXPECT_FALSE(picture.metadata.contains("tolerance"));
}

TEST(Picture, RefusesHitsOnTrianglesThatAreNotThere) {
  Square square;
  square.hits.primitive[0] = 2;
  EXPECT_THROW(draw_picture(square.field, square.hits, square.surface, square.camera, {}),
               std::invalid_argument);
  EXPECT_THROW(draw_truth_picture(square.field, square.hits, square.camera, {}),
               std::invalid_argument);
  EXPECT_THROW(draw_picture(square.field, square.hits, {}, square.camera, {}),
               std::invalid_argument);
}

TEST(Preview, HasThePicturesColours) {
  const Square square;
  const image::AovImage picture =
      draw_picture(square.field, square.hits, square.surface, square.camera, {});
  EXPECT_EQ(preview_of(picture).g, picture.g);
  EXPECT_THROW(preview_of(image::AovImage()), std::invalid_argument);
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(PlyFile, HoldsTheMeshAndItsOrigin) {
  const testing::TemporaryFolder folder;
  Square square;
  TriangleMesh mesh = *square.surface.mesh;
  mesh.origin_m = {500000.1, 4500000.0, 0.0};
  square.surface.mesh = std::make_shared<const TriangleMesh>(mesh);
  write_ply(folder.file("a.ply"), square.surface);
  const std::string bytes = bytes_of(folder.file("a.ply"));
  const std::string end = "end_header\n";
  const std::size_t data = bytes.find(end) + end.size();
  EXPECT_NE(bytes.find("comment origin_m 500000.1 4500000 0\n"), std::string::npos);
  EXPECT_NE(bytes.find("element vertex 4\n"), std::string::npos);
  ASSERT_EQ(bytes.size() - data, 4u * 24u + 2u * (1u + 12u + 8u));
  double x = 0.0;
  std::memcpy(&x, bytes.data() + data + 24, 8);
  EXPECT_EQ(x, 2.0);  // of the second vertex
  std::int32_t patch = -1, lod = -1;
  std::memcpy(&patch, bytes.data() + bytes.size() - 8, 4);
  std::memcpy(&lod, bytes.data() + bytes.size() - 4, 4);
  EXPECT_EQ(patch, 1);
  EXPECT_EQ(lod, 5);
}

TEST(PlyFile, ReadsBackAsTheSameMesh) {
  const testing::TemporaryFolder folder;
  Square square;
  TriangleMesh mesh = *square.surface.mesh;
  mesh.origin_m = {500000.1, 4500000.0, 0.0};
  square.surface.mesh = std::make_shared<const TriangleMesh>(mesh);
  write_ply(folder.file("a.ply"), square.surface);
  const TriangleMesh read = terrain::read_mesh(folder.file("a.ply")).mesh;
  EXPECT_EQ(read.origin_m, mesh.origin_m);
  EXPECT_EQ(read.vertices_m, mesh.vertices_m);
  EXPECT_EQ(read.triangles, mesh.triangles);
}

// Another program's reader finds no fault with the header.
TEST(PlyFile, IsReadByAnotherProgramsReader) {
  const testing::TemporaryFolder folder;
  const Square square;
  write_ply(folder.file("a.ply"), square.surface);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(folder.file("a.ply"), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 1u);
  EXPECT_EQ(scene->mMeshes[0]->mNumFaces, 2u);
  EXPECT_EQ(scene->mMeshes[0]->mVertices[scene->mMeshes[0]->mFaces[1].mIndices[2]].y, 2.0f);
}

TEST(PlyFile, AppearsWholeOrNotAtAll) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(write_ply(folder.file("no/a.ply"), Square().surface), InputError);
  EXPECT_THROW(write_ply(folder.file("b.ply"), {}), std::invalid_argument);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace plumb::audit
