// A field of stacks whose rows are made beside one another.
#pragma once

#include <functional>

#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

/// Writes the stacks of row j. Called for different rows at the same time.
using StackRowFiller = std::function<void(int j, StackWriter& row)>;

/// The field whose sizes, spacing, heights and materials are those of `shape`, its rows filled on
/// all threads.
///
///   (1) The same bits on any number of threads.
/// Throws std::invalid_argument if a row is not filled, or if there are more than 2^32 - 1 layers;
/// passes on what fill throws.
StackField field_of_rows(StackField shape, const StackRowFiller& fill);

}  // namespace plumb::terrain
