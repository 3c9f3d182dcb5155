// Embree's own triangles, in its own single precision, as a third opinion: they share neither the
// arithmetic nor the triangles' boxes with the casters.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/embree_caster.h"
#include "reference/embree_version.h"
#include "support/random_scene.h"
#include "support/test_meshes.h"

namespace plumb::reference {
namespace {

using test_support::Random;
using test_support::View;

class NativeScene {
 public:
  explicit NativeScene(const TriangleMesh& mesh)
      : device_(rtcNewDevice("")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices_m.size()));
    for (const glm::dvec3& v : mesh.vertices_m) {
      for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(v[axis]);
    }
    auto* corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) *corners++ = corner;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~NativeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  NativeScene(const NativeScene&) = delete;
  NativeScene& operator=(const NativeScene&) = delete;

  RayHit cast(const Ray& ray) const {
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(ray.origin_m.x);
    query.ray.org_y = static_cast<float>(ray.origin_m.y);
    query.ray.org_z = static_cast<float>(ray.origin_m.z);
    query.ray.dir_x = static_cast<float>(ray.direction.x);
    query.ray.dir_y = static_cast<float>(ray.direction.y);
    query.ray.dir_z = static_cast<float>(ray.direction.z);
    query.ray.tnear = static_cast<float>(ray.t_min);
    query.ray.tfar = static_cast<float>(ray.t_max);
    query.ray.mask = 0xffffffffu;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    EmbreeRayContext context;
    start(context);
    intersect(scene_, context, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.ray.tfar, query.hit.primID};
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

// Single precision moves a ray by 2^-24 of the scene, here some 2e-4 of a pixel at most, across an
// edge in about as many of the pixels that an edge passes: rarely more than one in 500 pixels is
// passed so closely by an edge of a random terrain, every pixel of which holds some. Elsewhere both
// name the same triangle or, from its edge, a neighbour.
TEST(EmbreeCaster, SeesWhatEmbreesOwnTrianglesShow) {
  Random random(21);
  std::size_t rays = 0, same = 0, hits = 0;
  for (int k = 0; k < 60; ++k) {
    terrain::Heightfield field = test_support::random_heightfield(random);
    field.origin_m = {0.0, 0.0};  // where single precision is at its best
    const TriangleMesh mesh = test_support::mesh_of(field, terrain::Diagonal::Fixed);
    if (mesh.triangles.empty()) continue;
    const NativeScene native(mesh);
    const EmbreeCaster caster(mesh);
    const View view = k % 2 == 0 ? View::Oblique : View::Top;
    const Camera camera = test_support::random_camera(random, field, view, 61, 47);
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const Ray ray = caster.camera_ray(camera, x + 0.5, y + 0.5);
        const RayHit ours = caster.cast(ray), theirs = native.cast(ray);
        ++rays;
        hits += ours ? 1 : 0;
        same += ours.triangle == theirs.triangle ? 1 : 0;
      }
    }
  }
  EXPECT_GT(hits, rays / 8);
  EXPECT_LE(rays - same, rays / 500) << rays << " rays, " << hits << " hits";
  RecordProperty("rays", std::to_string(rays));
  RecordProperty("different", std::to_string(rays - same));
}

}  // namespace
}  // namespace plumb::reference
