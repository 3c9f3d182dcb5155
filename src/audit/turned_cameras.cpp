#include "audit/turned_cameras.h"

#include <cmath>

namespace plumb::audit {

Camera turned_about_middle(const terrain::Heightfield& field, const Turn& turn, Camera camera) {
  const glm::dvec3 middle =
      field.world_origin_m() +
      0.5 * glm::dvec3(field.cell_columns() * field.dx_m, field.cell_rows() * field.dy_m, 0.0);
  camera.eye_m = middle + turn(camera.eye_m - middle);
  for (glm::dvec3* axis : {&camera.right, &camera.up, &camera.forward}) *axis = turn(*axis);
  return camera;
}

std::vector<Camera> turned_cameras(const HeightfieldTruth& truth, const Camera& camera) {
  const terrain::Heightfield& field = truth.field();
  const glm::dvec3 origin = field.world_origin_m();
  const auto ground_below = [&](const glm::dvec3& eye) {
    return truth.height_at(eye.x - origin.x, eye.y - origin.y);
  };
  const double ground = ground_below(camera.eye_m);
  std::vector<Camera> turned;
  for (int k = 1; k < 8; ++k) {
    const Turn turn{(k & 1) != 0, (k & 2) != 0, (k & 4) != 0};
    Camera other = turned_about_middle(field, turn, camera);
    const double change = ground_below(other.eye_m) - ground;
    if (!std::isnan(change)) other.eye_m.z += change;
    turned.push_back(other);
  }
  return turned;
}

}  // namespace plumb::audit
