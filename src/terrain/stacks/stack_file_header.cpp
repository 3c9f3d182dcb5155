#include "terrain/stacks/stack_file_header.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "core/little_endian.h"

namespace plumb::terrain {
namespace {

constexpr std::array<std::uint8_t, 8> kMagic{'S', 'T', 'A', 'C', 'K', 0x0d, 0x0a, 0x1a};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kEntryBytes = 4 + 4;

// Numbers in a row, to be written and to be read.
template <class Field>
auto numbers_in(Field& field) {
  return std::array{&field.dx_m, &field.dy_m, &field.voxel_m, &field.origin_m.x, &field.origin_m.y};
}

template <class Provenance>
auto texts_in(Provenance& p) {
  return std::array{&p.source, &p.format, &p.crs};
}

template <class Provenance>
auto window_in(Provenance& p) {
  return std::array{&p.file_columns, &p.file_rows, &p.window_x, &p.window_y};
}

template <class Provenance>
auto scales_in(Provenance& p) {
  return std::array{&p.height_scale, &p.height_offset_m, &p.largest_rounding_m};
}

template <class Provenance>
auto voids_in(Provenance& p) {
  return std::array{&p.voids_declared, &p.voids_not_finite};
}

void put_provenance(const Provenance& p, Bytes& bytes) {
  for (const std::string* text : texts_in(p)) put_text(*text, "what is known of a source", bytes);
  for (const int* number : window_in(p)) put(*number, bytes);
  put(p.is_local ? 1u : 0u, bytes);
  for (const double* number : scales_in(p)) put(*number, bytes);
  for (const std::int64_t* number : voids_in(p)) put(*number, bytes);
  put_size(p.assumptions.size(), "assumptions", bytes);
  for (const std::string& line : p.assumptions) put_text(line, "an assumption", bytes);
}

// Each text has its size before it, so that a false count ends with the bytes.
void take_provenance(LittleEndianReader& reader, Provenance& p) {
  for (std::string* text : texts_in(p)) *text = reader.text();
  for (int* number : window_in(p)) *number = reader.take<std::int32_t>();
  p.is_local = reader.take<std::uint32_t>() != 0;
  for (double* number : scales_in(p)) *number = reader.take<double>();
  for (std::int64_t* number : voids_in(p)) *number = reader.take<std::int64_t>();
  const auto count = reader.take<std::uint32_t>();
  for (std::uint32_t k = 0; k < count && !reader.overrun(); ++k)
    p.assumptions.push_back(reader.text());
}

void put_materials(const std::vector<MaterialInfo>& materials, Bytes& bytes) {
  put_size(materials.size(), "materials", bytes);
  for (const MaterialInfo& material : materials) {
    put_text(material.name, "a material's name", bytes);
    for (int k = 0; k < 3; ++k) put(material.colour[k], bytes);
  }
}

void take_materials(LittleEndianReader& reader, std::vector<MaterialInfo>& materials) {
  const auto count = reader.take<std::uint32_t>();
  for (std::uint32_t k = 0; k < count && !reader.overrun(); ++k) {
    MaterialInfo material{reader.text()};
    for (int channel = 0; channel < 3; ++channel) material.colour[channel] = reader.take<double>();
    materials.push_back(std::move(material));
  }
}

bool is_positive(double number) { return number > 0.0 && std::isfinite(number); }

bool are_finite(const glm::dvec3& colour) {
  return std::isfinite(colour.x) && std::isfinite(colour.y) && std::isfinite(colour.z);
}

std::string wrong_with(const StackFileHeader& header) {
  const StackField& field = header.field;
  if (field.columns < 1 || field.rows < 1 || field.voxels < 1 || header.block_rows < 1)
    return fmt::format("{} x {} stacks of {} voxels in blocks of {} rows are none", field.columns,
                       field.rows, field.voxels, header.block_rows);
  if (!is_positive(field.dx_m) || !is_positive(field.dy_m) || !is_positive(field.voxel_m) ||
      !std::isfinite(field.origin_m.x) || !std::isfinite(field.origin_m.y) ||
      !std::isfinite(field.low_m) || !std::isfinite(field.high_m()))
    return "a number of its header is none that it can be";
  if (field.materials.empty() || field.materials.size() > 256)
    return fmt::format("it has {} materials, a field has 1 to 256", field.materials.size());
  for (const MaterialInfo& material : field.materials) {
    if (!are_finite(material.colour)) return "a colour of its header is none";
  }
  return "";
}

}  // namespace

bool begins_as_stacks(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), bytes.begin());
}

Bytes first_part_of(const StackFirstPart& first) {
  Bytes bytes(kMagic.begin(), kMagic.end());
  put(kVersion, bytes);
  put(first.header_bytes, bytes);
  put(first.checksum, bytes);
  return bytes;
}

std::string read_first_part(std::span<const std::uint8_t> bytes, StackFirstPart& first) {
  if (bytes.size() < kStackFirstBytes || !begins_as_stacks(bytes)) return "it is no file of stacks";
  LittleEndianReader reader(bytes.subspan(kMagic.size()));
  const auto version = reader.take<std::uint32_t>();
  first.header_bytes = reader.take<std::uint32_t>();
  first.checksum = reader.take<std::uint64_t>();
  if (version != kVersion)
    return fmt::format("it is of format version {}, known is {}", version, kVersion);
  return "";
}

Bytes header_bytes(const StackFileHeader& header) {
  const StackField& field = header.field;
  Bytes bytes;
  for (const int size : {field.columns, field.rows, field.voxels, header.block_rows})
    put(size, bytes);
  for (const double* number : numbers_in(field)) put(*number, bytes);
  put(field.low_m, bytes);
  put(header.has_holes ? 1u : 0u, bytes);
  put_materials(field.materials, bytes);
  put_provenance(field.provenance, bytes);
  for (const StackBlockEntry& block : header.blocks) {
    put(block.size, bytes);
    put(block.checksum, bytes);
  }
  return bytes;
}

std::string read_header(std::span<const std::uint8_t> bytes, StackFileHeader& header) {
  LittleEndianReader reader(bytes);
  StackField& field = header.field;
  for (int* size : {&field.columns, &field.rows, &field.voxels, &header.block_rows})
    *size = reader.take<std::int32_t>();
  for (double* number : numbers_in(field)) *number = reader.take<double>();
  field.low_m = reader.take<float>();
  const auto holes = reader.take<std::uint32_t>();
  take_materials(reader, field.materials);
  take_provenance(reader, field.provenance);
  if (reader.overrun()) return "its header ends too early";
  if (holes > 1) return "its header names what is unknown";
  header.has_holes = holes == 1;
  if (std::string why = wrong_with(header); !why.empty()) return why;
  const std::int64_t needed = static_cast<std::int64_t>(kEntryBytes) * header.block_count();
  if (needed != static_cast<std::int64_t>(reader.left()))
    return fmt::format("its table has {} bytes, {} blocks need {}", reader.left(),
                       header.block_count(), needed);
  header.blocks.resize(static_cast<std::size_t>(header.block_count()));
  for (StackBlockEntry& block : header.blocks) {
    block.size = reader.take<std::uint32_t>();
    block.checksum = reader.take<std::uint32_t>();
  }
  return "";
}

}  // namespace plumb::terrain
