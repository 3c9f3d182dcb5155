// What a row's deviations come to on the screen: the projection of every height sample, in lanes.
#pragma once

#include <cstdint>

#include "audit/cover_row.h"
#include "core/camera.h"
#include "core/instruction_set.h"

namespace plumb::audit {

/// Some samples of one row, side by side; the arrays are a CoverRow's, with its padding.
struct SampleRun {
  static constexpr int kPadding = CoverRow::kPadding;

  double y_m, dx_m;        // of the row, and between its samples
  int first, count;        // columns; at most ProjectedSamples::kMost of them
  const float* heights_m;  // of sample `first`, as the next ones; NaN: void
  const double* delta_m;   // drawn minus truth
  const double* triangle;  // drawn there; negative: none
};

/// What is known of them then.
struct ProjectedSamples {
  static constexpr int kMost = 256;
  static constexpr int kRoom = kMost + SampleRun::kPadding;

  double metres[kRoom];   // |delta|; NaN: nothing drawn, or a void
  double pixels[kRoom];   // on the screen; NaN also outside the frustum, +inf behind the eye
  double depth_m[kRoom];  // means something where `pixels` is a number
  std::int32_t column[kRoom], row[kRoom];  // the picture's pixel; of the picture in any case
};

/// The camera as a kernel reads it.
struct ProjectingCamera {
  explicit ProjectingCamera(const Camera& local);

  Camera camera;
  glm::dvec3 up;  // the terrain's, in view coordinates
};

/// Fills `to` with the bits that to_view, view_to_pixel and screen_displacement_px give, and raises
/// `pixels_per_metre` to the largest displacement of a vertical metre at one of these samples.
using ProjectSamples = void (*)(const ProjectingCamera& camera, const SampleRun& run,
                                ProjectedSamples& to, double& pixels_per_metre);

ProjectSamples project_samples(InstructionSet set);

}  // namespace plumb::audit
