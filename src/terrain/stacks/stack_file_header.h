// What stands before the blocks of a file of stacks, as bytes. Not for users of the library.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/byte_stream.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

/// The fixed part: magic, version, size of the header and its checksum.
inline constexpr std::size_t kStackFirstBytes = 8 + 4 + 4 + 8;

struct StackFirstPart {
  std::uint32_t header_bytes = 0;
  std::uint64_t checksum = 0;  // of the header
};

bool begins_as_stacks(std::span<const std::uint8_t> bytes);
Bytes first_part_of(const StackFirstPart& first);
/// Why these kStackFirstBytes begin no file of stacks; empty if they do.
std::string read_first_part(std::span<const std::uint8_t> bytes, StackFirstPart& first);

/// A line of the table: how large a block is, and its checksum.
struct StackBlockEntry {
  std::uint32_t size = 0, checksum = 0;
};

struct StackFileHeader {
  StackField field;  // all but its stacks
  bool has_holes = false;
  int block_rows = 1;
  std::vector<StackBlockEntry> blocks;

  std::int64_t block_count() const {
    return (std::int64_t{field.rows} + block_rows - 1) / block_rows;
  }
};

/// The header's bytes, its table included. Throws std::invalid_argument if a part is too large.
Bytes header_bytes(const StackFileHeader& header);
/// Why the bytes are no header; empty if they are, and then all is read.
/// Nothing is allocated that the bytes are too few for.
std::string read_header(std::span<const std::uint8_t> bytes, StackFileHeader& header);

}  // namespace plumb::terrain
