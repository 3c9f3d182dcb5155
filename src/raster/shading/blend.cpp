#include "raster/shading/blend.h"

#include <glm/geometric.hpp>

#include <algorithm>

#include "core/check.h"
#include "core/parallel.h"

namespace plumb::raster {

image::ColourImage blend(const image::ColourImage& behind, const Layers& layers,
                         std::span<const glm::dvec3> normals, const Camera& camera,
                         const ShadeOptions& options) {
  if (layers.empty()) return behind;
  require(layers.behind.size() == behind.size() && layers.first.size() == behind.size() + 1 &&
              layers.first.back() == layers.layers.size() && normals.size() == layers.layers.size(),
          "layers are not of a picture of {} pixels", behind.size());
  image::ColourImage result(behind.width_px, behind.height_px);
  parallel_for(static_cast<std::int64_t>(behind.size()), 4096, [&](std::int64_t i) {
    const auto k = static_cast<std::size_t>(i);
    double left = 1.0 - static_cast<double>(layers.behind[k]);
    glm::dvec3 colour =
        static_cast<double>(layers.behind[k]) * glm::dvec3(behind.r[k], behind.g[k], behind.b[k]);
    for (std::uint64_t at = layers.first[k]; at < layers.first[k + 1]; ++at) {
      const Layer& layer = layers.layers[at];
      const double depth_m = glm::dot(layer.from_eye_m, camera.forward);
      const auto weight = static_cast<double>(layer.weight);
      colour += weight * surface_colour(camera, layer.from_eye_m, normals[at], depth_m, options);
      left -= weight;
    }
    colour += std::max(0.0, left) * layers.fog;
    result.r[k] = static_cast<float>(colour.x);
    result.g[k] = static_cast<float>(colour.y);
    result.b[k] = static_cast<float>(colour.z);
  });
  return result;
}

}  // namespace plumb::raster
