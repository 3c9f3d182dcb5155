#include "core/mesh_runs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb {
namespace {

constexpr std::int64_t kGrain = 64;  // runs a task takes

struct Run {
  Box box;
  std::vector<std::uint32_t> chunks;
};

Run run_of(const TriangleMesh& mesh, std::size_t run) {
  const std::size_t first = run * MeshRuns::kTriangles,
                    last = std::min(first + MeshRuns::kTriangles, mesh.triangles.size());
  Run result;
  for (std::size_t t = first; t < last; ++t) {
    for (const std::uint32_t corner : mesh.triangles[t]) {
      require(corner < mesh.vertices_m.size(),
              "a triangle names a vertex that the mesh does not have: {} of {}", corner,
              mesh.vertices_m.size());
      const glm::dvec3& v = mesh.vertices_m[corner];
      require(std::isfinite(v.x + v.y + v.z), "a mesh's vertices must be finite");
      result.box.add(v);
      const std::uint32_t chunk = corner / MeshRuns::kVertices;
      if (result.chunks.empty() || result.chunks.back() != chunk) result.chunks.push_back(chunk);
    }
  }
  std::sort(result.chunks.begin(), result.chunks.end());
  result.chunks.erase(std::unique(result.chunks.begin(), result.chunks.end()), result.chunks.end());
  return result;
}

}  // namespace

MeshRuns::MeshRuns(std::shared_ptr<const TriangleMesh> mesh)
    : mesh_(std::move(mesh)),
      boxes_((mesh_->triangles.size() + kTriangles - 1) / kTriangles),
      first_chunk_(boxes_.size() + 1, 0) {
  std::vector<std::vector<std::uint32_t>> chunks(boxes_.size());
  parallel_for(static_cast<std::int64_t>(boxes_.size()), kGrain, [&](std::int64_t k) {
    const auto run = static_cast<std::size_t>(k);
    Run found = run_of(*mesh_, run);
    boxes_[run] = found.box;
    first_chunk_[run + 1] = found.chunks.size();
    chunks[run] = {found.chunks.begin(), found.chunks.end()};  // no larger than it need be
  });
  std::partial_sum(first_chunk_.begin(), first_chunk_.end(), first_chunk_.begin());
  chunks_.resize(first_chunk_.back());
  for (std::size_t run = 0; run < chunks.size(); ++run) {
    std::copy(chunks[run].begin(), chunks[run].end(),
              chunks_.begin() + static_cast<std::ptrdiff_t>(first_chunk_[run]));
  }
}

std::vector<std::uint8_t> MeshRuns::in_view(const Camera& camera) const {
  std::vector<std::uint8_t> seen(boxes_.size());
  const Camera local = relative_to(camera, mesh_->origin_m);
  parallel_for(static_cast<std::int64_t>(boxes_.size()), kGrain, [&](std::int64_t k) {
    const auto run = static_cast<std::size_t>(k);
    seen[run] = may_be_in_view(local, boxes_[run]) ? 1 : 0;
  });
  return seen;
}

}  // namespace plumb
