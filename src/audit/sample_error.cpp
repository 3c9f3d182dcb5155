#include "audit/sample_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "audit/neighbourhood.h"
#include "audit/project_samples.h"
#include "audit/surface_deviation.h"
#include "core/parallel.h"
#include "core/screen_error.h"

namespace plumb::audit {
namespace {

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
      patches;                    // patch and its largest error in this row, runs joined
  std::vector<float> visible_px;  // of the samples that the truth shows
  std::vector<SampleFlaw> listed;
  std::int64_t uncovered = 0, over_void = 0, overlapped = 0;
  double pixels_per_metre = 0.0;
};

// A row's part of the maps.
struct RowValues {
  float *metres, *pixels;
};

class RowMeasure {
 public:
  RowMeasure(const HeightfieldTruth& truth, const HitImage& true_hits, const DrawnSurface& surface,
             const Camera& local, int most_listed)
      : truth_(truth),
        true_hits_(true_hits),
        surface_(surface),
        most_listed_(most_listed),
        camera_(local),
        project_(project_samples(instruction_set())),
        deepest_m_(neighbourhoods(true_hits, 1).deepest) {}

  RowErrors operator()(int j, const DeviationRow& row, RowValues values) const {
    RowErrors errors;
    ProjectedSamples samples;
    const terrain::Heightfield& field = truth_.field();
    for (int first = 0; first < field.columns(); first += ProjectedSamples::kMost) {
      const int count = std::min(ProjectedSamples::kMost, field.columns() - first);
      project_(camera_,
               {j * field.dy_m, field.dx_m, first, count, row.heights_m + first,
                row.delta_m + first, row.triangle + first},
               samples, errors.pixels_per_metre);
      const auto narrow = [](double error) { return static_cast<float>(error); };
      std::transform(samples.metres, samples.metres + count, values.metres + first, narrow);
      std::transform(samples.pixels, samples.pixels + count, values.pixels + first, narrow);
      add_samples(first, j, count, row, samples, errors);
    }
    return errors;
  }

 private:
  void add_samples(int first, int j, int count, const DeviationRow& row,
                   const ProjectedSamples& samples, RowErrors& errors) const {
    const auto is_overlapped = [&](int k) { return row.sheets[first + k] > 1.0; };
    const std::int64_t overlapped = errors.overlapped;
    for (int k = 0; k < count; ++k) errors.overlapped += is_overlapped(k);
    if (errors.overlapped > overlapped)
      list(SampleFlaw::Kind::Overlapped, overlapped, first, j, {0, count}, row, is_overlapped,
           errors);
    // Neighbours mostly share a triangle, and its patch.
    for (int begin = 0, end = 0; begin < count; begin = end) {
      const double triangle = row.triangle[first + begin];
      for (end = begin + 1; end < count && row.triangle[first + end] == triangle;) ++end;
      if (triangle < 0.0) {
        add_missing(first, j, {begin, end}, row, errors);
      } else {
        add_run(first, j, {begin, end}, row, samples, errors);
      }
    }
    add_visible(samples, count, errors.visible_px);
  }

  // Samples under one triangle.
  void add_run(int first, int j, glm::ivec2 run, const DeviationRow& row,
               const ProjectedSamples& samples, RowErrors& errors) const {
    const std::uint32_t triangle = row[first + run.x].triangle;
    const int before = errors.patches.empty() ? -1 : errors.patches.back().first;
    const int patch = patch_of(surface_, triangle, before);
    if (patch != before) errors.patches.emplace_back(patch, -1.0);
    double& most = errors.patches.back().second;
    const auto keep = [&](WorstSample& worst, int k, double error) {
      worst = {first + k, j, error, row.delta_m[first + k], triangle, patch};
    };
    const std::int64_t over_void = errors.over_void;
    for (int k = run.x; k < run.y; ++k) {
      const double metres = samples.metres[k], pixels = samples.pixels[k];
      errors.over_void += std::isnan(metres);
      most = metres > most ? metres : most;
      if (metres > errors.worst_m.error || (errors.worst_m.i < 0 && metres == 0.0))
        keep(errors.worst_m, k, metres);
      if (pixels > errors.worst_px.error || (errors.worst_px.i < 0 && pixels == 0.0))
        keep(errors.worst_px, k, pixels);
    }
    if (errors.over_void > over_void)
      list(
          SampleFlaw::Kind::OverVoid, over_void, first, j, run, row,
          [&](int k) { return std::isnan(samples.metres[k]); }, errors);
  }

  // Those of a run that are flawed, until the row has enough of their kind; it had `listed` before.
  template <class IsFlawed>
  void list(SampleFlaw::Kind kind, std::int64_t listed, int first, int j, glm::ivec2 run,
            const DeviationRow& row, const IsFlawed& is_flawed, RowErrors& errors) const {
    for (int k = run.x; k < run.y && listed < most_listed_; ++k) {
      if (!is_flawed(k)) continue;
      errors.listed.push_back({kind, first + k, j, row[first + k].triangle});
      ++listed;
    }
  }

