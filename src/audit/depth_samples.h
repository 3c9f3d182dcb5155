// A frame's depth beside the truth's in some thousand pixels. Not for users of the library.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "audit/depth_readings.h"
#include "audit/truth.h"
#include "core/camera.h"
#include "core/claim.h"
#include "core/hit_image.h"
#include "image/depth_file.h"

namespace plumb::audit {

/// A pixel's depth as it was read, none for what is no depth.
using DepthRanges = std::vector<std::optional<DepthRange>>;

/// How a reading's depths differ from the truth's; of pixels in which either shows terrain.
struct DepthDifference {
  double mean = 0.0;  // of |a - b| / max(a, b); 1 where one shows nothing
  std::int64_t pixels = 0;
};

/// Pixels of a grid over the frame, at most 4096, with their true depths.
class DepthSamples {
 public:
  /// `camera` as stated; true_hits is the truth through it. Both live as long as the samples.
  DepthSamples(const HeightfieldTruth& truth, const HitImage& true_hits,
               const image::DepthBuffer& buffer, const Camera& camera);

  std::size_t size() const { return pixels_.size(); }
  /// Of pixels in which the truth shows terrain.
  std::int64_t true_pixels() const;
  /// View depth through the stated camera, +inf for sky.
  const std::vector<double>& true_depths() const { return true_depths_; }
  /// The same through another camera.
  std::vector<double> depths_through(const Camera& camera) const;
  /// The same of another terrain.
  std::vector<double> depths_of(const HeightfieldTruth& truth, const Camera& camera) const;
  /// What the buffer holds, by a reading.
  DepthRanges ranges_of(const DepthReading& reading) const;
  float number_at(std::size_t k, const DepthMeaning& meaning) const;
  /// Where the frame's ground lies by the stated camera, relative to the terrain's origin.
  std::vector<glm::dvec3> points_of(const DepthRanges& ranges) const;
  /// Of the pixels in which either shows terrain, those that keep to the tolerance.
  double share_within(const DepthRanges& ranges, const Tolerance& tolerance) const;
  /// Mean difference from the truth of the pixels that show something: what is missing may be
  /// holes.
  double drawn_difference(const DepthRanges& ranges) const;

 private:
  struct Pixel {
    int x = 0, y = 0;
  };

  bool is_within(const DepthRange& range, std::size_t k, const Tolerance& tolerance) const;
  glm::dvec3 point_at(std::size_t k, double depth_m) const;

  const HeightfieldTruth& truth_;
  const image::DepthBuffer& buffer_;
  Camera camera_, local_;  // as stated, and relative to the terrain's origin
  std::vector<Pixel> pixels_;
  std::vector<double> true_depths_;
};

/// Depths that nothing rounded.
DepthRanges exact_ranges(const std::vector<double>& depths);

DepthDifference difference_of(const DepthRanges& ranges, const std::vector<double>& true_depths);

}  // namespace plumb::audit
