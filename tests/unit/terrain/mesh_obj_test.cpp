// Wavefront OBJ files, read in double.
#include <cmath>

#include "terrain/mesh_file.h"
#include "written_files.h"

namespace plumb::terrain {
namespace {

const std::string kSquare = "v 0 0 7\nv 2 0 7\nv 2 2 7\nv 0 2 7\n";

class ObjMesh : public testing::Test {
 protected:
  TriangleMesh read(const std::string& text) {
    const std::string file = folder_.file("a.obj");
    write_text(file, text);
    return read_mesh(file).mesh;
  }
  std::string error_of(const std::string& text) {
    const std::string message = input_error_of([&] { read(text); });
    EXPECT_NE(message.find("a.obj"), std::string::npos) << message;
    return message;
  }
  void refuses(const std::string& text, const std::string& words) {
    EXPECT_NE(error_of(text).find(words), std::string::npos) << error_of(text);
  }
  TemporaryFolder folder_;
};

// A float holds neither: 4500000.123456789 would become 4500000.
TEST_F(ObjMesh, KeepsEveryDigitOfADouble) {
  const TriangleMesh mesh = read(
      "v 500000.1 4500000.123456789 0.30000000000000004\nv +5e5 -1E-3 1e-400\nv 1 2 3\nf 1 2 3\n");
  ASSERT_EQ(mesh.vertices_m.size(), 3u);
  EXPECT_EQ(mesh.vertices_m[0], glm::dvec3(500000.1, 4500000.123456789, 0.30000000000000004));
  EXPECT_EQ(mesh.vertices_m[1], glm::dvec3(5e5, -1e-3, 0.0));
  EXPECT_EQ(mesh.origin_m, glm::dvec3(0.0));
}

TEST_F(ObjMesh, HasNoRoundingToWarnOf) {
  const std::string file = folder_.file("far.OBJ");
  write_text(file, "v 500000.1 4500000 0\nv 500001 4500000 0\nv 500001 4500001 0\nf 1 2 3\n");
  const MeshFile read = read_mesh(file);
  EXPECT_EQ(read.largest_rounding_m, 0.0);
  EXPECT_TRUE(read.assumptions.empty());
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_EQ(read.mesh.vertices_m[0].x, 500000.1);
}

TEST_F(ObjMesh, TakesTheFirstIndexOfEachKindOfCorner) {
  const std::vector<Triangle> expected{{0, 1, 2}};
  for (const char* face : {"f 1 2 3", "f 1/9 2/9 3/9", "f 1//9 2//9 3//9", "f 1/9/8 2/9/8 3/9/8",
                           "f -4 -3 -2", "f -4/1 2//3 -2/1/1", "  f\t1  2\t3  ", "f 1/ 2/ 3/"})
    EXPECT_EQ(read(kSquare + face + "\n").triangles, expected) << face;
}

TEST_F(ObjMesh, CountsNegativeIndicesBackFromTheFace) {
  const TriangleMesh mesh = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 1 -3\n");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 0, 1}}));
}

TEST_F(ObjMesh, MayNameVerticesThatComeLater) {
  EXPECT_EQ(read("f 1 2 3\n" + kSquare).triangles, (std::vector<Triangle>{{0, 1, 2}}));
  refuses("f 1 2 5\nf 1 2 7\n" + kSquare, "line 2: expected a vertex of the file, 1 to 4, got 7");
}

TEST_F(ObjMesh, ReadsCommentsContinuedLinesAndOtherLineEnds) {
  const std::vector<Triangle> expected{{0, 1, 2}};
  EXPECT_EQ(
      read("# C:\\mesh\\\nv 0 0 7 # first\\\nv 2 0 7\nv 2 \\\n2 \\\n7\nf 1 2 \\\n 3").triangles,
      expected);
  EXPECT_EQ(read("\xef\xbb\xbfv 0 0 7\r\nv 2 0 7\r\nv 2 \\\r\n2 7\r\n\r\nf 1 2 3\r\n").triangles,
            expected);
}

TEST_F(ObjMesh, IgnoresEverythingButVerticesAndFaces) {
  const TriangleMesh mesh = read(
      "mtllib a.mtl\no one\n" + kSquare +
      "vt 0 0\nvn 0 0 1\nvp 1\ng left\nusemtl red\ns 1\nf 1 2 3\ng right\nusemtl blue\nf 1 3 4\n"
      "l 1 2\np 1\n");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.vertices_m.size(), 4u);  // shared between the groups
}

TEST_F(ObjMesh, IgnoresColoursAndDividesByAWeight) {
  const TriangleMesh mesh =
      read("v 0 0 7 0.1 0.2 0.3\nv 4 0 14 2\nv 2 2 7 0.1 0.2 0.3 1\nf 1 2 3\n");
  EXPECT_EQ(mesh.vertices_m[1], glm::dvec3(2, 0, 7));
  EXPECT_EQ(mesh.vertices_m[2], glm::dvec3(2, 2, 7));
}

// Two triangles that name corners of their own share an edge all the same; a vertex of no face is
// left out.
TEST_F(ObjMesh, JoinsVerticesAtOnePlace) {
  const TriangleMesh mesh = read(
      "v 9 9 9\nv 0 0 7\nv 2 0 7\nv 2 2 7\nf 2 3 4\nv -0.0 0e0 7\nv 2 2 7\nv 0 2 7\nf 5 6 7\n");
  EXPECT_EQ(mesh.vertices_m, (std::vector<glm::dvec3>{{0, 0, 7}, {2, 0, 7}, {2, 2, 7}, {0, 2, 7}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

// A thousandth of a millimetre apart, far from zero: a float would see one place.
TEST_F(ObjMesh, KeepsVerticesThatLieCloseTogether) {
  EXPECT_EQ(read("v 500000 0 0\nv 500000.000001 0 0\nv 500001 1 0\nf 1 2 3\n").vertices_m.size(),
            3u);
}

TEST_F(ObjMesh, CutsPolygonsIntoTriangles) {
  EXPECT_EQ(read(kSquare + "f 1 2 3 4\n").triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(read(kSquare + "f 2 3 4 1\nf 1 2\nf 1\n").triangles,
            (std::vector<Triangle>{{1, 2, 3}, {1, 3, 0}}));
}

TEST_F(ObjMesh, TurnsTheUpwardAxis) {
  const std::string file = folder_.file("up.obj");
  write_text(file, "v 1 2 3\nv 4 5 0\nv 7 8 9\nf 1 2 3\n");
  const TriangleMesh mesh =
      read_mesh(file, {.origin_m = glm::dvec3(10, 20, 30), .up_axis = UpAxis::Y}).mesh;
  EXPECT_EQ(mesh.vertices_m[0], glm::dvec3(1, -3, 2));
  EXPECT_FALSE(std::signbit(mesh.vertices_m[1].y));
  EXPECT_EQ(mesh.origin_m, glm::dvec3(10, 20, 30));
}

TEST_F(ObjMesh, NamesTheLineOfWhatItCannotRead) {
  refuses("v 0 0\n", "line 1: expected three finite numbers after 'v', got the line's end");
  refuses("\nv 0 0 nan\n", "line 2: expected three finite numbers after 'v', got 'nan'");
  refuses("v inf 0 0\n", "line 1");
  refuses("v 0 1e999 0\n", "got '1e999'");
  refuses("v 0 1,5 0\n", "got '1,5'");
  refuses("v 0 0 \\\n# cut\n0x\n", "line 1");
  refuses("v 1 2 3 0\n", "line 1: expected as fourth number of a vertex a weight");
  refuses("v 1e308 2 3 1e-9\n", "weight");
  refuses(kSquare + "f 1 2 0\n", "line 5: expected corners of a face");
  refuses(kSquare + "f 1 2 x\n", "got 'x'");
  refuses(kSquare + "f 1 2 3.5\n", "got '3.5'");
  refuses(kSquare + "f 1 2 99999999999999999999\n", "line 5");
  refuses(kSquare + "f 1 2 4294967297\n", "line 5: expected a vertex");
  refuses(kSquare + "f 1 2 5\n", "line 5: expected a vertex of the file, 1 to 4, got 5");
  refuses(kSquare + "f 1 2 -5\n", "line 5: expected a vertex, -4 to -1 or 1 to 4, got -5");
}

TEST_F(ObjMesh, SaysWhatIsMissing) {
  refuses("", "expected lines 'v X Y Z', there are none");
  refuses("# nothing\n", "expected lines 'v X Y Z', there are none");
  refuses("f 1 2 3\n", "there are none");
  refuses(kSquare, "expected triangles, there are none");
  refuses(kSquare + "f 1 2\n", "expected triangles, there are none");
}

// What a message shows is one short line whatever the file holds.
TEST_F(ObjMesh, ShowsStrangeBytesAsQuestionMarks) {
  const std::string message = error_of("v 0 0 \x1b[31m\x01" + std::string(500, 'x') + "\n");
  EXPECT_NE(message.find("'?[31m?xxx"), std::string::npos) << message;
  EXPECT_LT(message.size(), 400u);
}

}  // namespace
}  // namespace plumb::terrain
