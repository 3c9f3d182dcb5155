#include "terrain/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>

#include "core/check.h"

namespace plumb::terrain {
namespace {

void add_mesh(const aiMesh& from, const aiMatrix4x4& transform, const MeshReadOptions& options,
              const std::string& path, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (unsigned v = 0; v < from.mNumVertices; ++v) {
    const aiVector3D p = transform * from.mVertices[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      input_error("mesh '{}': vertex {} is not finite", path, v);
    }
    mesh.vertices_m.push_back(options.up_axis == UpAxis::Z ? glm::dvec3(p.x, p.y, p.z)
                                                           : glm::dvec3(p.x, -p.z, p.y));
  }
  for (unsigned f = 0; f < from.mNumFaces; ++f) {
    const aiFace& face = from.mFaces[f];
    if (face.mNumIndices != 3) continue;  // points and lines
    mesh.triangles.push_back(
        {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

void add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above,
              const MeshReadOptions& options, const std::string& path, TriangleMesh& mesh) {
  const aiMatrix4x4 transform = above * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m)
    add_mesh(*scene.mMeshes[node.mMeshes[m]], transform, options, path, mesh);
  for (unsigned c = 0; c < node.mNumChildren; ++c)
    add_node(scene, *node.mChildren[c], transform, options, path, mesh);
}

}  // namespace

TriangleMesh read_mesh(const std::string& path, const MeshReadOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    input_error("mesh '{}': there is no such file", path);
  Assimp::Importer importer;
  // Only positions matter: without the rest, vertices at one place become one.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS |
                                  aiComponent_MATERIALS);
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    input_error("mesh '{}': expected a PLY, OBJ, STL, glTF or GLB file: {}", path,
                importer.GetErrorString());
  }
  TriangleMesh mesh;
  mesh.origin_m = options.origin_m;
  add_node(*scene, *scene->mRootNode, aiMatrix4x4(), options, path, mesh);
  if (mesh.triangles.empty()) input_error("mesh '{}': expected triangles, there are none", path);
  return mesh;
}

}  // namespace plumb::terrain
