// Many rays from one point at once through the pyramid, one a lane of the processor's vectors.
#pragma once

#include <cstdint>

#include "core/instruction_set.h"
#include "terrain/stored_heights.h"

namespace plumb::reference {

/// What all rays of a frame share: the surface, the eye, and how much rounding may hide. Lengths
/// across are in cells, heights in metres, as careful_walk.h has them.
struct LaneScene {
  static constexpr int kLevels = 16;  // levels of the pyramid that lanes use, 0 .. 15

  terrain::StoredHeights heights;
  // Pairs (low, high) of nodes, level after level, stored as the heights are; the other is null.
  const float* ranges;
  const std::uint16_t* range_codes;
  double columns;  // samples in a row
  double cell_columns, cell_rows;
  double level_begin[kLevels];  // index of the level's first range
  double
      level_row[kLevels];  // ranges that one cell upwards is worth: columns of the level / 2^level
  double level_column[kLevels];  // ranges that one cell across is worth: 2^-level
  int top_level;                 // coarsest level that lanes use
  enum class Cut { Alternating, Fixed, Blocks8 } cut;

  double dx_m, dy_m;
  double u, v, z;                    // the eye
  double t_min, t_max;               // of every ray
  double lowest, highest;            // slab of heights outside of which nothing is met
  double height_slack, place_slack;  // more than the roundings of a height, and of a place
};

/// Rays in, hits out.
struct LaneRays {
  static constexpr int kMost = 256;
  static constexpr int kPadded = kMost + 8;

  int count;
  double t_begin;   // nothing is met before, on any of them
  int begin_level;  // level of the nodes at which they begin, 1 .. top_level
  double direction_x[kPadded], direction_y[kPadded], direction_z[kPadded];

  double t[kPadded];  // +inf: no hit; of an undecided ray, where the careful walk may begin
  std::uint32_t triangle[kPadded];  // kNoPrimitive: no hit
  bool undecided[kPadded];          // nearer to an edge than rounding can tell, or along the grid
};

/// Finds the first hit of every ray, front to back through the pyramid, without a stack: a node
/// that the ray passes over or under is left for its neighbour (one level up where the parent ends
/// too), any other is entered.
///
///   (1) A ray that is not marked undecided has the bits that the careful walk gives it.
///   (2) The same bits, and the same marks, with every instruction set.
using LaneWalk = void (*)(const LaneScene&, LaneRays&);

LaneWalk lane_walk(InstructionSet set);

}  // namespace plumb::reference
