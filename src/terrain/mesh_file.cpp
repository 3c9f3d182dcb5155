#include "terrain/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>

#include "core/check.h"
#include "terrain/forward_file.h"
#include "terrain/mesh_assimp.h"
#include "terrain/mesh_obj.h"
#include "terrain/mesh_ply.h"
#include "terrain/ply_header.h"
#include "terrain/polygon_soup.h"

namespace plumb::terrain {
namespace {

enum class Format { Ply, Obj, Other };

Format format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::string first_line(4, ' ');
  std::ifstream(path, std::ios::binary).read(first_line.data(), 4);
  if (first_line == "ply\n" || first_line == "ply\r" || extension == ".ply") return Format::Ply;
  return extension == ".obj" ? Format::Obj : Format::Other;
}

// How far rounding to 24 binary digits may move a number of this size.
double half_ulp_of_single(double value) {
  int exponent = 0;
  std::frexp(value, &exponent);  // value < 2^exponent
  return value == 0.0 ? 0.0 : std::ldexp(1.0, exponent - 25);
}

double largest_coordinate_m(const PolygonSoup& soup) {
  double largest = 0.0;
  for (const glm::dvec3& p : soup.vertices_m)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

void note_rounding(double largest, const char* who, double metres_per_unit, MeshFile& file) {
  const double largest_m = largest * metres_per_unit;
  file.largest_rounding_m = half_ulp_of_single(largest) * metres_per_unit;
  if (file.largest_rounding_m <= kUnnoticedRounding_m) return;
  const std::string line = fmt::format(
      "{} single precision: coordinates of up to {:.10g} m may be rounded by up to {:.3g} m; write "
      "them relative to an origin (--offset), or in double as PLY or OBJ",
      who, largest_m, file.largest_rounding_m);
  file.assumptions.push_back(line);
  file.warnings.push_back(line);
}

void take_own_origin(const std::string& text, const std::string& name, MeshFile& file) {
  const auto origin_m = ply_origin_m(text);
  if (!origin_m)
    input_error(
        "{}: expected three finite numbers after 'comment origin_m' (or --offset in its "
        "place)",
        name);
  file.mesh.origin_m = *origin_m;
  file.assumptions.push_back(
      fmt::format("the mesh's origin is the one that its file states: {}, {}, {} m", origin_m->x,
                  origin_m->y, origin_m->z));
}

PolygonSoup read_polygons(const std::string& path, const std::string& name, double metres_per_unit,
                          MeshFile& file, std::optional<std::string>& own_origin) {
  const Format format = format_of(path);
  ForwardFile input(path, name);
  if (format == Format::Obj) return read_obj(input);
  if (format == Format::Ply) {
    PlyPolygons polygons = read_ply(input);
    own_origin = std::move(polygons.origin_m);
    if (polygons.single_precision)
      note_rounding(largest_coordinate_m(polygons.soup), "the mesh's file keeps", metres_per_unit,
                    file);
    return std::move(polygons.soup);
  }
  AssimpPolygons polygons = read_with_assimp(path, name);
  note_rounding(polygons.largest_rounded_m, "a mesh of this format is read in", metres_per_unit,
                file);
  return std::move(polygons.soup);
}

}  // namespace

MeshFile read_mesh(const std::string& path, const MeshReadOptions& options) {
  require(options.metres_per_unit > 0.0 && std::isfinite(options.metres_per_unit),
          "a mesh's unit must be positive, got {}", options.metres_per_unit);
  const std::string name = fmt::format("mesh '{}'", path);
  MeshFile file;
  std::optional<std::string> own_origin;
  PolygonSoup soup = read_polygons(path, name, options.metres_per_unit, file, own_origin);
  TriangleMesh mesh = joined_mesh(std::move(soup), name);
  if (mesh.triangles.empty()) input_error("{}: expected triangles, there are none", name);
  file.mesh = std::move(mesh);
  if (options.up_axis == UpAxis::Y) {
    for (glm::dvec3& p : file.mesh.vertices_m) p = {p.x, 0.0 - p.z, p.y};
  }
  if (options.metres_per_unit != 1.0) {
    for (glm::dvec3& p : file.mesh.vertices_m) p *= options.metres_per_unit;
  }
  if (options.origin_m) {
    file.mesh.origin_m = *options.origin_m;
  } else if (own_origin) {
    take_own_origin(*own_origin, name, file);
  }
  return file;
}

}  // namespace plumb::terrain
