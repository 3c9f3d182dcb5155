// How far a surface may stray where a camera, or a tolerance in metres, looks at it.
#pragma once

#include "core/box.h"
#include "core/camera.h"
#include "core/claim.h"
#include "core/screen_error.h"

namespace plumb::mesh::tessellation {

inline constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};

/// A tolerance as seen from a camera; everything relative to the terrain's origin.
struct ViewTest {
  Camera camera;
  Tolerance tolerance;

  bool in_metres() const { return tolerance.unit == Unit::Metre; }
  /// How far up or down anything in the box may be displaced, metres.
  double allowed_m(const Box& box) const {
    return in_metres() ? tolerance.value
                       : allowed_displacement_m(camera, box, kUp, tolerance.value);
  }
  /// How far a displacement of so many metres reaches, in the tolerance's unit.
  double reach(const Box& box, double bound_m) const {
    return in_metres() ? bound_m : displacement_bound_px(camera, box, kUp, bound_m);
  }
};

}  // namespace plumb::mesh::tessellation
