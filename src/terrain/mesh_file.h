// Strangers' triangle meshes from files.
#pragma once

#include <glm/vec3.hpp>

#include <string>

#include "core/triangle_mesh.h"

namespace plumb::terrain {

enum class UpAxis { Z, Y };  // y-up: the file's (x, y, z) are east, up, south

struct MeshReadOptions {
  glm::dvec3 origin_m{0.0};  // added to every vertex: where the file's (0, 0, 0) lies in the
                             // terrain's world coordinates
  UpAxis up_axis = UpAxis::Z;
};

/// Reads PLY, OBJ, STL, glTF and GLB: all triangle meshes of the file, its nodes' transforms
/// applied, polygons cut into triangles, vertices at one place joined. Coordinates are metres and
/// single precision, as the reading library keeps them: for large coordinates store them relative
/// to an origin, and give that. Throws InputError with path and cause for anything that is not a
/// mesh of finite vertices.
TriangleMesh read_mesh(const std::string& path, const MeshReadOptions& options = {});

}  // namespace plumb::terrain
