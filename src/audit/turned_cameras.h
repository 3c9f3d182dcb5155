// The same view of the terrain mirrored and turned: what a frame of some other ground looks like.
// Not for users of the library.
#pragma once

#include <glm/vec3.hpp>

#include <utility>
#include <vector>

#include "audit/truth.h"
#include "core/camera.h"
#include "terrain/heightfield.h"

namespace plumb::audit {

/// One of the eight symmetries of a square: mirrored, then x and y exchanged.
struct Turn {
  bool mirror_x = false, mirror_y = false, exchange = false;

  glm::dvec3 operator()(glm::dvec3 v) const {
    if (mirror_x) v.x = -v.x;
    if (mirror_y) v.y = -v.y;
    if (exchange) std::swap(v.x, v.y);
    return v;
  }
};

/// The camera turned about the middle of a terrain. Its axes may be left-handed.
Camera turned_about_middle(const terrain::Heightfield& field, const Turn& turn, Camera camera);

/// The seven cameras that see the terrain as `camera` would if it were mirrored or turned by
/// quarters about its middle, as high above the ground as `camera` is. Their axes may be
/// left-handed.
std::vector<Camera> turned_cameras(const HeightfieldTruth& truth, const Camera& camera);

}  // namespace plumb::audit
