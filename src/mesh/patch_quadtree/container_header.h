// What stands before the records of a container of patches, as bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/byte_stream.h"
#include "mesh/patch_quadtree/container.h"

namespace plumb::mesh::patch_quadtree {

/// The fixed part: magic, version, size of the header and its checksum.
inline constexpr std::size_t kFirstBytes = 8 + 4 + 4 + 8;

struct FirstPart {
  CodecVersion version = CodecVersion::Modelled;
  std::uint32_t header_bytes = 0;
  std::uint64_t checksum = 0;  // of the header
};

bool begins_with_magic(std::span<const std::uint8_t> bytes);
Bytes first_part(const FirstPart& first);
/// Why these kFirstBytes begin no container; empty if they do.
std::string read_first_part(std::span<const std::uint8_t> bytes, FirstPart& first);

/// A line of the table: how large a record is, and its checksum.
struct TableEntry {
  std::uint32_t size = 0, checksum = 0;
};
std::uint32_t record_checksum(std::span<const std::uint8_t> record);

/// The table's lines: heights first, then the payload's.
struct RecordTable {
  std::vector<TableEntry> heights, payload;
};

/// Records of heights: every patch, and of version 1 one more, the root's.
std::int64_t height_records(const ContainerHeader& header);

/// Why no file can have such a header, `version` known; empty if one can: sizes that no terrain
/// has, numbers that are none, a step rule of the other version, heights that no float holds.
std::string wrong_with(const ContainerHeader& header);

/// The header's bytes, its table included. Throws std::invalid_argument if a part is too large.
Bytes header_bytes(const ContainerHeader& header, const RecordTable& table);
/// Why the bytes are no header of `header.version`; empty if they are, and then all is read.
/// Nothing is allocated that the bytes are too few for.
std::string read_header(std::span<const std::uint8_t> bytes, ContainerHeader& header,
                        RecordTable& table);

}  // namespace plumb::mesh::patch_quadtree
