// Formats that Assimp reads, in single precision, and what is said of that.
#include <fmt/format.h>

#include <cstring>

#include "terrain/mesh_file.h"
#include "written_files.h"

namespace plumb::terrain {
namespace {

class AssimpMesh : public testing::Test {
 protected:
  // A square of two facets, whose lower left corner lies at (x, 0).
  std::string stl(double x) {
    const auto facet = [&](const char* corners) {
      double dx[3], y[3];
      std::sscanf(corners, "%lf %lf %lf %lf %lf %lf", &dx[0], &y[0], &dx[1], &y[1], &dx[2], &y[2]);
      std::string text = "facet normal 0 0 1\nouter loop\n";
      for (int k = 0; k < 3; ++k) text += fmt::format("vertex {} {} 7\n", x + dx[k], y[k]);
      return text + "endloop\nendfacet\n";
    };
    const std::string file = folder_.file("a.stl");
    write_text(file, "solid a\n" + facet("0 0 2 0 2 2") + facet("0 0 2 2 0 2") + "endsolid a\n");
    return file;
  }
  // One triangle, (0 0 0), (2 0 0), (0 2 0) in its own coordinates, in a node that shifts it.
  std::string gltf(const std::string& node) {
    float points[9] = {0, 0, 0, 2, 0, 0, 0, 2, 0};
    std::vector<unsigned char> bytes(sizeof points);
    std::memcpy(bytes.data(), points, sizeof points);
    write_bytes(folder_.file("a.bin"), bytes);
    const std::string file = folder_.file("a.gltf");
    write_text(file,
               R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0)" +
                   node + R"(}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
 "max": [2, 2, 0]}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "a.bin"}]})");
    return file;
  }
  TemporaryFolder folder_;
};

TEST_F(AssimpMesh, SharesVerticesAtOnePlace) {
  const MeshFile file = read_mesh(stl(0.0));
  EXPECT_EQ(file.mesh.vertices_m,
            (std::vector<glm::dvec3>{{0, 0, 7}, {2, 0, 7}, {2, 2, 7}, {0, 2, 7}}));
  EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(file.warnings.empty());
}

// Floats from 2^22 to 2^23 lie half a metre apart, those below 2^15 at most 2 mm.
TEST_F(AssimpMesh, WarnsWhereSinglePrecisionMovesAVertexByMoreThanAMillimetre) {
  const MeshFile far = read_mesh(stl(4500000.25));
  EXPECT_EQ(far.largest_rounding_m, 0.25);
  ASSERT_EQ(far.warnings.size(), 1u);
  EXPECT_EQ(far.warnings, far.assumptions);
  EXPECT_NE(far.warnings[0].find("single precision"), std::string::npos);
  EXPECT_NE(far.warnings[0].find("rounded by up to 0.25 m"), std::string::npos) << far.warnings[0];
  const MeshFile near = read_mesh(stl(32765.0));
  EXPECT_EQ(near.largest_rounding_m, 0.0009765625);
  EXPECT_TRUE(near.warnings.empty());
  EXPECT_EQ(read_mesh(stl(32766.0)).warnings.size(), 1u);  // its right side lies at 2^15
}

// Rounded once, not with every coordinate: 4500000 + 2 is exact.
TEST_F(AssimpMesh, AppliesNodesInDouble) {
  const MeshFile file =
      read_mesh(gltf(R"(, "translation": [16777216, 0, 0], "scale": [1, 0.5, 1])"));
  EXPECT_EQ(file.mesh.vertices_m,
            (std::vector<glm::dvec3>{{16777216, 0, 0}, {16777218, 0, 0}, {16777216, 1, 0}}));
  EXPECT_EQ(file.largest_rounding_m, 1.0);  // of the shift
  EXPECT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(read_mesh(gltf("")).warnings.empty());
}

TEST_F(AssimpMesh, RefusesWhatIsNoMesh) {
  const std::string file = folder_.file("a.stl");
  write_text(file, "solid a\nendsolid a\n");
  EXPECT_NE(input_error_of([&] { read_mesh(file); }).find(file), std::string::npos);
  write_text(file, "no mesh");
  EXPECT_NE(input_error_of([&] { read_mesh(file); }).find("expected a PLY, OBJ, STL, glTF or GLB"),
            std::string::npos);
}

}  // namespace
}  // namespace plumb::terrain
