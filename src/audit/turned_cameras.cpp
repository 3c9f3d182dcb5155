#include "audit/turned_cameras.h"

#include <cmath>
#include <utility>

namespace plumb::audit {
namespace {

// One of the eight symmetries of a square.
struct Turn {
  bool mirror_x, mirror_y, exchange;

  glm::dvec3 operator()(glm::dvec3 v) const {
    if (mirror_x) v.x = -v.x;
    if (mirror_y) v.y = -v.y;
    if (exchange) std::swap(v.x, v.y);
    return v;
  }
};

}  // namespace

std::vector<Camera> turned_cameras(const HeightfieldTruth& truth, const Camera& camera) {
  const terrain::Heightfield& field = truth.field();
  const glm::dvec3 origin = field.world_origin_m();
  const glm::dvec3 middle(origin.x + 0.5 * field.dx_m * field.cell_columns(),
                          origin.y + 0.5 * field.dy_m * field.cell_rows(), 0.0);
  const auto ground_below = [&](const glm::dvec3& eye) {
    return truth.height_at(eye.x - origin.x, eye.y - origin.y);
  };
  const double ground = ground_below(camera.eye_m);
  std::vector<Camera> turned;
  for (int k = 1; k < 8; ++k) {
    const Turn turn{(k & 1) != 0, (k & 2) != 0, (k & 4) != 0};
    Camera other = camera;
    other.eye_m = middle + turn(camera.eye_m - middle);
    for (glm::dvec3* axis : {&other.right, &other.up, &other.forward}) *axis = turn(*axis);
    const double change = ground_below(other.eye_m) - ground;
    if (!std::isnan(change)) other.eye_m.z += change;
    turned.push_back(other);
  }
  return turned;
}

}  // namespace plumb::audit
