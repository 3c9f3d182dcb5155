#include "terrain/png_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/check.h"
#include "terrain/memory_check.h"

namespace plumb::terrain {
namespace {

using Bytes = std::vector<unsigned char>;
constexpr std::array<unsigned char, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t kChunkFrame = 12;  // length, name and checksum

constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int k = 0; k < 8; ++k) c = (c & 1u) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    table[n] = c;
  }
  return table;
}

/// The checksum of PNG's chunks. Source: the PNG specification, annex D.
std::uint32_t crc32(const unsigned char* bytes, std::size_t size) {
  static constexpr std::array<std::uint32_t, 256> kTable = crc_table();
  std::uint32_t c = 0xffffffffu;
  for (std::size_t k = 0; k < size; ++k) c = kTable[(c ^ bytes[k]) & 0xffu] ^ (c >> 8);
  return ~c;
}

std::uint32_t big_endian(const unsigned char* b) {
  return (std::uint32_t{b[0]} << 24) | (std::uint32_t{b[1]} << 16) | (std::uint32_t{b[2]} << 8) |
         std::uint32_t{b[3]};
}

void check_header(const std::string& file, const unsigned char* data, std::size_t size) {
  const auto one_of = [](int value, std::initializer_list<int> allowed) {
    return std::find(allowed.begin(), allowed.end(), value) != allowed.end();
  };
  const bool fits = size == 13 && big_endian(data) - 1u < 0x7fffffffu &&
                    big_endian(data + 4) - 1u < 0x7fffffffu && data[10] == 0 && data[11] == 0 &&
                    data[12] < 2;
  bool depth_fits = false;
  if (fits && data[9] == 0) depth_fits = one_of(data[8], {1, 2, 4, 8, 16});
  if (fits && data[9] == 3) depth_fits = one_of(data[8], {1, 2, 4, 8});
  if (fits && one_of(data[9], {2, 4, 6})) depth_fits = one_of(data[8], {8, 16});
  if (!depth_fits) input_error("{}: its PNG header is damaged", file);
}

Bytes read_all(const std::string& file) {
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (failed) input_error("{}: the file cannot be read ({})", file, failed.message());
  if (size > available_memory_bytes()) {
    input_error("{}: needs {} bytes of memory, there are {}", file, size, available_memory_bytes());
  }
  Bytes bytes(static_cast<std::size_t>(size));
  std::ifstream input(file, std::ios::binary);
  if (!input.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    input_error("{}: the file cannot be read", file);
  }
  return bytes;
}

}  // namespace

std::vector<unsigned char> read_png_pixels(const std::string& file) {
  const Bytes bytes = read_all(file);
  if (bytes.size() < kSignature.size() ||
      !std::equal(kSignature.begin(), kSignature.end(), bytes.begin())) {
    input_error("{}: it is neither a PNG nor an OpenEXR file", file);
  }
  Bytes kept(kSignature.begin(), kSignature.end());
  bool has_header = false, has_pixels = false;
  for (std::size_t at = kSignature.size(); bytes.size() - at >= kChunkFrame;) {
    const unsigned char* chunk = bytes.data() + at;
    const std::size_t length = big_endian(chunk);
    if (bytes.size() - at - kChunkFrame < length) break;  // the file ends within it
    const std::string_view name(reinterpret_cast<const char*>(chunk) + 4, 4);
    if (crc32(chunk + 4, length + 4) != big_endian(chunk + 8 + length)) {
      input_error("{}: the PNG file is damaged (checksum at byte {})", file, at);
    }
    if (!has_header && name != "IHDR") input_error("{}: its PNG header is missing", file);
    if (name == "IHDR") check_header(file, chunk + 8, length);
    has_header = true;
    has_pixels = has_pixels || name == "IDAT";
    at += length + kChunkFrame;
    if (name == "IHDR" || name == "PLTE" || name == "tRNS" || name == "IDAT" || name == "IEND") {
      kept.insert(kept.end(), chunk, chunk + length + kChunkFrame);
    }
    if (name == "IEND" && has_pixels) return kept;
  }
  input_error("{}: the PNG file is cut off at byte {}", file, bytes.size());
}

}  // namespace plumb::terrain