  // Those in view that are not behind the truth that their pixel or one of the eight around it
  // shows. Looked up first and asked then, so that one look does not wait for the other.
  void add_visible(const ProjectedSamples& samples, int count,
                   std::vector<float>& visible_px) const {
    double deepest_m[ProjectedSamples::kMost];
    for (int k = 0; k < count; ++k)
      deepest_m[k] = deepest_m_[true_hits_.index(samples.column[k], samples.row[k])];
    float shown[ProjectedSamples::kMost];
    int number = 0;
    for (int k = 0; k < count; ++k) {
      shown[number] = static_cast<float>(samples.pixels[k]);
      number += !std::isnan(samples.pixels[k]) &
                (samples.depth_m[k] <= deepest_m[k] * (1.0 + kHiddenByLess));
    }
    visible_px.insert(visible_px.end(), shown, shown + number);
  }

  // Samples with nothing drawn over them: voids, or of no triangle that exists, or missing.
  void add_missing(int first, int j, glm::ivec2 run, const DeviationRow& row,
                   RowErrors& errors) const {
    const terrain::Heightfield& field = truth_.field();
    const auto is_missing = [&](int k) {
      const int i = first + k;
      return !field.is_void(i, j) &&
             reference::exists_at(field, truth_.diagonal(), i * field.dx_m, j * field.dy_m);
    };
    const std::int64_t uncovered = errors.uncovered;
    for (int k = run.x; k < run.y; ++k) errors.uncovered += is_missing(k);
    if (errors.uncovered > uncovered)
      list(SampleFlaw::Kind::Uncovered, uncovered, first, j, run, row, is_missing, errors);
  }

  const HeightfieldTruth& truth_;
  const HitImage& true_hits_;
  const DrawnSurface& surface_;
  int most_listed_;
  ProjectingCamera camera_;
  ProjectSamples project_;
  std::vector<double> deepest_m_;  // of the truth's pixels, and the eight next to each
};

// The first of each kind of all rows.
std::vector<SampleFlaw> joined_flaws(const std::vector<RowErrors>& rows, int most_listed) {
  std::vector<SampleFlaw> all;
  int listed[3] = {0, 0, 0};
  for (const RowErrors& row : rows) {
    for (const SampleFlaw& flaw : row.listed) {
      if (listed[static_cast<std::size_t>(flaw.kind)]++ < most_listed) all.push_back(flaw);
    }
  }
  return all;
}

void keep_worse(WorstSample& worst, const WorstSample& other) {
  if (other.i >= 0 && (worst.i < 0 || other.error > worst.error)) worst = other;
}

}  // namespace

const char* name_of(SampleFlaw::Kind kind) {
  switch (kind) {
    case SampleFlaw::Kind::Uncovered:
      return "uncovered sample";
    case SampleFlaw::Kind::OverVoid:
      return "void drawn over";
    case SampleFlaw::Kind::Overlapped:
      return "overlapped sample";
  }
  return "?";
}

bool in_frustum(const Camera& camera, const glm::dvec3& point_m) {
  const glm::dvec3 view = to_view(camera, point_m);
  return view.z >= camera.near_m && view.z <= camera.far_m &&
         inside_image(camera, view_to_pixel(camera, view));
}

SampleErrors sample_errors(const HeightfieldTruth& truth, const HitImage& true_hits,
                           const DrawnSurface& surface, const Camera& camera, int most_listed) {
  const Camera local = relative_to(camera, truth.field().world_origin_m());
  const RowMeasure measure(truth, true_hits, surface, local, most_listed);
  std::vector<RowErrors> rows(static_cast<std::size_t>(truth.field().rows()));
  SampleErrors errors;
  const auto columns = static_cast<std::size_t>(truth.field().columns());
  errors.values_m = SampleMap(rows.size() * columns);
  errors.values_px = SampleMap(rows.size() * columns);
  for_each_sample_row(
      truth.field(), *surface.mesh, &errors.triangle_max_m, [&](int j, const DeviationRow& row) {
        const auto y = static_cast<std::size_t>(j);
        const auto part = [&](SampleMap& map) { return map.span().data() + y * columns; };
        rows[y] = measure(j, row, {part(errors.values_m), part(errors.values_px)});
      });
  errors.patch_max_m.assign(std::max<std::size_t>(1, surface.patches.size()), -1.0);
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
  errors.listed = joined_flaws(rows, most_listed);
  errors.metres = distribution_of(errors.values_m.span());
  errors.pixels = distribution_of(errors.values_px.span());
  std::vector<float> visible_px;
  for (const RowErrors& row : rows)
    visible_px.insert(visible_px.end(), row.visible_px.begin(), row.visible_px.end());
  errors.visible_pixels = distribution_of(visible_px);
  return errors;
}

}  // namespace plumb::audit
