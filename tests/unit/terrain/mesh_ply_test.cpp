// PLY files, ascii and binary in either byte order, read in double.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "terrain/mesh_file.h"
#include "written_files.h"

namespace plumb::terrain {
namespace {

// Builds the bytes of a binary file.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <class T>
  Bytes& add(T value) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (big_endian_) std::reverse(bytes.begin(), bytes.end());
    text_.append(bytes.data(), sizeof(T));
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  bool big_endian_;
  std::string text_;
};

const std::string kDoubles = "property double x\nproperty double y\nproperty double z\n";
const std::string kFaces = "property list uchar int vertex_indices\n";

std::string header(const std::string& format, int vertices, int faces,
                   const std::string& of_vertex = kDoubles, const std::string& of_face = kFaces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) + "\n" +
         of_vertex + "element face " + std::to_string(faces) + "\n" + of_face + "end_header\n";
}

// The header without its first two lines.
std::string elements(const std::string& format, int vertices, int faces) {
  const std::string text = header(format, vertices, faces);
  return text.substr(text.find("element"));
}

const std::string kTriangle = "0 0 1\n2 0 1\n2 2 1\n3 0 1 2\n";

class PlyMesh : public testing::Test {
 protected:
  MeshFile read_file(const std::string& bytes, const MeshReadOptions& options = {}) {
    const std::string file = folder_.file("a.ply");
    write_text(file, bytes);
    return read_mesh(file, options);
  }
  TriangleMesh read(const std::string& bytes) { return read_file(bytes).mesh; }
  void refuses(const std::string& bytes, const std::string& words) {
    const std::string message = input_error_of([&] { read(bytes); });
    EXPECT_NE(message.find("mesh '" + folder_.file("a.ply") + "': "), std::string::npos) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
  TemporaryFolder folder_;
};

TEST_F(PlyMesh, KeepsEveryDigitOfADouble) {
  const glm::dvec3 p(500000.1, 4500000.123456789, 0.30000000000000004);
  EXPECT_EQ(read(header("ascii", 3, 1) +
                 "500000.1 4500000.123456789 0.30000000000000004\n1 2 3\n4 5 7\n3 0 1 2\n")
                .vertices_m[0],
            p);
  for (const bool big : {false, true}) {
    Bytes bytes(big);
    bytes.add(p.x).add(p.y).add(p.z);
    for (const double v : {1.0, 2.0, 3.0, 4.0, 5.0, 7.0}) bytes.add(v);
    bytes.add(std::uint8_t{3}).add(0).add(1).add(2);
    const MeshFile file =
        read_file(header(big ? "binary_big_endian" : "binary_little_endian", 3, 1) + bytes.text());
    EXPECT_EQ(file.mesh.vertices_m, (std::vector<glm::dvec3>{p, {1, 2, 3}, {4, 5, 7}}));
    EXPECT_EQ(file.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    EXPECT_TRUE(file.assumptions.empty());
  }
}

// One file with all eight types, x, y, z in another order, and lists and elements to skip before,
// between and behind.
TEST_F(PlyMesh, FindsItsWayAmongOtherPropertiesAndElements) {
  for (const bool big : {false, true}) {
    const std::string text =
        std::string("ply\r\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
        " 1.0\r\ncomment a stranger's\r\nobj_info 1\r\nelement camera 1\r\nproperty list uint8 "
        "float64 matrix\r\nproperty char c\r\nelement vertex 3\r\nproperty ushort z\r\nproperty "
        "list "
        "short int8 weights\r\nproperty int8 x\r\nproperty uchar red\r\nproperty float "
        "y\r\nelement "
        "face 2\r\nproperty float32 quality\r\nproperty list uint32 uint16 "
        "vertex_index\r\nproperty "
        "list uchar float texcoord\r\nelement edge 1\r\nproperty int vertex1\r\nend_header\r\n";
    Bytes bytes(big);
    bytes.add(std::uint8_t{2}).add(1.0).add(2.0).add(std::int8_t{1});
    const std::vector<std::array<int, 3>> points{{-1, 0, 60000}, {2, 0, 7}, {2, 2, 7}};
    for (const auto& p : points) {
      bytes.add(static_cast<std::uint16_t>(p[2])).add(std::int16_t{1}).add(std::int8_t{5});
      bytes.add(static_cast<std::int8_t>(p[0])).add(std::uint8_t{9});
      bytes.add(static_cast<float>(p[1]));
    }
    for (int face = 0; face < 2; ++face) {
      bytes.add(0.5f).add(std::uint32_t{3});
      for (const int corner : {2, 0, 1}) bytes.add(static_cast<std::uint16_t>(corner));
      bytes.add(std::uint8_t{1}).add(0.25f);
    }
    bytes.add(1);
    const TriangleMesh mesh = read(text + bytes.text());
    EXPECT_EQ(mesh.vertices_m, (std::vector<glm::dvec3>{{-1, 0, 60000}, {2, 0, 7}, {2, 2, 7}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{2, 0, 1}, {2, 0, 1}}));
  }
}

TEST_F(PlyMesh, SkipsTheSameInAscii) {
  const TriangleMesh mesh = read(
      "ply\nformat ascii 1.0\nelement camera 2\nproperty list uchar float m\nproperty int "
      "k\nelement "
      "face 1\nproperty list uchar float t\nproperty list int float64 vertex_index\nelement vertex "
      "3\nproperty uchar red\nproperty int z\nproperty short y\nproperty float x\nend_header\n"
      "2 0.5 0.25 1\n0 4\n\n1 0.5 3 0 1 2\n255 1 0 0\n255 1 0 2\n255 1 2 2\n");
  EXPECT_EQ(mesh.vertices_m, (std::vector<glm::dvec3>{{0, 0, 1}, {2, 0, 1}, {2, 2, 1}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST_F(PlyMesh, CutsPolygonsAndJoinsVerticesAtOnePlace) {
  const TriangleMesh mesh =
      read(header("ascii", 6, 3) +
           "0 0 1\n2 0 1\n2 2 1\n0 2 1\n2 2 1\n-0 0 1\n4 0 1 2 3\n3 5 4 3\n2 0 1\n");
  EXPECT_EQ(mesh.vertices_m.size(), 4u);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 2, 3}}));
}

TEST_F(PlyMesh, TakesTheOriginThatTheFileStates) {
  const std::string text = "ply\nformat ascii 1.0\ncomment origin_m 500000.1 4.5e6 -3\n" +
                           elements("ascii", 3, 1) + kTriangle;
  const MeshFile own = read_file(text);
  EXPECT_EQ(own.mesh.origin_m, glm::dvec3(500000.1, 4.5e6, -3.0));
  ASSERT_EQ(own.assumptions.size(), 1u);
  EXPECT_NE(own.assumptions[0].find("500000.1, 4500000, -3"), std::string::npos);
  EXPECT_TRUE(own.warnings.empty());
  const MeshFile given = read_file(text, {.origin_m = glm::dvec3(0.0)});
  EXPECT_EQ(given.mesh.origin_m, glm::dvec3(0.0));
  EXPECT_TRUE(given.assumptions.empty());
}

TEST_F(PlyMesh, RefusesAnOriginThatIsNoneUnlessAnotherIsGiven) {
  for (const char* origin : {"", " 1 2", " 1 2 x", " 1 2 nan", " 1 2 3 4"}) {
    const std::string text = std::string("ply\nformat ascii 1.0\ncomment origin_m") + origin +
                             "\n" + elements("ascii", 3, 1) + kTriangle;
    refuses(text, "expected three finite numbers after 'comment origin_m'");
    EXPECT_EQ(read_file(text, {.origin_m = glm::dvec3(1.0)}).mesh.origin_m, glm::dvec3(1.0));
  }
}

// Floats at 4,500,000 lie half a metre apart.
TEST_F(PlyMesh, WarnsOfFloatsThatAreFarFromZero) {
  const std::string floats = "property float x\nproperty double y\nproperty double z\n";
  const std::string far = "4500000 0 1\n4500002 0 1\n4500002 2 1\n3 0 1 2\n";
  const MeshFile file = read_file(header("ascii", 3, 1, floats) + far);
  EXPECT_EQ(file.largest_rounding_m, 0.25);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_EQ(file.warnings, file.assumptions);
  EXPECT_NE(file.warnings[0].find("4500002 m may be rounded by up to 0.25 m"), std::string::npos)
      << file.warnings[0];
  EXPECT_TRUE(read_file(header("ascii", 3, 1, kDoubles) + far).warnings.empty());
  EXPECT_TRUE(read_file(header("ascii", 3, 1, floats) + kTriangle).warnings.empty());
}

TEST_F(PlyMesh, IsKnownByItsFirstLineUnderAnyName) {
  write_text(folder_.file("mesh.txt"), header("ascii", 3, 1) + kTriangle);
  EXPECT_EQ(read_mesh(folder_.file("mesh.txt")).mesh.triangles.size(), 1u);
}

TEST_F(PlyMesh, NamesTheLineOfAHeaderThatItCannotRead) {
  const std::string start = "ply\nformat ascii 1.0\n";
  refuses("", "the file ends after line 0");
  refuses("plyx\n", "line 1: expected 'ply'");
  refuses("ply\nformat ascii 2.0\n", "line 2: expected 'format' with ascii");
  refuses("ply\nformat morse 1.0\n", "got 'morse' '1.0'");
  refuses(start + "element vertex\n", "line 3: expected 'element', a name and how many");
  refuses(start + "element vertex -3\n", "got 'vertex' '-3'");
  refuses(start + "element vertex 99999999999999999999999\n", "line 3");
  refuses(start + "property double x\n", "line 3: expected an element before its property");
  refuses(start + "element vertex 3\nproperty long x\n", "line 4: expected a type (char or int8");
  refuses(start + "element vertex 3\nproperty list float int x\n", "line 4: expected a list with");
  refuses(start + "element vertex 3\nproperty double\n", "line 4: expected 'property', a type");
  refuses(start + "vertices 3\n", "line 3: expected a line of a PLY header");
  refuses(start + "element vertex 3\n", "the file ends after line 3, expected a header");
  refuses(start + "element vertex 3\nend_header\n", "expected a property of element 'vertex'");
  refuses("ply\nend_header\n", "expected a line 'format'");
  refuses(start + std::string(100000, 'x'), "line 3 has more than 65536 bytes");
}

TEST_F(PlyMesh, SaysWhatTheHeaderLacks) {
  refuses("ply\nformat ascii 1.0\nend_header\n",
          "expected element 'vertex', which the header lacks");
  refuses(header("ascii", 0, 1), "expected element 'vertex', of which there is none");
  refuses(header("ascii", 3, 0) + "0 0 1\n2 0 1\n2 2 1\n", "expected element 'face', of which");
  refuses(header("ascii", 3, 1, "property double x\nproperty double y\n"),
          "expected properties x, y and z");
  refuses(header("ascii", 3, 1, kDoubles + "property float x\n"), "once each");
  refuses(header("ascii", 3, 1, kDoubles, "property int vertex_indices\n"),
          "expected a list 'vertex_indices'");
  refuses(header("ascii", 3, 1, kDoubles + "element vertex 1\nproperty int a\n"),
          "expected one element 'vertex'");
  refuses(header("ascii", 3, 1) + "0 0 1\n2 0 1\n2 2 1\n2 0 1\n",
          "expected triangles, there are none");
}

TEST_F(PlyMesh, NamesTheLineOfAsciiDataThatItCannotRead) {
  const std::string start = header("ascii", 3, 1);  // nine lines
  refuses(start + "0 0 1\n2 0\n2 2 1\n3 0 1 2\n", "line 11: expected a number, got the line's end");
  refuses(start + "0 0 1\n2 0 z\n2 2 1\n3 0 1 2\n", "line 11: expected a number, got 'z'");
  refuses(start + "0 0 1\n2 0 1 5\n2 2 1\n3 0 1 2\n", "line 11: expected the line's end, got '5'");
  refuses(start + "0 0 1\n2 0 nan\n2 2 1\n3 0 1 2\n",
          "line 11: vertex 1: expected finite coordinates");
  refuses(start + "0 0 1\n2 0 -inf\n2 2 1\n3 0 1 2\n", "line 11: vertex 1: expected finite");
  refuses(start + "0 0 1\n2 0 1\n2 2 1\n3 0 1 3\n",
          "line 13: face 0: expected indices of vertices, 0 to 2, got 3");
  refuses(start + "0 0 1\n2 0 1\n2 2 1\n3 0 1 -1\n", "line 13: face 0: expected indices");
  refuses(start + "0 0 1\n2 0 1\n2 2 1\n3 0 1 1.5\n", "got 1.5");
  refuses(start + "0 0 1\n2 0 1\n2 2 1\n3 0 1 nan\n", "got nan");
  refuses(start + "0 0 1\n2 0 1\n2 2 1\n-3 0 1 2\n",
          "line 13: list 'vertex_indices': expected a count, got -3");
  refuses(start + "0 0 1\n2 0 1\n2 2 1\n4000000000 0 1 2\n",
          "line 13: expected a number, got the line's end");
  refuses(start + "0 0 1\n2 0 1\n       \n  ",
          "the file ends after line 13, expected more elements");
}

TEST_F(PlyMesh, NamesTheByteOfBinaryDataThatItCannotRead) {
  const std::string start = header("binary_little_endian", 3, 1);
  const auto with = [&](double z, int corner, std::uint8_t count = 3) {
    Bytes bytes(false);
    for (const double v : {0.0, 0.0, 1.0, 2.0, 0.0, z, 2.0, 2.0, 1.0}) bytes.add(v);
    return start + bytes.add(count).add(0).add(1).add(corner).text();
  };
  EXPECT_EQ(read(with(1.0, 2)).triangles.size(), 1u);
  const std::string second = fmt::format("byte {}: vertex 1: expected finite", start.size() + 24);
  refuses(with(std::numeric_limits<double>::quiet_NaN(), 2), second);
  refuses(with(std::numeric_limits<double>::infinity(), 2), second);
  const std::string face = fmt::format("byte {}: face 0: expected indices", start.size() + 72);
  refuses(with(1.0, 3), face);
  refuses(with(1.0, -1), face);
  const std::string whole = with(1.0, 2);
  refuses(with(1.0, 2, 4), fmt::format("the file ends at byte {}, expected 4 bytes from byte {} on",
                                       whole.size(), whole.size()));
  for (std::size_t size = start.size(); size < whole.size(); ++size) {
    const std::string message = input_error_of([&] { read(whole.substr(0, size)); });
    EXPECT_NE(message.find(" byte"), std::string::npos) << message;
  }
}

// Memory for what such headers promise would be refused or exhaust the machine.
TEST_F(PlyMesh, BelievesNoHeaderThatPromisesMoreThanTheFileHolds) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const char* count : {"1000000000000000000", "18446744073709551615", "4000000000"}) {
      const std::string many = std::string("ply\nformat ") + format + " 1.0\nelement vertex ";
      refuses(many + count + "\n" + kDoubles + "element face 1\n" + kFaces + "end_header\n",
              "promises");
      refuses(many + "1\n" + kDoubles + "element face " + count + "\n" + kFaces + "end_header\n" +
                  (format[0] == 'a' ? "0 0 0\n" : std::string(24, '\0')),
              "promises");
      refuses(std::string("ply\nformat ") + format + " 1.0\nelement other " + count +
                  "\nproperty char c\n" + elements(format, 1, 1),
              "promises");
    }
  }
}

TEST_F(PlyMesh, SaysWhichFileIsNotThere) {
  const std::string file = folder_.file("none.ply");
  EXPECT_NE(input_error_of([&] { read_mesh(file); }).find("there is no such file"),
            std::string::npos);
}

}  // namespace
}  // namespace plumb::terrain
