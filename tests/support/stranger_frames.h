// Frames as somebody else's renderer might have written them, right and wrong.
#pragma once

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "audit/depth_meaning.h"
#include "audit/truth.h"
#include "core/hit_image.h"
#include "image/depth_file.h"
#include "support/test_terrain.h"
#include "terrain/camera_presets.h"
#include "terrain/terrain_source.h"

namespace plumb::test_support {

/// A terrain and its truth, which keeps a reference to it.
struct Ground {
  terrain::Heightfield field;
  audit::HeightfieldTruth truth;

  explicit Ground(terrain::Heightfield heights)
      : field(std::move(heights)), truth(field, terrain::Diagonal::Alternating) {}
  Ground(const Ground&) = delete;
  Ground& operator=(const Ground&) = delete;

  Camera camera(const std::string& preset, int width, int height) const {
    LookAt look = terrain::preset_camera(field, preset, width, height, 50.0);
    look.near_m = 1.0;
    look.far_m = 100000.0;
    return make_camera(look);
  }
};

inline std::unique_ptr<Ground> ground(const std::string& source) {
  return std::make_unique<Ground>(terrain::load_terrain(source, {}));
}

/// Every `stride`-th sample, bilinear between them: the coarsest of levels of detail.
inline std::unique_ptr<Ground> decimated(const terrain::Heightfield& field, int stride) {
  terrain::Heightfield coarse;
  const int columns = field.cell_columns() / stride + 1, rows = field.cell_rows() / stride + 1;
  coarse.heights_m = Grid<float>(columns, rows);
  coarse.origin_m = field.origin_m;
  coarse.dx_m = field.dx_m * stride;
  coarse.dy_m = field.dy_m * stride;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i)
      coarse.heights_m.floats()(i, j) = field.heights_m(i * stride, j * stride);
  }
  return std::make_unique<Ground>(std::move(coarse));
}

/// The number that a renderer of this convention stores for a view depth.
inline double stored_number(double depth_m, double ray_length, const audit::DepthMeaning& meaning,
                            const Camera& camera) {
  using audit::DepthConvention;
  const bool sky = !(depth_m < kNoHit);
  switch (meaning.convention) {
    case DepthConvention::Linear:
      return depth_m / meaning.metres_per_unit;
    case DepthConvention::Distance:
      return depth_m * ray_length / meaning.metres_per_unit;
    default:
      break;
  }
  const double n = camera.near_m, f = camera.far_m;
  const double window = sky             ? 1.0
                        : std::isinf(f) ? 1.0 - n / depth_m
                                        : f / (f - n) - f * n / (f - n) / depth_m;
  const double reversed = sky             ? 0.0
                          : std::isinf(f) ? n / depth_m
                                          : n * (f - depth_m) / (f - n) / depth_m;
  return meaning.convention == DepthConvention::Window ? window
         : meaning.convention == DepthConvention::Ndc  ? 2.0 * window - 1.0
                                                       : reversed;
}

/// What a renderer of this meaning writes of these hits.
inline image::DepthBuffer written(const HitImage& hits, const Camera& camera,
                                  const audit::DepthMeaning& meaning) {
  image::DepthBuffer buffer{hits.width_px, hits.height_px, {}, {}, {}};
  buffer.values.resize(hits.size());
  for (int y = 0; y < hits.height_px; ++y) {
    for (int x = 0; x < hits.width_px; ++x) {
      const glm::dvec3 ray = ray_direction(camera, x + 0.5, y + 0.5);
      buffer.values[audit::stored_index(buffer, meaning, x, y)] = static_cast<float>(stored_number(
          hits.depth_m[hits.index(x, y)], std::sqrt(glm::dot(ray, ray)), meaning, camera));
    }
  }
  return buffer;
}

}  // namespace plumb::test_support
