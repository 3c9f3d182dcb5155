#include "audit/sample_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "audit/surface_deviation.h"
#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

constexpr glm::dvec3 kUp{0.0, 0.0, 1.0};
constexpr double kHiddenByLess =
    1e-3;  // relative depth by which a sample may lie behind the truth around its pixel

bool inside_image(const Camera& camera, const glm::dvec2& pixel) {
  return pixel.x >= 0.0 && pixel.x <= camera.width_px && pixel.y >= 0.0 &&
         pixel.y <= camera.height_px;
}

struct RowErrors {
  std::vector<float> metres, pixels, visible;
  WorstSample worst_m, worst_px;
  std::vector<std::pair<int, double>>
      patches;  // patch and its largest error in this row, runs joined
  std::int64_t uncovered = 0, over_void = 0, overlapped = 0;
  double pixels_per_metre = 0.0;
};

class RowMeasure {
 public:
  RowMeasure(const HeightfieldTruth& truth, const HitImage& true_hits, const DrawnSurface& surface,
             const Camera& local)
      : truth_(truth),
        true_hits_(true_hits),
        surface_(surface),
        camera_(local),
        up_(direction_to_view(local, kUp)) {}

  RowErrors operator()(int j, std::span<const Deviation> row) const {
    RowErrors errors;
    errors.metres.reserve(row.size());
    Named last;
    for (int i = 0; i < truth_.field().columns(); ++i) {
      measure(i, j, row[static_cast<std::size_t>(i)], last, errors);
    }
    return errors;
  }

 private:
  // The patch of the triangle before: neighbours mostly share it.
  struct Named {
    std::uint32_t triangle = kNoPrimitive;
    int patch = -1;
  };

  void measure(int i, int j, const Deviation& deviation, Named& last, RowErrors& errors) const {
    const terrain::Heightfield& field = truth_.field();
    errors.overlapped += deviation.sheets > 1;
    if (field.is_void(i, j)) {
      errors.over_void += deviation.covered();
      return;
    }
    if (!deviation.covered()) {
      errors.uncovered +=
          reference::exists_at(field, truth_.diagonal(), i * field.dx_m, j * field.dy_m);
      return;
    }
    if (last.triangle != deviation.triangle) {
      last = {deviation.triangle, patch_of(surface_, deviation.triangle)};
    }
    const double metres = std::abs(deviation.delta_m);
    errors.metres.push_back(static_cast<float>(metres));
    if (errors.patches.empty() || errors.patches.back().first != last.patch) {
      errors.patches.emplace_back(last.patch, 0.0);
    }
    errors.patches.back().second = std::max(errors.patches.back().second, metres);
    const WorstSample here{i, j, metres, deviation.delta_m, deviation.triangle, last.patch};
    if (errors.worst_m.i < 0 || metres > errors.worst_m.error) errors.worst_m = here;
    measure_on_screen(here, errors);
  }

  void measure_on_screen(WorstSample here, RowErrors& errors) const {
    const terrain::Heightfield& field = truth_.field();
    const glm::dvec3 view = to_view(
        camera_, {here.i * field.dx_m, here.j * field.dy_m, field.heights_m(here.i, here.j)});
    if (!(view.z >= camera_.near_m && view.z <= camera_.far_m)) return;
    const glm::dvec2 pixel = view_to_pixel(camera_, view);
    if (!inside_image(camera_, pixel)) return;
    const double speed = screen_speed(camera_, view, up_);
    here.error = screen_displacement_at_speed_px(speed, view.z, up_.z, here.delta_m);
    errors.pixels.push_back(static_cast<float>(here.error));
    const double small = 1e-6 * view.z;
    errors.pixels_per_metre =
        std::max(errors.pixels_per_metre,
                 screen_displacement_at_speed_px(speed, view.z, up_.z, small) / small);
    if (is_visible(pixel, view.z)) errors.visible.push_back(static_cast<float>(here.error));
    if (errors.worst_px.i < 0 || here.error > errors.worst_px.error) errors.worst_px = here;
  }

  // Not behind the truth that its pixel or one of the eight around it shows.
  bool is_visible(const glm::dvec2& pixel, double depth) const {
    const int x = static_cast<int>(pixel.x), y = static_cast<int>(pixel.y);
    for (int b = std::max(0, y - 1); b <= std::min(true_hits_.height_px - 1, y + 1); ++b) {
      for (int a = std::max(0, x - 1); a <= std::min(true_hits_.width_px - 1, x + 1); ++a) {
        if (depth <= true_hits_.depth_m[true_hits_.index(a, b)] * (1.0 + kHiddenByLess))
          return true;
      }
    }
    return false;
  }

  const HeightfieldTruth& truth_;
  const HitImage& true_hits_;
  const DrawnSurface& surface_;
  const Camera& camera_;
  glm::dvec3 up_;  // in view coordinates
};

void keep_worse(WorstSample& worst, const WorstSample& other) {
  if (other.i >= 0 && (worst.i < 0 || other.error > worst.error)) worst = other;
}

// What the rows hold, one after the other; they hold it no more.
std::vector<float> joined(std::vector<RowErrors>& rows, std::vector<float> RowErrors::*part) {
  std::vector<std::size_t> begin(rows.size() + 1, 0);
  for (std::size_t j = 0; j < rows.size(); ++j) begin[j + 1] = begin[j] + (rows[j].*part).size();
  std::vector<float> all(begin.back());
  parallel_for(static_cast<std::int64_t>(rows.size()), 64, [&](std::int64_t j) {
    const auto row = static_cast<std::size_t>(j);
    std::vector<float>& values = rows[row].*part;
    std::copy(values.begin(), values.end(), all.begin() + static_cast<std::ptrdiff_t>(begin[row]));
    std::vector<float>().swap(values);
  });
  return all;
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
  for_each_sample_row(truth.field(), *surface.mesh, &errors.triangle_max_m,
                      [&](int j, std::span<const Deviation> row) {
                        rows[static_cast<std::size_t>(j)] = measure(j, row);
                      });
  errors.patch_max_m.assign(std::max<std::size_t>(1, surface.patches.size()), 0.0);
  errors.values_m = joined(rows, &RowErrors::metres);
  errors.values_px = joined(rows, &RowErrors::pixels);
  const std::vector<float> visible = joined(rows, &RowErrors::visible);
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
  errors.metres = distribution_of(errors.values_m);
  errors.pixels = distribution_of(errors.values_px);
  errors.visible_pixels = distribution_of(visible);
  return errors;
}

}  // namespace plumb::audit
