#include "audit/sample_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "audit/neighbourhood.h"
#include "audit/surface_deviation.h"
#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};
constexpr double kHiddenByLess =
    1e-3;  // relative depth by which a sample may lie behind the truth around its pixel

bool inside_image(const Camera& camera, const glm::dvec2& pixel) {
  return pixel.x >= 0.0 && pixel.x <= camera.width_px && pixel.y >= 0.0 &&
         pixel.y <= camera.height_px;
}

// What one row adds to the figures; its values go where the caller says.
struct RowErrors {
  WorstSample worst_m, worst_px;
  std::vector<std::pair<int, double>>
      patches;  // patch and its largest error in this row, runs joined
  std::int64_t uncovered = 0, over_void = 0, overlapped = 0;
  double pixels_per_metre = 0.0;
};

// A row's part of the maps.
struct RowValues {
  float *metres, *pixels, *visible;
};

class RowMeasure {
 public:
  RowMeasure(const HeightfieldTruth& truth, const HitImage& true_hits, const DrawnSurface& surface,
             const Camera& local)
      : truth_(truth),
        true_hits_(true_hits),
        surface_(surface),
        camera_(local),
        up_(direction_to_view(local, kUp)),
        around_(neighbourhoods(true_hits, 1)) {}

  RowErrors operator()(int j, const DeviationRow& row, RowValues values) const {
    RowErrors errors;
    std::uint32_t last = kNoPrimitive;  // neighbours mostly share a triangle, and its patch
    Projected projected;
    for (int i = 0; i < truth_.field().columns(); ++i) {
      const int k = i % Projected::kMost;
      if (k == 0) project(i, j, projected);
      values.metres[i] = values.pixels[i] = values.visible[i] = kNothing;
      const Deviation deviation = row[i];
      errors.overlapped += deviation.sheets > 1;
      if (!is_comparable(i, j, deviation, errors)) continue;
      if (last != deviation.triangle) {
        last = deviation.triangle;
        const int before = errors.patches.empty() ? -1 : errors.patches.back().first;
        const int patch = patch_of(surface_, last, before);
        if (patch != before) errors.patches.emplace_back(patch, 0.0);
      }
      auto& [patch, most] = errors.patches.back();
      const double metres = std::abs(deviation.delta_m);
      values.metres[i] = static_cast<float>(metres);
      most = std::max(most, metres);
      if (errors.worst_m.i < 0 || metres > errors.worst_m.error)
        errors.worst_m = {i, j, metres, deviation.delta_m, last, patch};
      if (!is_in_frustum(projected, k)) continue;
      const double error = on_screen(projected, k, deviation.delta_m, errors.pixels_per_metre);
      values.pixels[i] = static_cast<float>(error);
      if (is_visible(projected, k)) values.visible[i] = values.pixels[i];
      if (errors.worst_px.i < 0 || error > errors.worst_px.error)
        errors.worst_px = {i, j, error, deviation.delta_m, last, patch};
    }
    return errors;
  }

 private:
  // Where a run of a row's samples is seen.
  struct Projected {
    static constexpr int kMost = 256;
    double x_px[kMost], y_px[kMost], depth_m[kMost];  // meaningless behind the eye
    double speed_squared[kMost];                      // of screen_speed
  };

  // The samples from (i, j) eastwards: to_view, view_to_pixel and screen_velocity, written out for
  // a loop without branches or calls.
  void project(int i, int j, Projected& to) const {
    const terrain::Heightfield& field = truth_.field();
    const Camera& c = camera_;
    const double dx = field.dx_m, y = j * field.dy_m - c.eye_m.y;
    const double y_right = y * c.right.y, y_up = y * c.up.y, y_forward = y * c.forward.y;
    const float* heights = &field.heights_m(i, j);
    const int count = std::min(Projected::kMost, field.columns() - i);
    for (int k = 0; k < count; ++k) {
      const double x = (i + k) * dx - c.eye_m.x, z = static_cast<double>(heights[k]) - c.eye_m.z;
      const double across = x * c.right.x + y_right + z * c.right.z;
      const double upwards = x * c.up.x + y_up + z * c.up.z;
      const double depth = x * c.forward.x + y_forward + z * c.forward.z;
      to.x_px[k] = c.centre_px.x + c.gamma_h * (across / depth);
      to.y_px[k] = c.centre_px.y - c.gamma_v * (upwards / depth);
      to.depth_m[k] = depth;
      const double u = c.gamma_h * (depth * up_.x - up_.z * across);
      const double v = c.gamma_v * (depth * up_.y - up_.z * upwards);
      to.speed_squared[k] = u * u + v * v;
    }
  }

