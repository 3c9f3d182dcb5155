// Levels of detail of stacks: four stacks become one.
#pragma once

#include <vector>

#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

/// The field at half the resolution: stack (i, j) stands for (2 i, 2 j), (2 i + 1, 2 j) and those
/// north of them, by aggregate() of stack_aggregation.h.
///
/// columns, rows and voxels are halved and rounded up, spacings doubled, low_m kept: high_m() may
/// rise by a voxel of `finer`. The origin moves to the middle of its four stacks.
///
///   (1) Where a size is odd, the border column (row) counts twice.
///   (2) Holes are left out; four holes are a hole.
///   (3) The same bits on any number of threads.
///
/// high_m  where stacks end, and what is above is no air that votes for air below: that of the
///         finest field, whose voxels alone reach no farther; `finer`'s own, if left out
/// Source: [Löffler et al. 2011, section 3.1]
StackField halved(const StackField& finer, float high_m);
StackField halved(const StackField& finer);

/// The finest field and what halving makes of it, `levels` fields in all, of one interval of
/// heights: stacks of level L stand at the middle of 2^L x 2^L finest ones.
///
/// levels  1 to 31; beyond a field of one stack the next ones still double their spacing
/// Throws std::invalid_argument for another number, or a field that is not valid.
std::vector<StackField> stack_pyramid(StackField finest, int levels);

}  // namespace plumb::terrain
