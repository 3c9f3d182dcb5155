// Strangers' triangle meshes from files.
#pragma once

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "terrain/heightfield.h"

namespace plumb::terrain {

enum class UpAxis { Z, Y };  // y-up: the file's (x, y, z) are east, up, south

struct MeshReadOptions {
  /// Added to every vertex: where the file's (0, 0, 0) lies in the terrain's world coordinates.
  /// Nothing: what a PLY file's "comment origin_m X Y Z" says, else zero.
  std::optional<glm::dvec3> origin_m;
  UpAxis up_axis = UpAxis::Z;
  double metres_per_unit = 1.0;  // of the file's coordinates, not of an origin that it states; > 0
};

/// A mesh, and what was taken for granted when it was read.
struct MeshFile {
  TriangleMesh mesh;
  /// Half a unit in the last place of single precision at the largest coordinate, where the file
  /// or its reader keeps no more; else zero.
  double largest_rounding_m = 0.0;
  std::vector<std::string> assumptions;  // one sentence each, the warnings among them
  std::vector<std::string> warnings;     // those that may spoil what is measured
};

/// Roundings up to this many metres are not worth a warning.
inline constexpr double kUnnoticedRounding_m = 1e-3;

/// Reads PLY, OBJ, STL, glTF and GLB: all triangle meshes of the file, its nodes' transforms
/// applied, polygons cut into triangles, vertices at one place joined.
///
///   (1) PLY (known by its first line or its name) and OBJ (by its name) are read in double.
///   (2) Assimp reads the rest, and keeps single precision: beyond kUnnoticedRounding_m that is an
///       assumption and a warning, as it is for a PLY file whose coordinates are floats.
/// Throws InputError with path, line or byte, and cause for anything that is not a mesh of finite
/// vertices, and std::invalid_argument for a unit that is not positive.
MeshFile read_mesh(const std::string& path, const MeshReadOptions& options = {});

/// One sentence with both boxes if mesh and terrain, seen from above, have less than a hundredth of
/// the smaller one's area in common: the mesh's place, unit or upward axis is another. Else
/// nothing.
std::optional<std::string> misplacement(const TriangleMesh& mesh, const Heightfield& field);

/// Makes the mesh's vertices relative to the terrain's origin, if they are not.
///
///   (1) A vertex whose x is that of a column of samples but for the rounding of large numbers in
///       double (kPlaceRoundings times 2^-52 of its coordinate in the file, or of the shift if that
///       is more) has exactly the column's x afterwards; so with y and rows. Else a vertex at the
///       rim could lie inside it by 1e-10 m and leave the rim's samples bare.
///   (2) A mesh that has the terrain's origin is left as it is.
void move_to_origin_of(const Heightfield& field, TriangleMesh& mesh);

/// With M the larger of the file's number and the shift: the multiple of the spacing that the
/// writer rounded is off by at most 2^-52 M, his sum by half of that, the shifted number here and
/// the multiple here by 2^-52 M each; 3.5 in all.
inline constexpr double kPlaceRoundings = 4.0;

}  // namespace plumb::terrain
