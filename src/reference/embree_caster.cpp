#include "reference/embree_caster.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "reference/box_tree.h"
#include "reference/height_blocks.h"
#include "reference/mesh_triangles.h"
#include "reference/ray_triangle.h"

namespace plumb::reference {
namespace {

constexpr int kTile = 32;  // pixels along the side of a piece of work

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void require_castable(const Ray& ray) {
  require(finite(ray.origin_m) && finite(ray.direction),
          "a ray's origin and direction must be finite");
  require(ray.direction != glm::dvec3(0.0), "a ray's direction must not be zero");
  require(ray.t_min >= 0.0, "t_min must be >= 0, got {}", ray.t_min);
}

// Decides about what the tree proposes for one ray.
template <class Triangles>
class Settler final : public BoxVisitor {
 public:
  Settler(const Triangles& triangles, const Ray& ray)
      : triangles_(triangles), ray_(ray), frame_(ray) {}

  double visit(std::uint32_t primitive) override {
    const RayHit before = best_;
    triangles_.meet(primitive, frame_, ray_.t_min, ray_.t_max, best_);
    ++proposals_;
    if (best_ == before) ++refused_;
    return std::min(best_.t, ray_.t_max);
  }
  const RayHit& best() const { return best_; }
  void count(CastStatistics& statistics) const {
    ++statistics.rays;
    statistics.hits += best_ ? 1 : 0;
    statistics.proposals += proposals_;
    statistics.refused += refused_;
  }

 private:
  const Triangles& triangles_;
  const Ray& ray_;
  RayFrame frame_;
  RayHit best_;
  std::int64_t proposals_ = 0, refused_ = 0;
};

template <class Triangles>
RayHit settle(const Triangles& triangles, const BoxTree& tree, const Ray& ray,
              CastStatistics& statistics) {
  Settler<Triangles> settler(triangles, ray);
  tree.visit_ray(ray, settler);
  settler.count(statistics);
  return settler.best();
}

template <class Triangles>
BoxTree tree_of(const Triangles& triangles, const EmbreeOptions& options) {
  return BoxTree(
      triangles.count(), [&](std::uint32_t k) { return triangles.box(k); },
      options.instruction_set);
}

const terrain::Heightfield& valid(const terrain::Heightfield& field) {
  terrain::require_valid(field);
  return field;
}

}  // namespace

struct EmbreeCaster::Scene {
  glm::dvec3 origin_m;
  std::optional<HeightBlocks> blocks;  // one of these two
  std::optional<MeshTriangles> mesh;
  BoxTree tree;

  Scene(const terrain::Heightfield& field, terrain::Diagonal diagonal, const EmbreeOptions& options)
      : origin_m(valid(field).world_origin_m()),
        blocks(std::in_place, field, diagonal),
        tree(tree_of(*blocks, options)) {}
  Scene(const TriangleMesh& triangles, const EmbreeOptions& options)
      : origin_m(triangles.origin_m), mesh(triangles), tree(tree_of(*mesh, options)) {}

  RayHit cast(const Ray& ray, CastStatistics& statistics) const {
    return blocks ? settle(*blocks, tree, ray, statistics) : settle(*mesh, tree, ray, statistics);
  }
};

EmbreeCaster::EmbreeCaster(const terrain::Heightfield& field, terrain::Diagonal diagonal,
                           const EmbreeOptions& options)
    : scene_(std::make_unique<Scene>(field, diagonal, options)) {}
EmbreeCaster::EmbreeCaster(const TriangleMesh& mesh, const EmbreeOptions& options)
    : scene_(std::make_unique<Scene>(mesh, options)) {}
EmbreeCaster::~EmbreeCaster() = default;
EmbreeCaster::EmbreeCaster(EmbreeCaster&&) noexcept = default;
EmbreeCaster& EmbreeCaster::operator=(EmbreeCaster&&) noexcept = default;

RayHit EmbreeCaster::cast(const Ray& ray) const {
  require_castable(ray);
  CastStatistics unused;
  return scene_->cast(ray, unused);
}

std::vector<RayHit> EmbreeCaster::cast(std::span<const Ray> rays) const {
  for (const Ray& ray : rays) require_castable(ray);
  std::vector<RayHit> hits(rays.size());
  parallel_for(static_cast<std::int64_t>(rays.size()), 256, [&](std::int64_t k) {
    CastStatistics unused;
    hits[static_cast<std::size_t>(k)] = scene_->cast(rays[static_cast<std::size_t>(k)], unused);
  });
  return hits;
}

Ray EmbreeCaster::camera_ray(const Camera& camera, double x_px, double y_px) const {
  return {camera.eye_m - scene_->origin_m, ray_direction(camera, x_px, y_px), camera.near_m,
          camera.far_m};
}

HitImage EmbreeCaster::cast_frame(const Camera& camera, CastStatistics* statistics) const {
  require_castable(camera_ray(camera, 0.5, 0.5));
  HitImage image(camera.width_px, camera.height_px);
  const int tiles_x = (camera.width_px + kTile - 1) / kTile;
  const int tiles_y = (camera.height_px + kTile - 1) / kTile;
  std::vector<CastStatistics> of_tile(static_cast<std::size_t>(tiles_x) * tiles_y);
  parallel_for(static_cast<std::int64_t>(of_tile.size()), 1, [&](std::int64_t tile) {
    CastStatistics& sum = of_tile[static_cast<std::size_t>(tile)];
    const int x0 = static_cast<int>(tile % tiles_x) * kTile;
    const int y0 = static_cast<int>(tile / tiles_x) * kTile;
    for (int y = y0; y < std::min(y0 + kTile, camera.height_px); ++y) {
      for (int x = x0; x < std::min(x0 + kTile, camera.width_px); ++x) {
        const Ray ray = camera_ray(camera, x + 0.5, y + 0.5);
        const RayHit hit = scene_->cast(ray, sum);
        if (!hit) continue;
        const std::size_t pixel = image.index(x, y);
        image.depth_m[pixel] = hit.t;
        image.from_eye_m[pixel] = hit.t * ray.direction;
        image.primitive[pixel] = hit.triangle;
      }
    }
  });
  if (statistics) {
    *statistics = {};
    for (const CastStatistics& tile : of_tile) {
      statistics->rays += tile.rays;
      statistics->hits += tile.hits;
      statistics->proposals += tile.proposals;
      statistics->refused += tile.refused;
    }
  }
  return image;
}

}  // namespace plumb::reference
