#include "mesh/patch_quadtree/container_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/hash.h"
#include "core/little_endian.h"

namespace plumb::mesh::patch_quadtree {
namespace {

constexpr std::array<std::uint8_t, 8> kMagic{'P', 'L', 'U', 'M', 'B', 0x0d, 0x0a, 0x1a};
constexpr std::int64_t kEntryBytes = 4 + 4;
constexpr double kMostCells = 2147483646.0;  // of a terrain: two triangles each in 32 bits

bool is_positive(double number) { return number > 0.0 && std::isfinite(number); }

// The header's numbers in a row, to be written and to be read.
template <class Header>
auto numbers_in(Header& h) {
  return std::array{&h.quantiser.step_m,
                    &h.quantiser.offset_m,
                    &h.quantiser.rounding_m,
                    &h.error_m,
                    &h.dx_m,
                    &h.dy_m,
                    &h.origin_m.x,
                    &h.origin_m.y};
}

std::string wrong_with_sizes(int columns, int rows, int cells) {
  const bool possible = columns >= 2 && rows >= 2 && cells >= 8 && cells <= 1024 &&
                        std::has_single_bit(static_cast<unsigned>(cells));
  if (!possible)
    return fmt::format("{} x {} samples in patches of {} are none", columns, rows, cells);
  if ((columns - 1.0) * (rows - 1.0) > kMostCells)
    return fmt::format("{} x {} samples have more than the 2^31 - 2 cells that a terrain may have",
                       columns, rows);
  return "";
}

void take_entries(LittleEndianReader& reader, std::int64_t count,
                  std::vector<TableEntry>& entries) {
  entries.resize(static_cast<std::size_t>(count));
  for (TableEntry& entry : entries) {
    entry.size = reader.take<std::uint32_t>();
    entry.checksum = reader.take<std::uint32_t>();
  }
}

}  // namespace

bool begins_with_magic(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

Bytes first_part(const FirstPart& first) {
  Bytes bytes(kMagic.begin(), kMagic.end());
  put(static_cast<std::uint32_t>(first.version), bytes);
  put(first.header_bytes, bytes);
  put(first.checksum, bytes);
  return bytes;
}

std::string read_first_part(std::span<const std::uint8_t> bytes, FirstPart& first) {
  if (bytes.size() < kFirstBytes || !begins_with_magic(bytes))
    return "it is no container of patches";
  LittleEndianReader reader(bytes.subspan(kMagic.size()));
  const auto version = reader.take<std::uint32_t>();
  first.header_bytes = reader.take<std::uint32_t>();
  first.checksum = reader.take<std::uint64_t>();
  if (version != 1 && version != 2)
    return fmt::format("it is of format version {}, known are 1 and 2", version);
  first.version = static_cast<CodecVersion>(version);
  return "";
}

std::uint32_t record_checksum(std::span<const std::uint8_t> record) {
  return static_cast<std::uint32_t>(Checksum().add_bytes(record.data(), record.size()).value());
}

std::int64_t height_records(const ContainerHeader& header) {
  return header.layout.patch_count() + (header.version == CodecVersion::Published ? 1 : 0);
}

std::string wrong_with(const ContainerHeader& h) {
  const PatchLayout& layout = h.layout;
  if (std::string why = wrong_with_sizes(layout.columns, layout.rows, layout.patch_cells);
      !why.empty())
    return why;
  const Quantiser& q = h.quantiser;
  if (!is_positive(q.step_m) || !std::isfinite(q.offset_m) || !std::isfinite(q.rounding_m) ||
      !is_positive(h.error_m) || !is_positive(h.dx_m) || !is_positive(h.dy_m) ||
      !std::isfinite(h.origin_m.x) || !std::isfinite(h.origin_m.y))
    return "a number of its header is none that it can be";
  if ((q.rule == StepRule::DoublesWithLevel) != (h.version == CodecVersion::Published))
    return "its step rule is that of the other format version";
  const double highest =
      static_cast<double>(most_number(q.rule)) * q.step(layout.levels - 1) + std::abs(q.offset_m);
  if (!(highest <= double{std::numeric_limits<float>::max()}))
    return fmt::format("numbers of {:g} m each are beyond single precision", q.step_m);
  return "";
}

Bytes header_bytes(const ContainerHeader& h, const RecordTable& table) {
  Bytes bytes;
  put(static_cast<std::uint32_t>(h.payload), bytes);
  for (const std::int32_t size : {h.layout.columns, h.layout.rows, h.layout.patch_cells})
    put(size, bytes);
  put(static_cast<std::uint32_t>(h.quantiser.rule == StepRule::Same ? 0 : 1), bytes);
  for (const double* number : numbers_in(h)) put(*number, bytes);
  put(h.terrain_checksum, bytes);
  put_text(h.source, "the terrain's source", bytes);
  put_text(h.crs, "the coordinate system", bytes);
  put_bytes(h.models, "the models", bytes);
  put_bytes(h.parameters, "the payload's parameters", bytes);
  for (const auto* entries : {&table.heights, &table.payload}) {
    for (const TableEntry& entry : *entries) {
      put(entry.size, bytes);
      put(entry.checksum, bytes);
    }
  }
  return bytes;
}

std::string read_header(std::span<const std::uint8_t> bytes, ContainerHeader& h,
                        RecordTable& table) {
  LittleEndianReader reader(bytes);
  const auto payload = reader.take<std::uint32_t>();
  const auto columns = reader.take<std::int32_t>(), rows = reader.take<std::int32_t>(),
             cells = reader.take<std::int32_t>();
  const auto rule = reader.take<std::uint32_t>();
  for (double* number : numbers_in(h)) *number = reader.take<double>();
  h.terrain_checksum = reader.take<std::uint64_t>();
  h.source = reader.text();
  h.crs = reader.text();
  h.models = reader.bytes();
  h.parameters = reader.bytes();
  if (reader.overrun()) return "its header ends too early";
  if (rule > 1 || payload > 2) return "its header names what is unknown";
  h.payload = static_cast<Payload>(payload);
  h.quantiser.rule = rule == 0 ? StepRule::Same : StepRule::DoublesWithLevel;
  if (std::string why = wrong_with_sizes(columns, rows, cells); !why.empty()) return why;
  h.layout = layout_of(columns, rows, cells);
  if (std::string why = wrong_with(h); !why.empty()) return why;
  const std::int64_t heights = height_records(h), patches = h.layout.patch_count();
  if (kEntryBytes * (heights + patches) != static_cast<std::int64_t>(reader.left()))
    return fmt::format("its table has {} bytes, {} patches need {}", reader.left(), patches,
                       kEntryBytes * (heights + patches));
  take_entries(reader, heights, table.heights);
  take_entries(reader, patches, table.payload);
  return "";
}

}  // namespace plumb::mesh::patch_quadtree
