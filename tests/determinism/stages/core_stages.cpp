#include <vector>

#include "core/camera.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"
#include "core/screen_error.h"
#include "stage.h"

namespace plumb::determinism {
namespace {

std::uint64_t reproducible_maths() {
  Checksum sum;
  Sequence numbers(1);
  for (int i = 0; i < 20000; ++i) {
    const double angle = numbers.between(-1000.0, 1000.0), x = numbers.between(-30.0, 30.0);
    const double y = numbers.between(-30.0, 30.0), positive = numbers.between(1e-9, 1e6);
    sum.add(reproducible_sin(angle)).add(reproducible_cos(angle)).add(reproducible_tan(angle));
    sum.add(reproducible_atan(x)).add(reproducible_atan2(y, x)).add(reproducible_exp(x));
    sum.add(reproducible_log(positive)).add(reproducible_log2(positive));
    sum.add(reproducible_pow(positive, x / 10.0));
  }
  return sum.value();
}

void add(Checksum& sum, const glm::dvec3& v) { sum.add(v.x).add(v.y).add(v.z); }

LookAt some_camera(Sequence& numbers) {
  LookAt camera;
  camera.eye_m = {numbers.between(4e5, 6e5), numbers.between(4e6, 5e6), numbers.between(0, 4e3)};
  for (int axis = 0; axis < 3; ++axis)
    camera.target_m[axis] = camera.eye_m[axis] + numbers.between(-5e3, 5e3);
  camera.fov_y_deg = numbers.between(1.0, 150.0);
  return camera;
}

std::uint64_t cameras() {
  Checksum sum;
  Sequence numbers(2);
  for (int i = 0; i < 5000; ++i) {
    const Camera camera = make_camera(some_camera(numbers));
    add(sum, camera.right);
    add(sum, camera.up);
    add(sum, camera.forward);
    sum.add(camera.gamma_h).add(camera.gamma_v);
    const double x = numbers.between(0.0, 1920.0), y = numbers.between(0.0, 1080.0);
    const glm::dvec3 ray = ray_direction(camera, x, y);
    add(sum, ray);
    const glm::dvec2 pixel = view_to_pixel(camera, to_view(camera, camera.eye_m + 777.0 * ray));
    sum.add(pixel.x).add(pixel.y);
  }
  return sum.value();
}

std::uint64_t screen_errors() {
  Checksum sum;
  Sequence numbers(3);
  const glm::dvec3 up{0.0, 0.0, 1.0};
  for (int i = 0; i < 5000; ++i) {
    const Camera camera = make_camera(some_camera(numbers));
    Box box;
    for (int corner = 0; corner < 2; ++corner) {
      glm::dvec3 point;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] = camera.eye_m[axis] + numbers.between(-3e3, 3e3);
      box.add(point);
    }
    const double delta_m = numbers.between(0.0, 10.0);
    sum.add(screen_displacement_px(camera, box.low, up, delta_m));
    sum.add(largest_displacement_px(camera, box, up, delta_m));
    sum.add(allowed_displacement_m(camera, box, up, numbers.between(0.0, 4.0)));
    sum.add(may_be_in_view(camera, box) ? 1 : 0);
  }
  return sum.value();
}

// A sum of doubles whose bits would tell the order of the additions.
std::uint64_t ordered_sums() {
  std::vector<double> values(200000);
  parallel_for(static_cast<std::int64_t>(values.size()), 777, [&](std::int64_t i) {
    values[static_cast<std::size_t>(i)] =
        reproducible_exp(Sequence(static_cast<std::uint64_t>(i)).between(-20.0, 20.0));
  });
  const double total = parallel_ordered_reduce(
      static_cast<std::int64_t>(values.size()), 500, 0.0,
      [&](std::int64_t begin, std::int64_t end, double sum) {
        for (std::int64_t i = begin; i < end; ++i) sum += values[static_cast<std::size_t>(i)];
        return sum;
      },
      [](double a, double b) { return a + b; });
  return Checksum().add(total).value();
}

}  // namespace

std::vector<Stage> core_stages() {
  return {{"core.reproducible_maths", reproducible_maths},
          {"core.cameras", cameras},
          {"core.screen_errors", screen_errors},
          {"core.ordered_sums", ordered_sums}};
}

}  // namespace plumb::determinism
