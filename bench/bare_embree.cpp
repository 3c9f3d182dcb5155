#include "bare_embree.h"

#include <limits>

#include "bench_support.h"

namespace plumb::bench {
namespace {

bool count_bytes(void* user, std::ptrdiff_t bytes, bool /*post*/) {
  *static_cast<std::atomic<std::int64_t>*>(user) += bytes;
  return true;
}

}  // namespace

BareEmbree::BareEmbree(const terrain::Heightfield& field, const glm::dvec3& from_m)
    : device_(rtcNewDevice("")), scene_(nullptr) {
  rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  const int columns = field.columns(), rows = field.rows();
  const std::size_t vertices = field.heights_m.size();
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
  const glm::dvec3 from = from_m - field.world_origin_m();
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      *vertex++ = static_cast<float>(i * field.dx_m - from.x);
      *vertex++ = static_cast<float>(j * field.dy_m - from.y);
      *vertex++ = static_cast<float>(static_cast<double>(field.heights_m(i, j)) - from.z);
    }
  }
  auto* corner = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), static_cast<std::size_t>(triangles_of(field))));
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const auto sw =
          static_cast<unsigned>(j) * static_cast<unsigned>(columns) + static_cast<unsigned>(i);
      const unsigned se = sw + 1, nw = sw + static_cast<unsigned>(columns), ne = nw + 1;
      const bool rising = rises_north_east(terrain::Diagonal::Alternating, i, j);
      for (const unsigned c : {sw, se, rising ? ne : nw, rising ? sw : se, ne, nw}) *corner++ = c;
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  const double before = user_seconds();
  rtcCommitScene(scene_);
  build_user_s_ = user_seconds() - before;
}

BareEmbree::~BareEmbree() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

std::int64_t BareEmbree::cast_single(const Camera& camera) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  std::int64_t hits = 0;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const glm::dvec3 d = ray_direction(camera, x + 0.5, y + 0.5);
      RTCRayHit ray{};
      ray.ray.dir_x = static_cast<float>(d.x);
      ray.ray.dir_y = static_cast<float>(d.y);
      ray.ray.dir_z = static_cast<float>(d.z);
      ray.ray.tnear = static_cast<float>(camera.near_m);
      ray.ray.tfar = std::numeric_limits<float>::infinity();
      ray.ray.mask = 0xffffffffu;
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &ray);
      hits += ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
  }
  return hits;
}

std::int64_t BareEmbree::cast_packets(const Camera& camera) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  std::int64_t hits = 0;
  alignas(64) int valid[16];
  alignas(64) RTCRayHit16 rays{};
  for (int y0 = 0; y0 < camera.height_px; y0 += 4) {
    for (int x0 = 0; x0 < camera.width_px; x0 += 4) {
      for (int k = 0; k < 16; ++k) {
        const int x = x0 + k % 4, y = y0 + k / 4;
        valid[k] = x < camera.width_px && y < camera.height_px ? -1 : 0;
        const glm::dvec3 d = ray_direction(camera, x + 0.5, y + 0.5);
        rays.ray.dir_x[k] = static_cast<float>(d.x);
        rays.ray.dir_y[k] = static_cast<float>(d.y);
        rays.ray.dir_z[k] = static_cast<float>(d.z);
        rays.ray.tnear[k] = static_cast<float>(camera.near_m);
        rays.ray.tfar[k] = std::numeric_limits<float>::infinity();
        rays.ray.mask[k] = 0xffffffffu;
        rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect16(valid, scene_, &context, &rays);
      for (int k = 0; k < 16; ++k)
        hits += valid[k] != 0 && rays.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
    }
  }
  return hits;
}

}  // namespace plumb::bench
