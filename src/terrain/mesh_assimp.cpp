#include "terrain/mesh_assimp.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>

#include "core/check.h"

namespace plumb::terrain {
namespace {

using Matrix = aiMatrix4x4t<double>;

void add_reach(const Matrix& m, const glm::dvec3& farthest, AssimpPolygons& polygons) {
  for (unsigned row = 0; row < 3; ++row) {
    const double reach = std::abs(m[row][0]) * farthest.x + std::abs(m[row][1]) * farthest.y +
                         std::abs(m[row][2]) * farthest.z + std::abs(m[row][3]);
    polygons.largest_rounded_m = std::max(polygons.largest_rounded_m, reach);
  }
}

void add_mesh(const aiMesh& from, const Matrix& transform, const std::string& name,
              AssimpPolygons& polygons) {
  PolygonSoup& soup = polygons.soup;
  const std::uint64_t first = soup.vertices_m.size();
  if (first + from.mNumVertices > kMostVertices)
    input_error("{}: expected at most {} vertices", name, kMostVertices);
  glm::dvec3 farthest{0.0};
  for (unsigned v = 0; v < from.mNumVertices; ++v) {
    const aiVector3D& at = from.mVertices[v];
    const aiVector3t<double> p =
        transform * aiVector3t<double>(static_cast<double>(at.x), static_cast<double>(at.y),
                                       static_cast<double>(at.z));
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      input_error("{}: vertex {} is not finite", name, v);
    farthest = {std::max(farthest.x, std::abs(static_cast<double>(at.x))),
                std::max(farthest.y, std::abs(static_cast<double>(at.y))),
                std::max(farthest.z, std::abs(static_cast<double>(at.z)))};
    soup.vertices_m.emplace_back(p.x, p.y, p.z);
  }
  if (from.mNumVertices > 0) add_reach(transform, farthest, polygons);
  for (unsigned f = 0; f < from.mNumFaces; ++f) {
    const aiFace& face = from.mFaces[f];
    if (face.mNumIndices != 3) continue;  // points and lines
    for (unsigned c = 0; c < 3; ++c)
      soup.corners.push_back(static_cast<std::uint32_t>(first) + face.mIndices[c]);
    soup.sizes.push_back(3);
  }
}

void add_node(const aiScene& scene, const aiNode& node, const Matrix& above,
              const std::string& name, AssimpPolygons& polygons) {
  const Matrix transform = above * static_cast<Matrix>(node.mTransformation);
  for (unsigned m = 0; m < node.mNumMeshes; ++m)
    add_mesh(*scene.mMeshes[node.mMeshes[m]], transform, name, polygons);
  for (unsigned c = 0; c < node.mNumChildren; ++c)
    add_node(scene, *node.mChildren[c], transform, name, polygons);
}

}  // namespace

AssimpPolygons read_with_assimp(const std::string& path, const std::string& name) {
  Assimp::Importer importer;
  // Only positions matter.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_TEXCOORDS |
                                  aiComponent_MATERIALS);
  const aiScene* scene = importer.ReadFile(path, aiProcess_RemoveComponent | aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    input_error("{}: expected a PLY, OBJ, STL, glTF or GLB file: {}", name,
                importer.GetErrorString());
  }
  AssimpPolygons polygons;
  add_node(*scene, *scene->mRootNode, Matrix(), name, polygons);
  return polygons;
}

}  // namespace plumb::terrain
