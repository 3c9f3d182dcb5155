// Embree as its users call it, on the full-detail triangles: the peer of both casters.
#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <cstdint>

#include "core/camera.h"
#include "terrain/heightfield.h"

namespace plumb::bench {

/// A triangle geometry (ROBUST), vertices in single precision relative to `from_m` in the world.
class BareEmbree {
 public:
  BareEmbree(const terrain::Heightfield& field, const glm::dvec3& from_m);
  ~BareEmbree();
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  double build_user_s() const { return build_user_s_; }
  std::int64_t bytes() const { return bytes_; }
  /// Hits of a frame, seen from `from_m`: one ray at a time, or packets of 4 x 4 pixels.
  std::int64_t cast_single(const Camera& camera) const;
  std::int64_t cast_packets(const Camera& camera) const;

 private:
  RTCDevice device_;
  RTCScene scene_;
  double build_user_s_ = 0.0;
  std::atomic<std::int64_t> bytes_{0};
};

}  // namespace plumb::bench
