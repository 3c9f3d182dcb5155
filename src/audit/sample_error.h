// The error at every height sample: what the methods promise, and what needs no ray.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "audit/distribution.h"
#include "audit/truth.h"
#include "core/camera.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"

namespace plumb::audit {

/// The sample that is farthest off.
struct WorstSample {
  int i = -1, j = -1;    // column and row of the heightfield; -1 if there is none
  double error = 0.0;    // metres or pixels
  double delta_m = 0.0;  // drawn minus true
  std::uint32_t triangle = kNoPrimitive;
  int patch = -1;
};

/// A sample where the drawn surface is not one sheet over the terrain.
struct SampleFlaw {
  enum class Kind : std::uint8_t { Uncovered, OverVoid, Overlapped };
  Kind kind = Kind::Uncovered;
  int i = 0, j = 0;                       // column and row of the heightfield
  std::uint32_t triangle = kNoPrimitive;  // over it; kNoPrimitive where nothing is drawn
};

const char* name_of(
    SampleFlaw::Kind kind);  // "uncovered sample", "void drawn over", "overlapped sample"

/// A float for each sample that its rows' tasks fill: nobody writes it before them.
class SampleMap {
 public:
  SampleMap() = default;
  explicit SampleMap(std::size_t size)
      : values_(std::make_unique_for_overwrite<float[]>(size)), size_(size) {}

  std::span<float> span() { return {values_.get(), size_}; }
  std::span<const float> span() const { return {values_.get(), size_}; }

 private:
  std::unique_ptr<float[]> values_;
  std::size_t size_ = 0;
};

struct SampleErrors {
  SampleMap
      values_m;  // a sample each, row by row from the south; NaN: void, or nothing drawn there
  SampleMap values_px;          // NaN also outside the frustum
  Distribution metres, pixels;  // of these
  Distribution visible_pixels;  // of those that the truth shows, or hides by less than a pixel
  WorstSample worst_m, worst_px;
  std::vector<float>
      triangle_max_m;  // a triangle each, over the samples that it covers, edges included
  std::vector<double> patch_max_m;  // a patch each; -1 where a patch holds no sample
  std::int64_t uncovered = 0;       // samples of the surface with nothing drawn over them
  std::int64_t over_void = 0;       // void samples with something drawn over them
  std::int64_t overlapped = 0;      // samples in the inside of more than one triangle
  std::vector<SampleFlaw> listed;   // the first of each kind, row by row from the south, at most
                                    // `most_listed` of a kind
  double pixels_per_metre =
      0.0;  // largest displacement on screen of a vertical metre, of the samples in the frustum
};

/// Vertical deviation of the drawn surface at every sample, in metres and projected: |proj(p + dz)
/// - proj(p)|. A sample counts as part of the surface if one of its triangles exists.
SampleErrors sample_errors(const HeightfieldTruth& truth, const HitImage& true_hits,
                           const DrawnSurface& surface, const Camera& camera, int most_listed = 20);

/// True if the point (in the camera's coordinates) is between near and far and inside the image.
bool in_frustum(const Camera& camera, const glm::dvec3& point_m);

}  // namespace plumb::audit
