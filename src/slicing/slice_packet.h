// The rays of a few neighbouring pixels through the boxes of a cut, one a lane of the processor's
// vectors: the ray-slicer's innermost loop.
#pragma once

#include <cstdint>

#include "core/instruction_set.h"
#include "terrain/stored_heights.h"

namespace plumb::slicing {

struct SliceBranch;
struct SliceBundle;

/// Heights on triangles whose diagonals alternate; at most 2^31 - 1 samples.
struct LaneHeights {
  terrain::StoredHeights samples;
  double cell_columns = 0.0, cell_rows = 0.0;
  double columns_per_m = 0.0, rows_per_m = 0.0;
};

/// What all rays of a picture share.
struct PacketScene {
  const SliceBranch* branches = nullptr;
  std::uint32_t root = 0;  // a branch
  const SliceBundle* bundles = nullptr;
  LaneHeights heights;
  double eye_m[3] = {};
  double near_t = 0.0, far_t = 0.0;
  double rounding_m = 0.0;  // more than that of a coordinate of anything here
};

/// Rays in, fragments out. All directions agree in the signs of x and of y, no coordinate of one is
/// below kStill in size.
struct SlicePacket {
  static constexpr int kMost = 8;
  static constexpr double kStill = 1e-200;

  int count = 0;
  double direction[3][kMost] = {}, inverse[3][kMost] = {};

  double t[kMost];              // of the fragment that is seen; +inf: none
  std::uint32_t bundle[kMost];  // kNoPrimitive: none
  std::int32_t tested[kMost];   // planes met on their quads
};

/// As walking the boxes and meeting plane after plane for each ray alone (ray_slicer.cpp) with a
/// triangulated lookup: the same bits, the same counts.
///
/// From one plane to the next a ray's height above the ground changes by no more than the spacing
/// times (L |d_h| + |d_z|) / |d_n|, L the steepest slope within the bundle's reach. So from a
/// fragment that lies above the ground, heights are looked up again only where one may pass: the
/// planes between are met and counted, and what is known of them is not asked for.
using SlicePackets = void (*)(const PacketScene& scene, SlicePacket& packet);

SlicePackets slice_packets(InstructionSet set);

}  // namespace plumb::slicing
