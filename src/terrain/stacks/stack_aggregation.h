// One stack of material for up to four: the step of the stacks' levels of detail.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

/// What one aggregation gives, and the memory that it works in, which the next one uses again.
struct Aggregation {
  std::vector<Layer> layers;  // from low_m to high_m, air included; neighbours differ
  int by_thickness = 0;       // segments that step 3 decided

  /// A piece between two neighbouring boundaries of the stacks.
  struct Segment {
    float start_m = 0.0F, end_m = 0.0F;
    std::array<Material, 4> materials{};  // of each stack
    std::array<Material, 4> tied{};       // those with the largest count; one: it dominates
    int ties = 0;
  };
  std::vector<Segment> segments;
};

/// The stack that stands for one to four others.
///
///   1. The stacks are cut at every boundary of any of them; the pieces between are segments. A
///      segment is dominated by the one material that more of the stacks have there than any
///      other, or tied between several.
///   2. A dominated segment takes that material. A tied one looks at the segments 1, 2, ... below
///      and above: a side votes for the material that dominates the segment there, if it is among
///      the tied ones. At the first distance with a vote, one vote or two equal ones fill the
///      segment; two different ones part it in the middle, each to its own side.
///   3. Without a vote up to both ends: of the tied materials the one of the largest total
///      thickness in the whole stacks (summed from the bottom up), then any solid one before air,
///      then the lowest index.
///   4. Equal neighbours are joined.
///
/// stacks  1 to 4, of one low_m, with ends in (low_m, high_m]; above them is air
///
///   (1) The order of the stacks does not matter: counts alone are read, never a result.
///   (2) Turning all stacks upside down turns the result, as far as sums and middles are exact.
///   (3) Every end is an end of one of the stacks, but for the middles of parted segments, which
///       are rounded to a float.
/// Throws std::invalid_argument for another number of stacks or unequal low_m.
/// Source: [Löffler et al. 2011, section 3.1], its heuristic made complete.
void aggregate(std::span<const StackView> stacks, float high_m, Aggregation& result);

}  // namespace plumb::terrain
