// The planes of one bundle along one ray, several at once: the ray-slicer's innermost loop.
#pragma once

#include <cstdint>

#include "core/instruction_set.h"

namespace plumb::slicing {

/// Heights on triangles whose diagonals alternate; at most 2^31 - 1 samples.
struct PlaneRunHeights {
  const float* heights_m = nullptr;  // row by row
  std::int32_t columns = 0;          // of samples
  double cell_columns = 0.0, cell_rows = 0.0;
  double columns_per_m = 0.0, rows_per_m = 0.0;
};

/// Planes first_plane, first_plane + step, ... of a bundle, nearest first.
struct PlaneRun {
  double eye_m[3], direction[3];
  double inverse;  // of the direction along `axis`
  int axis;
  double first_plane, step;  // whole numbers
  int count;
  double first_m, spacing_m;   // of plane 0, and from one to the next
  double low_m[3], high_m[3];  // of the bundle's reach
  double near_t, far_t, best_t;
  double raise_m, least_z_m, greatest_z_m;
};

/// Where the run ends: at the first plane that passes, or that lies behind best_t, or nowhere.
struct PlaneRunEnd {
  int plane = -1;           // of the run, from 0: the one that passes; -1 if none does
  double t = 0.0;           // where it is met
  std::int64_t tested = 0;  // planes met on their quads, the last one included if it passes
};

/// As asking plane after plane (ray_slicer.cpp) with a triangulated lookup, to the bit.
using MeetPlanes = PlaneRunEnd (*)(const PlaneRun& run, const PlaneRunHeights& heights);

MeetPlanes meet_planes(InstructionSet set);

}  // namespace plumb::slicing
