#include "raster/shading/preview.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "raster/shading/shade.h"

namespace plumb::raster {
namespace {

constexpr double kWantedSlope = 0.3;
constexpr double kMostExaggeration = 50.0;

// Which samples along one axis fall in pixel k of `pixels`; at least one.
struct Run {
  int begin, end;
};
Run samples_of(int k, int pixels, int samples) {
  const auto at = [=](int p) {
    return static_cast<int>(static_cast<std::int64_t>(p) * samples / pixels);
  };
  const int begin = at(k);
  return {begin, std::max(begin + 1, at(k + 1))};
}

// Mean heights by pixel, row 0 in the south; NaN for a void.
Grid<double> averaged(const terrain::Heightfield& field, int width_px, int height_px) {
  Grid<double> means(width_px, height_px);
  parallel_for(height_px, 1, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    const Run rows = samples_of(y, height_px, field.rows());
    for (int x = 0; x < width_px; ++x) {
      const Run columns = samples_of(x, width_px, field.columns());
      double sum_m = 0.0;
      std::int64_t found = 0, voids = 0;
      for (int j = rows.begin; j < rows.end; ++j) {
        for (int i = columns.begin; i < columns.end; ++i) {
          const float height_m = field.heights_m(i, j);
          if (std::isnan(height_m)) {
            ++voids;
          } else {
            sum_m += height_m;
            ++found;
          }
        }
      }
      means(x, y) = found >= voids ? sum_m / static_cast<double>(found) : std::nan("");
    }
  });
  return means;
}

// Rise along one axis by central difference, one-sided beside voids and borders.
double slope(double before_m, double here_m, double after_m, double step_m) {
  const bool has_before = !std::isnan(before_m), has_after = !std::isnan(after_m);
  if (has_before && has_after) return (after_m - before_m) / (2.0 * step_m);
  if (has_after) return (after_m - here_m) / step_m;
  return has_before ? (here_m - before_m) / step_m : 0.0;
}

glm::dvec2 gradient_at(const Grid<double>& means, int x, int y, const glm::dvec2& step_m) {
  const auto height_m = [&](int i, int j) {
    return means.contains(i, j) ? means(i, j) : std::nan("");
  };
  const double here_m = means(x, y);
  return {slope(height_m(x - 1, y), here_m, height_m(x + 1, y), step_m.x),
          slope(height_m(x, y - 1), here_m, height_m(x, y + 1), step_m.y)};
}

double exaggeration(const Grid<double>& means, const glm::dvec2& step_m) {
  double sum = 0.0;  // one thread, row by row: the order is fixed
  std::int64_t count = 0;
  for (int y = 0; y < means.rows(); ++y) {
    for (int x = 0; x < means.columns(); ++x) {
      if (std::isnan(means(x, y))) continue;
      const glm::dvec2 g = gradient_at(means, x, y, step_m);
      if (g.x == 0.0 && g.y == 0.0) continue;  // a sea would make its island steep
      sum += std::sqrt(g.x * g.x + g.y * g.y);
      ++count;
    }
  }
  if (!(sum > 0.0)) return 1.0;
  return std::clamp(kWantedSlope * static_cast<double>(count) / sum, 1.0, kMostExaggeration);
}

}  // namespace

image::ColourImage shaded_preview(const terrain::Heightfield& field, int max_px) {
  terrain::require_valid(field);
  require(max_px >= 1, "max_px must be >= 1, got {}", max_px);
  const glm::dvec2 extent_m{field.columns() * field.dx_m, field.rows() * field.dy_m};
  const double pixel_m =
      std::max(std::max(extent_m.x, extent_m.y) / max_px, std::min(field.dx_m, field.dy_m));
  const auto pixels = [&](double length_m) {
    return std::clamp(static_cast<int>(length_m / pixel_m + 0.5), 1, max_px);
  };
  const int width_px = pixels(extent_m.x), height_px = pixels(extent_m.y);
  const Grid<double> means = averaged(field, width_px, height_px);
  const glm::dvec2 step_m{extent_m.x / width_px, extent_m.y / height_px};
  const double factor = exaggeration(means, step_m);

  const Box box = terrain::bounds(field);
  const double range_m = box.empty() ? 0.0 : box.high.z - box.low.z;
  const Light light;
  const glm::dvec3 towards = light.towards / std::sqrt(glm::dot(light.towards, light.towards));
  image::ColourImage result(width_px, height_px);
  parallel_for(height_px, 1, [&](std::int64_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width_px; ++x) {
      glm::dvec3 colour = kVoidColour;
      if (!std::isnan(means(x, y))) {
        const glm::dvec2 g = factor * gradient_at(means, x, y, step_m);
        const glm::dvec3 normal =
            glm::dvec3(-g.x, -g.y, 1.0) / std::sqrt(1.0 + g.x * g.x + g.y * g.y);
        const double sun = std::max(0.0, glm::dot(normal, towards));
        const double share = range_m > 0.0 ? (means(x, y) - box.low.z) / range_m : 0.0;
        colour = hypsometric_tint(share) *
                 (light.ambient * (0.5 + 0.5 * normal.z) + (1.0 - light.ambient) * sun);
      }
      const std::size_t k = result.index(x, height_px - 1 - y);  // north is up
      result.r[k] = static_cast<float>(colour.x);
      result.g[k] = static_cast<float>(colour.y);
      result.b[k] = static_cast<float>(colour.z);
    }
  });
  return result;
}

}  // namespace plumb::raster
