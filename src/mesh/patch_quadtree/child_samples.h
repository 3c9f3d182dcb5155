// A patch's samples sorted by how they are foretold from its parent's.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid.h"
#include "mesh/patch_quadtree/patch_numbers.h"

namespace plumb::mesh::patch_quadtree {

/// Samples (i, j), i and j from -1 to n + 1, in four grids by their parity: Known ones, both even,
/// are the parent's; Centres, both odd, lie amid four of them; Across (i odd) and Up (j odd) lie
/// between two of them and two centres. Grids reach beyond the patch as far as the foretelling of
/// others needs, repeating what is at their rim.
///
/// Even i = 2 a is at a + 2, a from -2 to n/2 + 2; odd i = 2 a + 1 at a + 2, a from -2 to n/2 + 1.
struct ChildSamples {
  int n = 0;  // cells along the patch
  Grid<std::int32_t> known, centre, across, up;

  explicit ChildSamples(int patch_cells);
  /// Known from child (s, t)'s parent.
  void set_known(const Grid<std::int32_t>& parent, int s, int t);
  /// The patch's grid, put together and taken apart.
  Grid<std::int32_t> joined() const;
  void split(const Grid<std::int32_t>& patch);
  /// Repeats the rim of the centres beyond it, once they are there.
  void repeat_rim_of_centres();
};

/// What is foretold of a row: q = (value + 32) >> 6 is the nearest number, the sign of value - 64 q
/// tells on which side of it the truth lies rather; and how lively it is around, which tells how
/// far off that may be.
struct Foretold {
  std::vector<std::int32_t> value;    // 64ths
  std::vector<std::uint8_t> context;  // in [0, kContexts)
};
inline constexpr int kContexts = 20;

/// Of centres b in [-1, n/2], all a in [-1, n/2].
void foretell_centres(const ChildSamples& samples, int b, Foretold& row);
/// Of Across samples (2 a + 1, 2 b), b in [0, n/2], a in [-1, n/2].
void foretell_across(const ChildSamples& samples, int b, Foretold& row);
/// Of Up samples (2 a, 2 b + 1), b in [-1, n/2], a in [0, n/2].
void foretell_up(const ChildSamples& samples, int b, Foretold& row);

}  // namespace plumb::mesh::patch_quadtree
