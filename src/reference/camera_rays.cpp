#include "reference/camera_rays.h"

#include <algorithm>
#include <limits>

#include "reference/beam_start.h"
#include "reference/careful_walk.h"

namespace plumb::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The directions lie in the box of themselves.
Beam beam_of(const LaneRays& lanes, const Ray& any) {
  const auto span = [&](const double* values) {
    return std::minmax_element(values, values + lanes.count);
  };
  const auto x = span(lanes.direction_x), y = span(lanes.direction_y), z = span(lanes.direction_z);
  return {any.origin_m,
          {*x.first, *y.first, *z.first},
          {*x.second, *y.second, *z.second},
          any.t_min,
          any.t_max};
}

}  // namespace

CameraRays::CameraRays(const PyramidCaster& caster, const Camera& camera)
    : caster_(caster),
      camera_(camera),
      scene_(lane_scene(caster.field(), caster.diagonal(), caster.pyramid(),
                        caster.camera_ray(camera, 0.5, 0.5))) {}

void CameraRays::Batch::add(double x_px, double y_px) {
  const glm::dvec3 direction = ray_direction(rays_.camera_, x_px, y_px);
  lanes_.direction_x[lanes_.count] = direction.x;
  lanes_.direction_y[lanes_.count] = direction.y;
  lanes_.direction_z[lanes_.count] = direction.z;
  ++lanes_.count;
}

void CameraRays::Batch::cast() {
  if (lanes_.count == 0) return;
  const PyramidCaster& caster = rays_.caster_;
  const HeightPyramid& pyramid = caster.pyramid();
  Ray ray = caster.camera_ray(rays_.camera_, 0.5, 0.5);
  const BeamStart start = pyramid.root().empty()
                              ? BeamStart{kInfinity, 1}
                              : beam_start(caster.field(), pyramid, beam_of(lanes_, ray));
  if (!(start.t < kInfinity)) {
    std::fill_n(lanes_.t, lanes_.count, kInfinity);
    std::fill_n(lanes_.triangle, lanes_.count, kNoPrimitive);
    return;
  }
  lanes_.t_begin = start.t;
  lanes_.begin_level = std::min(start.level, rays_.scene_.top_level);
  walk_lanes(caster.field(), rays_.scene_, lanes_);
  for (int k = 0; k < lanes_.count; ++k) {
    if (!lanes_.undecided[k]) continue;
    ray.direction = {lanes_.direction_x[k], lanes_.direction_y[k], lanes_.direction_z[k]};
    const RayHit hit = walk_carefully(caster.field(), caster.diagonal(), pyramid, ray, lanes_.t[k]);
    lanes_.t[k] = hit.t;
    lanes_.triangle[k] = hit.triangle;
  }
}

}  // namespace plumb::reference