  bool is_in_frustum(const Projected& at, int k) const {
    return at.depth_m[k] >= camera_.near_m && at.depth_m[k] <= camera_.far_m &&
           inside_image(camera_, {at.x_px[k], at.y_px[k]});
  }

  double on_screen(const Projected& at, int k, double delta_m, double& pixels_per_metre) const {
    const double speed = std::sqrt(at.speed_squared[k]), depth = at.depth_m[k];
    // Divided only where it may be the largest.
    const double small = 1e-6 * depth;
    if (speed * (1.0 + 1e-9) > pixels_per_metre * depth * (depth + small * up_.z)) {
      pixels_per_metre = std::max(
          pixels_per_metre, screen_displacement_at_speed_px(speed, depth, up_.z, small) / small);
    }
    return screen_displacement_at_speed_px(speed, depth, up_.z, delta_m);
  }

  // True if there is a surface and something drawn over it; else counts what is missing.
  bool is_comparable(int i, int j, const Deviation& deviation, RowErrors& errors) const {
    const terrain::Heightfield& field = truth_.field();
    if (field.is_void(i, j)) {
      errors.over_void += deviation.covered();
      return false;
    }
    if (deviation.covered()) return true;
    errors.uncovered +=
        reference::exists_at(field, truth_.diagonal(), i * field.dx_m, j * field.dy_m);
    return false;
  }

  // Not behind the truth that its pixel or one of the eight around it shows.
  bool is_visible(const Projected& at, int k) const {
    // A place on the image's right or lower rim belongs to the last pixel.
    const int x = std::min(static_cast<int>(at.x_px[k]), true_hits_.width_px - 1),
              y = std::min(static_cast<int>(at.y_px[k]), true_hits_.height_px - 1);
    return at.depth_m[k] <= around_[true_hits_.index(x, y)].deepest * (1.0 + kHiddenByLess);
  }

  const HeightfieldTruth& truth_;
  const HitImage& true_hits_;
  const DrawnSurface& surface_;
  const Camera& camera_;
  glm::dvec3 up_;                      // in view coordinates
  std::vector<Neighbourhood> around_;  // of the truth's pixels, and the eight next to each
};

void keep_worse(WorstSample& worst, const WorstSample& other) {
  if (other.i >= 0 && (worst.i < 0 || other.error > worst.error)) worst = other;
}

}  // namespace

bool in_frustum(const Camera& camera, const glm::dvec3& point_m) {
  const glm::dvec3 view = to_view(camera, point_m);
  return view.z >= camera.near_m && view.z <= camera.far_m &&
         inside_image(camera, view_to_pixel(camera, view));
}

SampleErrors sample_errors(const HeightfieldTruth& truth, const HitImage& true_hits,
                           const DrawnSurface& surface, const Camera& camera) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  const RowMeasure measure(truth, true_hits, surface, local);
  std::vector<RowErrors> rows(static_cast<std::size_t>(truth.field().rows()));
  SampleErrors errors;
  const auto columns = static_cast<std::size_t>(truth.field().columns());
  errors.values_m = SampleMap(rows.size() * columns);
  errors.values_px = SampleMap(rows.size() * columns);
  SampleMap visible(rows.size() * columns);
  for_each_sample_row(
      truth.field(), *surface.mesh, &errors.triangle_max_m, [&](int j, const DeviationRow& row) {
        const auto y = static_cast<std::size_t>(j);
        const auto part = [&](SampleMap& map) { return map.span().data() + y * columns; };
        rows[y] = measure(j, row, {part(errors.values_m), part(errors.values_px), part(visible)});
      });
  errors.patch_max_m.assign(std::max<std::size_t>(1, surface.patches.size()), 0.0);
  // From the south, so that the first of equals is the same on every machine.
  for (const RowErrors& row : rows) {
    for (const auto& [patch, error] : row.patches) {
      double& most = errors.patch_max_m[static_cast<std::size_t>(patch)];
      most = std::max(most, error);
    }
    keep_worse(errors.worst_m, row.worst_m);
    keep_worse(errors.worst_px, row.worst_px);
    errors.uncovered += row.uncovered;
    errors.over_void += row.over_void;
    errors.overlapped += row.overlapped;
    errors.pixels_per_metre = std::max(errors.pixels_per_metre, row.pixels_per_metre);
  }
  errors.metres = distribution_of(errors.values_m.span());
  errors.pixels = distribution_of(errors.values_px.span());
  errors.visible_pixels = distribution_of(visible.span());
  return errors;
}

}  // namespace plumb::audit
