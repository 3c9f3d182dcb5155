#include "terrain/stacks/stack_file.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/atomic_file.h"
#include "core/check.h"
#include "core/hash.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "terrain/stacks/stack_block.h"
#include "terrain/stacks/stack_file_header.h"

namespace plumb::terrain {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostBytes = std::numeric_limits<std::uint32_t>::max();

std::uint32_t block_checksum(std::span<const std::uint8_t> block) {
  return static_cast<std::uint32_t>(Checksum().add_bytes(block.data(), block.size()).value());
}

// All of a field but its stacks.
StackField without_stacks(const StackField& field) {
  StackField rest;
  rest.columns = field.columns;
  rest.rows = field.rows;
  rest.dx_m = field.dx_m;
  rest.dy_m = field.dy_m;
  rest.voxel_m = field.voxel_m;
  rest.origin_m = field.origin_m;
  rest.low_m = field.low_m;
  rest.voxels = field.voxels;
  rest.materials = field.materials;
  rest.provenance = field.provenance;
  return rest;
}

// The rows of block `block` of the field: how many there are from the first on.
int rows_of(const StackFileHeader& header, std::int64_t block) {
  return static_cast<int>(std::min<std::int64_t>(
      header.block_rows, header.field.rows - block * std::int64_t{header.block_rows}));
}

int first_row_of(const StackFileHeader& header, std::int64_t block) {
  return static_cast<int>(block * std::int64_t{header.block_rows});
}

// What reads the blocks of a file in memory.
struct BlockReader {
  const StackFileHeader& header;
  const std::string& name;
  std::vector<std::span<const std::uint8_t>> blocks;

  [[noreturn]] void fail(const std::string& why) const {
    input_error("cannot read '{}': {}", name, why);
  }

  void place(std::span<const std::uint8_t> bytes) {
    std::uint64_t needed = 0;
    for (const StackBlockEntry& entry : header.blocks) needed += entry.size;
    if (needed != bytes.size())
      fail(fmt::format("it has {} bytes of stacks, its table says {}", bytes.size(), needed));
    std::size_t at = 0;
    for (const StackBlockEntry& entry : header.blocks) {
      blocks.push_back(bytes.subspan(at, entry.size));
      at += entry.size;
    }
  }

  // What is wrong with a block; empty if nothing is, and then `rows` are its.
  std::string read(std::size_t block, StackRows& rows) const {
    const int first = first_row_of(header, static_cast<std::int64_t>(block)),
              count = rows_of(header, static_cast<std::int64_t>(block));
    if (block_checksum(blocks[block]) != header.blocks[block].checksum)
      return fmt::format("rows {} to {} are damaged: the checksum differs", first,
                         first + count - 1);
    const StackBlockShape shape{header.field.columns, header.field.low_m, header.has_holes};
    if (!decode_rows(blocks[block], shape, count, rows))
      return fmt::format("rows {} to {} are not coded as stacks are", first, first + count - 1);
    return "";
  }

  std::vector<StackRows> read_all() const {
    std::vector<StackRows> rows(blocks.size());
    std::vector<std::string> wrong(blocks.size());
    parallel_for(static_cast<std::int64_t>(blocks.size()), 1, [&](std::int64_t block) {
      const auto k = static_cast<std::size_t>(block);
      wrong[k] = read(k, rows[k]);
    });
    for (const std::string& why : wrong) {
      if (!why.empty()) fail(why);
    }
    return rows;
  }
};

// Before anything is decoded: stacks that the file is too small for, or the memory.
void check_sizes(const BlockReader& reader) {
  const StackFileHeader& header = reader.header;
  const auto columns = static_cast<std::uint64_t>(header.field.columns);
  for (std::size_t k = 0; k < reader.blocks.size(); ++k) {
    const std::uint64_t stacks =
        columns * static_cast<std::uint64_t>(rows_of(header, static_cast<std::int64_t>(k)));
    if (reader.blocks[k].size() < least_bytes_of(stacks))
      reader.fail(fmt::format("{} bytes hold no {} stacks", reader.blocks[k].size(), stacks));
  }
  // First layers and holes, in blocks and in the field.
  const auto stacks = static_cast<std::int64_t>(header.field.size());
  if (stacks > std::numeric_limits<std::int64_t>::max() / 16)
    reader.fail(fmt::format("{} stacks are more than memory holds", stacks));
  require_memory(stacks * (header.has_holes ? 10 : 8), "the stacks of '" + reader.name + "'");
}

void append(StackRows&& rows, bool has_holes, StackField& field) {
  const auto first = static_cast<std::uint32_t>(field.end_m.size());
  for (std::size_t k = 1; k < rows.first_layer.size(); ++k)
    field.first_layer.push_back(first + rows.first_layer[k]);
  field.end_m.insert(field.end_m.end(), rows.end_m.begin(), rows.end_m.end());
  field.material.insert(field.material.end(), rows.material.begin(), rows.material.end());
  if (has_holes) field.holes.insert(field.holes.end(), rows.holes.begin(), rows.holes.end());
  rows = StackRows();
}

void take_blocks(const BlockReader& reader, StackField& field) {
  std::vector<StackRows> blocks = reader.read_all();
  std::uint64_t layers = 0;
  for (const StackRows& rows : blocks) layers += rows.end_m.size();
  if (layers > std::numeric_limits<std::uint32_t>::max())
    reader.fail(fmt::format("it has {} layers, a field has at most 2^32 - 1", layers));
  require_memory(static_cast<std::int64_t>(5 * layers), "the layers of '" + reader.name + "'");
  field.first_layer.reserve(field.size() + 1);
  field.end_m.reserve(layers);
  field.material.reserve(layers);
  if (reader.header.has_holes) field.holes.reserve(field.size());
  for (StackRows& rows : blocks) append(std::move(rows), reader.header.has_holes, field);
}

}  // namespace

