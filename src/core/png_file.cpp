#include "core/png_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>

#include "core/check.h"

namespace plumb {
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
class Checksum {
 public:
  void add(const unsigned char* bytes, std::size_t size) {
    static constexpr std::array<std::uint32_t, 256> kTable = crc_table();
    for (std::size_t k = 0; k < size; ++k) c_ = kTable[(c_ ^ bytes[k]) & 0xffu] ^ (c_ >> 8);
  }
  std::uint32_t value() const { return ~c_; }

 private:
  std::uint32_t c_ = 0xffffffffu;
};

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

int bytes_per_pixel(const unsigned char* header) {
  const int depth = header[8], colour = header[9];
  const int channels = colour == 2 ? 3 : colour == 4 ? 2 : colour == 6 ? 4 : 1;
  return channels * std::max(1, depth / 8);
}

/// Reads a file once, from its start.
class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file), input_(file, std::ios::binary) {
    std::error_code failed;
    size_ = std::filesystem::file_size(file, failed);
    if (failed) input_error("{}: the file cannot be read ({})", file, failed.message());
  }
  std::uint64_t at() const { return at_; }
  std::uint64_t left() const { return size_ - at_; }

  void read(unsigned char* bytes, std::size_t size) {
    if (!input_.read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(size))) {
      input_error("{}: the file cannot be read", file_);
    }
    at_ += size;
  }

 private:
  const std::string& file_;
  std::ifstream input_;
  std::uint64_t size_ = 0, at_ = 0;
};

/// A chunk whose checksum fits.
struct Chunk {
  FilePart part;
  std::string name;
  Bytes header;  // the data of a chunk that is as short as a header
};

/// The chunk that the reader stands before; nothing if the file ends within it.
std::optional<Chunk> read_chunk(Reader& reader, const std::string& file) {
  Chunk chunk;
  std::array<unsigned char, 8> frame{};
  chunk.part.at = reader.at();
  if (reader.left() < kChunkFrame) return std::nullopt;
  reader.read(frame.data(), frame.size());
  const std::uint64_t length = big_endian(frame.data());
  if (reader.left() < length + 4) return std::nullopt;
  chunk.part.size = length + kChunkFrame;
  chunk.name.assign(reinterpret_cast<const char*>(frame.data()) + 4, 4);
  Checksum sum;
  sum.add(frame.data() + 4, 4);
  Bytes some(static_cast<std::size_t>(std::min<std::uint64_t>(length, 65536)));
  for (std::uint64_t done = 0; done < length;) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(length - done, some.size()));
    reader.read(some.data(), count);
    sum.add(some.data(), count);
    done += count;
  }
  if (length <= 13) chunk.header = some;
  reader.read(frame.data(), 4);
  if (sum.value() != big_endian(frame.data())) {
    input_error("{}: the PNG file is damaged (checksum at byte {})", file, chunk.part.at);
  }
  return chunk;
}

/// Adds a part, to the one before where they touch.
void add(std::vector<FilePart>& parts, const FilePart& more) {
  if (parts.back().at + parts.back().size == more.at) {
    parts.back().size += more.size;
  } else {
    parts.push_back(more);
  }
}

}  // namespace

PngFile check_png(const std::string& file) {
  Reader reader(file);
  std::array<unsigned char, kSignature.size()> signature{};
  if (reader.left() >= signature.size()) reader.read(signature.data(), signature.size());
  if (signature != kSignature) input_error("{}: it is neither a PNG nor an OpenEXR file", file);
  PngFile png;
  png.parts = {{0, signature.size()}};
  bool has_header = false, has_pixels = false;
  while (const auto chunk = read_chunk(reader, file)) {
    const std::string& name = chunk->name;
    if (!has_header && name != "IHDR") input_error("{}: its PNG header is missing", file);
    if (name == "IHDR") {
      const Bytes& header = chunk->header;
      check_header(file, header.data(), header.size());
      png.columns = static_cast<int>(big_endian(header.data()));
      png.rows = static_cast<int>(big_endian(header.data() + 4));
      png.interlaced_bytes = header[12] == 1 ? bytes_per_pixel(header.data()) : 0;
    }
    has_header = true;
    has_pixels = has_pixels || name == "IDAT";
    if (name == "IHDR" || name == "PLTE" || name == "tRNS" || name == "IDAT" || name == "IEND") {
      add(png.parts, chunk->part);
    }
    if (name == "IEND" && has_pixels) return png;
  }
  input_error("{}: the PNG file is cut off at byte {}", file, std::filesystem::file_size(file));
}

}  // namespace plumb
