// Rays of one camera through any points of its image, many at once.
#pragma once

#include <memory>

#include "core/camera.h"
#include "reference/lane_scene.h"
#include "reference/pyramid_caster.h"

namespace plumb::reference {

/// What rays of one camera share. Keeps references to both.
class CameraRays {
 public:
  CameraRays(const PyramidCaster& caster, const Camera& camera);

  const PyramidCaster& caster() const { return caster_; }
  const Camera& camera() const { return camera_; }

  /// Up to kMost rays that are cast together: the nearer to each other, the faster.
  class Batch {
   public:
    static constexpr int kMost = LaneRays::kMost;

    explicit Batch(const CameraRays& rays) : rays_(rays) { lanes_.count = 0; }

    int count() const { return lanes_.count; }
    bool is_full() const { return lanes_.count == kMost; }
    void clear() { lanes_.count = 0; }
    /// One more, through an image point; not if it is full.
    void add(double x_px, double y_px);
    /// Casts them. hit(k) then has the bits of caster.cast(caster.camera_ray(camera, x, y)).
    void cast();
    RayHit hit(int k) const { return {lanes_.t[k], lanes_.triangle[k]}; }

   private:
    const CameraRays& rays_;
    LaneRays lanes_;
  };

 private:
  const PyramidCaster& caster_;
  const Camera& camera_;
  LaneScene scene_;
};

}  // namespace plumb::reference