Bytes stack_file_bytes(const StackField& field, int block_rows) {
  require(block_rows >= 1, "a block must have rows, got {}", block_rows);
  require_valid(field);
  for (const MaterialInfo& material : field.materials) {
    require(std::isfinite(material.colour.x) && std::isfinite(material.colour.y) &&
                std::isfinite(material.colour.z),
            "the colour of '{}' must be finite", material.name);
  }
  StackFileHeader header{without_stacks(field), !field.holes.empty(), block_rows, {}};
  std::vector<Bytes> blocks(static_cast<std::size_t>(header.block_count()));
  parallel_for(header.block_count(), 1, [&](std::int64_t block) {
    blocks[static_cast<std::size_t>(block)] =
        encode_rows(field, first_row_of(header, block), rows_of(header, block));
  });
  for (const Bytes& block : blocks) {
    require(block.size() <= kMostBytes, "a block must be under 4 GiB, got {} bytes", block.size());
    header.blocks.push_back({static_cast<std::uint32_t>(block.size()), block_checksum(block)});
  }
  const Bytes head = header_bytes(header);
  require(head.size() <= kMostBytes, "a header must be under 4 GiB, got {} bytes", head.size());
  Bytes bytes = first_part_of({static_cast<std::uint32_t>(head.size()),
                               Checksum().add_bytes(head.data(), head.size()).value()});
  bytes.insert(bytes.end(), head.begin(), head.end());
  for (const Bytes& block : blocks) bytes.insert(bytes.end(), block.begin(), block.end());
  return bytes;
}

void write_stacks(const fs::path& path, const StackField& field) {
  const Bytes bytes = stack_file_bytes(field);
  write_file_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

StackField stacks_of_bytes(const Bytes& file, const std::string& name) {
  StackFileHeader header;
  BlockReader reader{header, name, {}};
  const std::span bytes(file);
  StackFirstPart first;
  if (const std::string why =
          read_first_part(bytes.first(std::min(bytes.size(), kStackFirstBytes)), first);
      !why.empty())
    reader.fail(why);
  const std::span rest = bytes.subspan(kStackFirstBytes);
  if (rest.size() < first.header_bytes) reader.fail("it ends within its header");
  const std::span head = rest.first(first.header_bytes);
  if (Checksum().add_bytes(head.data(), head.size()).value() != first.checksum)
    reader.fail("its header is damaged: the checksum differs");
  if (const std::string why = read_header(head, header); !why.empty()) reader.fail(why);
  reader.place(rest.subspan(first.header_bytes));
  check_sizes(reader);
  StackField field = without_stacks(header.field);
  take_blocks(reader, field);
  try {
    require_valid(field);
  } catch (const std::invalid_argument& error) {
    reader.fail(error.what());
  }
  return field;
}

StackField read_stacks(const fs::path& path) {
  const std::string name = path.string();
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) input_error("cannot read '{}': {}", name, error.message());
  std::ifstream file(path, std::ios::binary);
  if (!file) input_error("cannot read '{}': {}", name, std::strerror(errno));
  Bytes bytes(std::min<std::uintmax_t>(size, kStackFirstBytes));
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  StackFirstPart first;  // what is no such file is not read to its end
  if (const std::string why = read_first_part(bytes, first); !why.empty())
    input_error("cannot read '{}': {}", name, why);
  require_memory(static_cast<std::int64_t>(size), "the file '" + name + "'");
  const std::size_t read = bytes.size();
  bytes.resize(size);
  if (!file.read(reinterpret_cast<char*>(bytes.data() + read),
                 static_cast<std::streamsize>(size - read)))
    input_error("cannot read '{}': it ends before byte {}", name, size);
  return stacks_of_bytes(bytes, name);
}

bool is_stack_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  Bytes bytes(8);
  return file.read(reinterpret_cast<char*>(bytes.data()), 8) && begins_as_stacks(bytes);
}

}  // namespace plumb::terrain
