#include "audit/ply_file.h"

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "core/atomic_file.h"
#include "core/check.h"

namespace plumb::audit {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as memory has it");

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string ply_header(const TriangleMesh& mesh) {
  const glm::dvec3& origin = mesh.origin_m;
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment plumb\ncomment origin_m {} {} {}\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nproperty int patch\n"
      "property int lod\nend_header\n",
      origin.x, origin.y, origin.z, mesh.vertices_m.size(), mesh.triangles.size());
}

}  // namespace

void write_ply(const std::filesystem::path& path, const DrawnSurface& surface) {
  require(surface.mesh != nullptr, "a drawn surface must have a mesh");
  const TriangleMesh& mesh = *surface.mesh;
  TemporarySibling file(path);
  std::ofstream stream(file.path(), std::ios::binary);
  errno = 0;
  constexpr std::size_t kFlushBytes = std::size_t{1} << 20;
  std::string bytes = ply_header(mesh);
  const auto flush = [&](std::size_t at_least) {
    if (bytes.size() < at_least) return;
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.clear();
  };
  for (const glm::dvec3& vertex : mesh.vertices_m) {
    put(bytes, vertex.x);
    put(bytes, vertex.y);
    put(bytes, vertex.z);
    flush(kFlushBytes);
  }
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    put(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : mesh.triangles[k]) put(bytes, corner);
    const int patch = patch_of(surface, static_cast<std::uint32_t>(k));
    const int patch_lod =
        surface.patches.empty() ? 0 : surface.patches[static_cast<std::size_t>(patch)].lod;
    put(bytes, std::int32_t{patch});
    put(bytes, std::int32_t{surface.triangle_lod.empty() ? patch_lod : surface.triangle_lod[k]});
    flush(kFlushBytes);
  }
  flush(0);
  stream.close();
  if (!stream) {
    input_error("cannot write '{}': {}", path.string(),
                errno != 0 ? std::strerror(errno) : "writing failed");
  }
  file.commit();
}

}  // namespace plumb::audit
