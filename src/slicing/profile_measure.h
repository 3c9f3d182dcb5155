// How fast this machine draws polygons and slices, and how well the cost model foretells a frame.
#pragma once

#include <cstdint>
#include <vector>

#include "core/camera.h"
#include "slicing/cost_profile.h"
#include "slicing/slicing_tree.h"

namespace plumb::slicing {

/// What was timed: the best of several runs, wall time on the threads that are allowed.
struct ProfileMeasurement {
  std::int64_t vertices = 0;   // as the model counts them, ten for eight triangles
  double vertices_s = 0.0;     // in so small a picture that pixels cost next to nothing
  std::int64_t fragments = 0;  // of slices, tested by rays
  double fragments_s = 0.0;

  /// Throws std::invalid_argument if nothing was drawn.
  CostProfile profile(const std::string& name) const;
};

/// Times the rasteriser with all leaves of the tree as polygons, and the ray-slicer with slices
/// alone. `camera` looks at the terrain, in world coordinates.
ProfileMeasurement measure_profile(const SlicingTree& tree, const Camera& camera, int runs = 5);

/// A frame of the hybrid.
struct ModelledFrame {
  double predicted_s = 0.0;  // by the cost model
  double measured_s = 0.0;   // best of several
};
ModelledFrame model_frame(const SlicingTree& tree, const Camera& camera, const CostProfile& profile,
                          int runs = 3);

/// How good predictions are: quartiles of predicted / measured, and the correlation of their
/// logarithms; 0 where there are less than two frames.
struct ModelQuality {
  double lower = 0.0, median = 0.0, upper = 0.0;
  double correlation = 0.0;
};
ModelQuality quality_of(const std::vector<ModelledFrame>& frames);

}  // namespace plumb::slicing
