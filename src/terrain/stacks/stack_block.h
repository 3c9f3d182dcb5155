// Rows of stacks as bytes, heights exact to the bit. Not for users of the library.
// Byte by byte in docs/formats/plumb-stacks.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/byte_stream.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

/// Stacks row by row, each from west to east, as StackField has them.
struct StackRows {
  std::vector<std::uint32_t> first_layer = {0};
  std::vector<float> end_m;
  std::vector<Material> material;
  std::vector<std::uint8_t> holes;  // one for each stack, or empty where the field has none
};

/// What every block of a file shares.
struct StackBlockShape {
  int columns = 0;
  float low_m = 0.0F;
  bool has_holes = false;
};

/// The field's rows [first, first + count).
Bytes encode_rows(const StackField& field, int first, int count);

/// The fewest bytes that so many stacks have: a damaged size is told before memory is asked for.
std::uint64_t least_bytes_of(std::uint64_t stacks);

/// False if the bytes are not those of `count` rows. What is read may still be no valid stacks.
///
///   (1) Nothing is allocated that the bytes are too few for.
bool decode_rows(std::span<const std::uint8_t> bytes, const StackBlockShape& shape, int count,
                 StackRows& rows);

}  // namespace plumb::terrain
