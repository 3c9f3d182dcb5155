#include "audit/pixel_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};
constexpr std::int64_t kGrain = 4096;

struct Worst {
  double error = -1.0;
  std::int64_t pixel = -1;
  double pixels_per_metre = 0.0;
};

Worst worse(const Worst& a, const Worst& b) {
  Worst result = b.error > a.error ? b : a;  // equal: the first
  result.pixels_per_metre = std::max(a.pixels_per_metre, b.pixels_per_metre);
  return result;
}

// measure(pixel, vertical_m) -> error in pixels and the point's pixels per metre, for pixels where
// shown(pixel).
template <class Shown, class Measure>
PixelErrors measure_pixels(std::size_t size, const Shown& shown, const Measure& measure) {
  PixelErrors errors;
  errors.vertical_px.assign(size, kNothing);
  errors.vertical_m.assign(size, kNothing);
  const Worst worst = parallel_ordered_reduce(
      static_cast<std::int64_t>(size), kGrain, Worst{},
      [&](std::int64_t begin, std::int64_t end, Worst found) {
        for (std::int64_t k = begin; k < end; ++k) {
          const auto pixel = static_cast<std::size_t>(k);
          if (!shown(pixel)) continue;
          double vertical_m = 0.0;
          Worst here;
          here.pixel = k;
          here.error = measure(pixel, vertical_m, here.pixels_per_metre);
          errors.vertical_px[pixel] = static_cast<float>(here.error);
          errors.vertical_m[pixel] = static_cast<float>(vertical_m);
          found = worse(found, here);
        }
        return found;
      },
      worse);
  errors.max_vertical_px = std::max(0.0, worst.error);
  errors.worst_pixel = worst.pixel;
  errors.pixels_per_metre = worst.pixels_per_metre;
  return errors;
}

// What a vertical displacement of a point does on the screen.
class VerticalOnScreen {
 public:
  explicit VerticalOnScreen(const Camera& local)
      : camera_(local), up_(direction_to_view(local, kUp)) {}

  // In pixels; and how far a small one goes for each metre, at `depth_m` of the point.
  double operator()(const glm::dvec3& point_m, double delta_m, double depth_m,
                    double& pixels_per_metre) const {
    const glm::dvec3 view = to_view(camera_, point_m);
    const double speed = screen_speed(camera_, view, up_), small = 1e-6 * depth_m;
    pixels_per_metre = screen_displacement_at_speed_px(speed, view.z, up_.z, small) / small;
    return screen_displacement_at_speed_px(speed, view.z, up_.z, delta_m);
  }

 private:
  const Camera& camera_;
  glm::dvec3 up_;  // in view coordinates
};

// The points that a picture shows, in the order of their pixels.
struct Places {
  std::vector<glm::dvec3> at_m;
  std::vector<std::uint32_t> of_pixel;  // set where the pixel shows something
};

Places places_of(const HitImage& image, const glm::dvec3& eye_m) {
  const auto width = static_cast<std::size_t>(image.width_px);
  std::vector<std::uint32_t> start(static_cast<std::size_t>(image.height_px) + 1, 0);
  const auto for_row = [&](std::int64_t row, const auto& visit) {
    const std::size_t begin = static_cast<std::size_t>(row) * width;
    for (std::size_t pixel = begin; pixel < begin + width; ++pixel) {
      if (image.hit(pixel)) visit(pixel);
    }
  };
  parallel_for(image.height_px, 16, [&](std::int64_t row) {
    std::uint32_t count = 0;
    for_row(row, [&](std::size_t) { ++count; });
    start[static_cast<std::size_t>(row) + 1] = count;
  });
  std::partial_sum(start.begin(), start.end(), start.begin());
  Places places{std::vector<glm::dvec3>(start.back()), std::vector<std::uint32_t>(image.size())};
  parallel_for(image.height_px, 16, [&](std::int64_t row) {
    std::uint32_t next = start[static_cast<std::size_t>(row)];
    for_row(row, [&](std::size_t pixel) {
      places.at_m[next] = eye_m + image.from_eye_m[pixel];
      places.of_pixel[pixel] = next++;
    });
  });
  return places;
}

}  // namespace

PixelErrors vertical_errors(const HeightfieldTruth& truth, const HitImage& drawn,
                            const Camera& camera) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  const VerticalOnScreen on_screen(local);
  return measure_pixels(
      drawn.size(), [&](std::size_t pixel) { return drawn.hit(pixel); },
      [&](std::size_t pixel, double& vertical_m, double& pixels_per_metre) {
        const glm::dvec3 point = local.eye_m + drawn.from_eye_m[pixel];
        const double height = truth.height_at(point.x, point.y);
        vertical_m = std::isnan(height) ? kInfinity : point.z - height;
        if (std::isnan(height)) return kInfinity;
        return on_screen(point, height - point.z, drawn.depth_m[pixel], pixels_per_metre);
      });
}

ReversePixelErrors reverse_vertical_errors(const HeightfieldTruth& truth, const HitImage& true_hits,
                                           const TriangleMesh& mesh, const Camera& camera) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  const VerticalOnScreen on_screen(local);
  const Places places = places_of(true_hits, local.eye_m);
  const std::vector<Deviation> found = deviation_at(truth.field(), mesh, places.at_m);
  ReversePixelErrors errors;
  errors.triangle.resize(true_hits.size());
  static_cast<PixelErrors&>(errors) = measure_pixels(
      true_hits.size(),
      [&](std::size_t pixel) {
        errors.triangle[pixel] = kNoPrimitive;
        return true_hits.hit(pixel);
      },
      [&](std::size_t pixel, double& vertical_m, double& pixels_per_metre) {
        const std::uint32_t place = places.of_pixel[pixel];
        const Deviation& there = found[place];
        errors.triangle[pixel] = there.triangle;
        vertical_m = there.covered() ? there.delta_m : kInfinity;
        if (!there.covered()) return kInfinity;
        return on_screen(places.at_m[place], there.delta_m, true_hits.depth_m[pixel],
                         pixels_per_metre);
      });
  return errors;
}

std::vector<float> depth_errors(const HitImage& true_hits, const HitImage& drawn) {
  std::vector<float> errors(drawn.size(), kNothing);
  parallel_for(static_cast<std::int64_t>(drawn.size()), kGrain, [&](std::int64_t k) {
    const auto pixel = static_cast<std::size_t>(k);
    if (!drawn.hit(pixel) || !true_hits.hit(pixel)) return;
    errors[pixel] = static_cast<float>(std::abs(drawn.depth_m[pixel] - true_hits.depth_m[pixel]) /
                                       true_hits.depth_m[pixel]);
  });
  return errors;
}

}  // namespace plumb::audit
