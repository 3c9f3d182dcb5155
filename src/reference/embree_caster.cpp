#include "reference/embree_caster.h"

#include <algorithm>
#include <array>
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

// Decides about what the tree proposes for one packet of rays after the other.
template <class Triangles>
class Settler final : public RayVisitor {
 public:
  Settler(const Triangles& triangles, CastStatistics& statistics)
      : triangles_(triangles), statistics_(statistics) {}

  void settle(const BoxTree& tree, std::span<const Ray> rays, std::span<RayHit> hits) {
    rays_ = rays;
    hits_ = hits;
    frames_.clear();
    for (const Ray& ray : rays) frames_.emplace_back(ray);
    std::fill(hits.begin(), hits.end(), RayHit{});
    tree.visit_rays(rays, *this);
    statistics_.rays += static_cast<std::int64_t>(rays.size());
    for (const RayHit& hit : hits) statistics_.hits += hit ? 1 : 0;
  }

  double visit(std::uint32_t primitive, int number) override {
    const auto k = static_cast<std::size_t>(number);
    RayHit& best = hits_[k];
    const RayHit before = best;
    triangles_.meet(primitive, frames_[k], rays_[k].t_min, rays_[k].t_max, best, scratch_);
    ++statistics_.proposals;
    if (best == before) ++statistics_.refused;
    return std::min(best.t, rays_[k].t_max);
  }

 private:
  const Triangles& triangles_;
  CastStatistics& statistics_;
  std::span<const Ray> rays_;
  std::span<RayHit> hits_;
  std::vector<RayFrame> frames_;
  typename Triangles::Scratch scratch_;
};

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
  std::optional<Camera> seen_by;
  std::optional<HeightBlocks> blocks;  // one of these two
  std::optional<MeshTriangles> mesh;
  BoxTree tree;

  Scene(const terrain::Heightfield& field, terrain::Diagonal diagonal, const EmbreeOptions& options)
      : origin_m(valid(field).world_origin_m()),
        seen_by(options.seen_by),
        blocks(std::in_place, field, diagonal, options.seen_by),
        tree(tree_of(*blocks, options)) {}
  Scene(const TriangleMesh& triangles, const EmbreeOptions& options)
      : origin_m(triangles.origin_m), mesh(triangles), tree(tree_of(*mesh, options)) {
    require(!options.seen_by, "a mesh is held whole: seen_by is for heightfields");
  }

  void require_whole() const {
    require(!seen_by,
            "this caster holds what one camera sees: it casts that camera's frames alone");
  }

  // Calls with(settler), which casts packets.
  template <class With>
  void with_settler(CastStatistics& statistics, const With& with) const {
    if (blocks) {
      with(Settler<HeightBlocks>(*blocks, statistics));
    } else {
      with(Settler<MeshTriangles>(*mesh, statistics));
    }
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

RayHit EmbreeCaster::cast(const Ray& ray) const { return cast(std::span(&ray, 1)).front(); }

std::vector<RayHit> EmbreeCaster::cast(std::span<const Ray> rays) const {
  for (const Ray& ray : rays) require_castable(ray);
  scene_->require_whole();
  std::vector<RayHit> hits(rays.size());
  const std::size_t packets = (rays.size() + BoxTree::kPacket - 1) / BoxTree::kPacket;
  parallel_for(static_cast<std::int64_t>(packets), 16, [&](std::int64_t packet) {
    const std::size_t first = static_cast<std::size_t>(packet) * BoxTree::kPacket;
    const std::size_t count = std::min<std::size_t>(BoxTree::kPacket, rays.size() - first);
    CastStatistics unused;
    scene_->with_settler(unused, [&](auto settler) {
      settler.settle(scene_->tree, rays.subspan(first, count),
                     std::span(hits).subspan(first, count));
    });
  });
  return hits;
}

Ray EmbreeCaster::camera_ray(const Camera& camera, double x_px, double y_px) const {
  return {camera.eye_m - scene_->origin_m, ray_direction(camera, x_px, y_px), camera.near_m,
          camera.far_m};
}

namespace {

constexpr int kPacketSide = 4;  // pixels
static_assert(kPacketSide * kPacketSide == BoxTree::kPacket);

// Pixels of one packet, fewer at the image's right and lower border.
struct Packet {
  int x0, y0, columns, rows;
  int count() const { return columns * rows; }
};

Packet packet_at(const Camera& camera, int x0, int y0) {
  return {x0, y0, std::min(kPacketSide, camera.width_px - x0),
          std::min(kPacketSide, camera.height_px - y0)};
}

void write_hits(const Packet& packet, std::span<const Ray> rays, std::span<const RayHit> hits,
                HitImage& image) {
  for (int k = 0; k < packet.count(); ++k) {
    const RayHit& hit = hits[static_cast<std::size_t>(k)];
    if (!hit) continue;
    const std::size_t pixel =
        image.index(packet.x0 + k % packet.columns, packet.y0 + k / packet.columns);
    image.depth_m[pixel] = hit.t;
    image.from_eye_m[pixel] = hit.t * rays[static_cast<std::size_t>(k)].direction;
    image.primitive[pixel] = hit.triangle;
  }
}

}  // namespace

template <class Settler>
void EmbreeCaster::cast_tile(const Camera& camera, int x0, int y0, Settler& settler,
                             HitImage& image) const {
  std::array<Ray, BoxTree::kPacket> rays;
  std::array<RayHit, BoxTree::kPacket> hits;
  for (int y = y0; y < std::min(y0 + kTile, camera.height_px); y += kPacketSide) {
    for (int x = x0; x < std::min(x0 + kTile, camera.width_px); x += kPacketSide) {
      const Packet packet = packet_at(camera, x, y);
      const auto count = static_cast<std::size_t>(packet.count());
      for (int k = 0; k < packet.count(); ++k) {
        rays[static_cast<std::size_t>(k)] =
            camera_ray(camera, x + k % packet.columns + 0.5, y + k / packet.columns + 0.5);
      }
      const std::span<const Ray> cast_rays(rays.data(), count);
      const std::span<RayHit> found(hits.data(), count);
      settler.settle(scene_->tree, cast_rays, found);
      write_hits(packet, cast_rays, found, image);
    }
  }
}

HitImage EmbreeCaster::cast_frame(const Camera& camera, CastStatistics* statistics) const {
  require_castable(camera_ray(camera, 0.5, 0.5));
  require(!scene_->seen_by || *scene_->seen_by == camera,
          "this caster holds what another camera sees");
  HitImage image(camera.width_px, camera.height_px);
  const int tiles_x = (camera.width_px + kTile - 1) / kTile;
  const int tiles_y = (camera.height_px + kTile - 1) / kTile;
  std::vector<CastStatistics> of_tile(static_cast<std::size_t>(tiles_x) * tiles_y);
  parallel_for(static_cast<std::int64_t>(of_tile.size()), 1, [&](std::int64_t tile) {
    const int x0 = static_cast<int>(tile % tiles_x) * kTile;
    const int y0 = static_cast<int>(tile / tiles_x) * kTile;
    scene_->with_settler(of_tile[static_cast<std::size_t>(tile)],
                         [&](auto settler) { cast_tile(camera, x0, y0, settler, image); });
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
