#include "audit/stability/grounds.h"

#include <limits>
#include <memory>
#include <utility>

#include "audit/stability/rough_ground.h"

namespace plumb::audit::stability {

terrain::Heightfield ground(int columns, int rows, double spacing_m,
                            const std::function<double(int, int)>& height_m) {
  terrain::Heightfield field;
  field.heights_m = Grid<float>(columns, rows);
  field.dx_m = field.dy_m = spacing_m;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i)
      field.heights_m.floats()(i, j) = static_cast<float>(height_m(i, j));
  }
  return field;
}

terrain::Heightfield rough_ground(int columns, int rows, std::uint32_t seed, double relief_m,
                                  double void_share) {
  return ground(columns, rows, 10.0, [=](int i, int j) {
    // Voids come in clumps and alone.
    const bool is_void =
        noise(seed + 1000, i / 3, j / 3) < void_share || noise(seed + 2000, i, j) < void_share / 8;
    return is_void ? std::numeric_limits<double>::quiet_NaN() : rough_height(seed, i, j, relief_m);
  });
}

terrain::Heightfield stacks(int columns, int rows, int high_m,
                            const std::function<std::vector<terrain::Layer>(int, int)>& layers) {
  terrain::StackField field;
  field.columns = columns;
  field.rows = rows;
  field.voxels = high_m;
  field.materials = {{"air", glm::dvec3(0.0)},
                     {"rock", glm::dvec3(0.35, 0.31, 0.27)},
                     {"sand", glm::dvec3(0.62, 0.48, 0.24)}};
  terrain::StackWriter writer(field);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) writer.add(layers(i, j));
  }
  terrain::Heightfield top = terrain::top_surface(field);
  top.provenance = field.provenance;
  top.stacks = std::make_shared<const terrain::StackField>(std::move(field));
  return top;
}

LookAt look(const glm::dvec3& eye_m, const glm::dvec3& target_m, double fov_y_deg, double near_m) {
  return {.eye_m = eye_m,
          .target_m = target_m,
          .fov_y_deg = fov_y_deg,
          .width_px = 160,
          .height_px = 120,
          .near_m = near_m};
}

}  // namespace plumb::audit::stability
