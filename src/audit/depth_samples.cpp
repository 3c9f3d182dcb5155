#include "audit/depth_samples.h"

#include <algorithm>
#include <cmath>

#include "audit/plan_fit.h"
#include "core/parallel.h"

namespace plumb::audit {
namespace {

constexpr int kMostSamples = 4096;  // pixels looked at
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool shows(const std::optional<DepthRange>& range) { return !range || !range->is_sky(); }

double difference(const std::optional<DepthRange>& range, double true_depth) {
  if (!range) return 1.0;
  if (range->low <= true_depth && true_depth <= range->high) return 0.0;
  if (range->is_sky() || !(true_depth < kInfinity)) return 1.0;
  const double depth = true_depth < range->low ? range->low : range->high;
  return std::abs(depth - true_depth) / std::max(depth, true_depth);
}

}  // namespace

DepthRanges exact_ranges(const std::vector<double>& depths) {
  DepthRanges ranges;
  ranges.reserve(depths.size());
  for (const double depth : depths) ranges.push_back(DepthRange{depth, depth, depth});
  return ranges;
}

DepthDifference difference_of(const DepthRanges& ranges, const std::vector<double>& true_depths) {
  DepthDifference all;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    if (!shows(ranges[k]) && !(true_depths[k] < kInfinity)) continue;
    all.mean += difference(ranges[k], true_depths[k]);
    ++all.pixels;
  }
  if (all.pixels > 0) all.mean /= static_cast<double>(all.pixels);
  return all;
}

DepthSamples::DepthSamples(const HeightfieldTruth& truth, const HitImage& true_hits,
                           const image::DepthBuffer& buffer, const Camera& camera)
    : truth_(truth),
      buffer_(buffer),
      camera_(camera),
      local_(relative_to(camera, truth.field().world_origin_m())) {
  const double all = static_cast<double>(camera.width_px) * camera.height_px;
  const int step = std::max(1, static_cast<int>(std::ceil(std::sqrt(all / kMostSamples))));
  for (int y = std::min(step, camera.height_px) / 2; y < camera.height_px; y += step) {
    for (int x = std::min(step, camera.width_px) / 2; x < camera.width_px; x += step) {
      pixels_.push_back({x, y});
      true_depths_.push_back(true_hits.depth_m[true_hits.index(x, y)]);
    }
  }
}

std::int64_t DepthSamples::true_pixels() const {
  return std::count_if(true_depths_.begin(), true_depths_.end(),
                       [](double depth) { return depth < kInfinity; });
}

std::vector<double> DepthSamples::depths_through(const Camera& camera) const {
  return camera == camera_ ? true_depths_ : depths_of(truth_, camera);
}

std::vector<double> DepthSamples::depths_of(const HeightfieldTruth& truth,
                                            const Camera& camera) const {
  std::vector<double> depths(pixels_.size());
  parallel_for(static_cast<std::int64_t>(pixels_.size()), 256, [&](std::int64_t k) {
    const Pixel& pixel = pixels_[static_cast<std::size_t>(k)];
    const reference::RayHit hit =
        truth.caster.cast(truth.caster.camera_ray(camera, pixel.x + 0.5, pixel.y + 0.5));
    depths[static_cast<std::size_t>(k)] = hit ? hit.t : kInfinity;
  });
  return depths;
}

DepthRanges DepthSamples::ranges_of(const DepthReading& reading) const {
  DepthRanges ranges(pixels_.size());
  for (std::size_t k = 0; k < pixels_.size(); ++k)
    ranges[k] =
        depth_range_at(buffer_, reading.meaning, reading.camera, pixels_[k].x, pixels_[k].y);
  return ranges;
}

float DepthSamples::number_at(std::size_t k, const DepthMeaning& meaning) const {
  return buffer_.values[stored_index(buffer_, meaning, pixels_[k].x, pixels_[k].y)];
}

glm::dvec3 DepthSamples::point_at(std::size_t k, double depth_m) const {
  return local_.eye_m + depth_m * ray_direction(local_, pixels_[k].x + 0.5, pixels_[k].y + 0.5);
}

std::vector<glm::dvec3> DepthSamples::points_of(const DepthRanges& ranges) const {
  std::vector<glm::dvec3> points;
  for (std::size_t k = 0; k < pixels_.size(); ++k) {
    if (ranges[k] && !ranges[k]->is_sky()) points.push_back(point_at(k, ranges[k]->value));
  }
  return points;
}

double DepthSamples::share_within(const DepthRanges& ranges, const Tolerance& tolerance) const {
  std::int64_t kept = 0, all = 0;
  for (std::size_t k = 0; k < pixels_.size(); ++k) {
    if (!shows(ranges[k]) && !(true_depths_[k] < kInfinity)) continue;
    ++all;
    const double off = difference(ranges[k], true_depths_[k]);
    kept += off == 0.0 || (off < 1.0 && is_within(*ranges[k], k, tolerance));
  }
  return static_cast<double>(kept) / std::max<double>(1.0, static_cast<double>(all));
}

bool DepthSamples::is_within(const DepthRange& range, std::size_t k,
                             const Tolerance& tolerance) const {
  const glm::dvec3 point = point_at(k, true_depths_[k] < range.low ? range.low : range.high);
  return keeps_to(tolerance, local_, point, truth_.height_at(point.x, point.y) - point.z);
}

double DepthSamples::drawn_difference(const DepthRanges& ranges) const {
  DepthDifference drawn;
  for (std::size_t k = 0; k < pixels_.size(); ++k) {
    if (!shows(ranges[k])) continue;
    drawn.mean += difference(ranges[k], true_depths_[k]);
    ++drawn.pixels;
  }
  return drawn.pixels > 0 ? drawn.mean / static_cast<double>(drawn.pixels) : 0.0;
}

}  // namespace plumb::audit
