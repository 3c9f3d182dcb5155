#include "terrain/raw_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/check.h"
#include "terrain/georeference.h"
#include "terrain/sample_decoding.h"

namespace plumb::terrain {
namespace {

std::uint32_t unsigned_at(const unsigned char* bytes, int size, ByteOrder order) {
  std::uint32_t value = 0;
  for (int k = 0; k < size; ++k) {
    const int from_low = order == ByteOrder::Little ? k : size - 1 - k;
    value |= static_cast<std::uint32_t>(bytes[k]) << (8 * from_low);
  }
  return value;
}

double value_at(const unsigned char* bytes, int size, ByteOrder order) {
  const std::uint32_t bits = unsigned_at(bytes, size, order);
  return size == 2 ? static_cast<double>(bits) : static_cast<double>(std::bit_cast<float>(bits));
}

/// " (513x513 would fit)" if the file could be a square; else empty.
std::string square_of(std::uintmax_t samples) {
  const auto side = static_cast<std::uintmax_t>(std::sqrt(static_cast<double>(samples)));
  for (const std::uintmax_t s : {side, side + 1}) {
    if (s > 0 && s * s == samples) return fmt::format(" ({}x{} would fit)", s, s);
  }
  return "";
}

RawSize checked_size(const std::string& file, const ReadOptions& options, int sample_bytes) {
  const std::uintmax_t bytes = std::filesystem::file_size(file);
  const auto per_sample = static_cast<std::uintmax_t>(sample_bytes);
  const std::string hint = bytes % per_sample == 0 ? square_of(bytes / per_sample) : "";
  if (!options.raw_size) {
    input_error("{}: bare samples state no size; give one with --raw WIDTHxHEIGHT{}", file, hint);
  }
  const RawSize size = *options.raw_size;
  const std::uintmax_t wanted = static_cast<std::uintmax_t>(size.columns) *
                                static_cast<std::uintmax_t>(size.rows) * per_sample;
  if (size.columns < 1 || size.rows < 1 || wanted != bytes) {
    input_error("{}: {} x {} samples of {} bytes are {} bytes, the file has {}{}", file,
                size.columns, size.rows, sample_bytes, wanted, bytes, hint);
  }
  return size;
}

}  // namespace

Heightfield read_raw(const std::string& file, const ReadOptions& options) {
  if (!options.crs.empty()) {
    input_error("{}: bare samples name no coordinate system to reproject from into {}", file,
                options.crs);
  }
  if (options.band != 1 || options.decode == Decode::TerrainRgb ||
      options.decode == Decode::Terrarium) {
    input_error("{}: bare samples have one band of heights, no colours", file);
  }
  const int bytes = file.ends_with("32") ? 4 : 2;
  const RawSize size = checked_size(file, options, bytes);
  const Window window = window_in(options, file, size.columns, size.rows);
  const Placement placement = place({}, window, options, file);
  SampleCoding of_file;
  if (bytes == 2) of_file.stored_as = SampleType::Uint16;
  HeightfieldBuilder builder(file, window.width, window.height, with_options(of_file, options),
                             true);
  std::ifstream input(file, std::ios::binary);
  std::vector<unsigned char> row_bytes(static_cast<std::size_t>(window.width) *
                                       static_cast<std::size_t>(bytes));
  std::vector<double> values(static_cast<std::size_t>(window.width));
  for (int row = 0; row < window.height; ++row) {
    const auto first = static_cast<std::streamoff>(window.y + row) * size.columns + window.x;
    input.seekg(first * bytes);
    input.read(reinterpret_cast<char*>(row_bytes.data()),
               static_cast<std::streamsize>(row_bytes.size()));
    if (!input) input_error("{}: row {} cannot be read", file, window.y + row);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = value_at(row_bytes.data() + i * static_cast<std::size_t>(bytes), bytes,
                           options.byte_order);
    }
    builder.add(row, {values, {}});
  }
  Heightfield field = builder.finish();
  Provenance& p = field.provenance;
  p.format = bytes == 2 ? "raw uint16" : "raw float32";
  p.file_columns = size.columns;
  p.file_rows = size.rows;
  p.window_x = window.x;
  p.window_y = window.y;
  settle(field, placement);
  return field;
}

}  // namespace plumb::terrain
