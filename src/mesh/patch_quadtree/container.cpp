#include "mesh/patch_quadtree/container.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <mutex>

#include "core/check.h"
#include "core/hash.h"

namespace plumb::mesh::patch_quadtree {
namespace fs = std::filesystem;
namespace {

constexpr std::array<char, 8> kMagic{'P', 'L', 'U', 'M', 'B', '\r', '\n', '\x1a'};
// Magic, version, size of the header and its checksum.
constexpr std::size_t kFirstBytes = 8 + 4 + 4 + 8;
constexpr std::size_t kEntryBytes = 4 + 4;  // of the table: size and checksum of a record

// ---- little-endian numbers

template <class T>
void put(T value, Bytes& bytes) {
  using Word = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  const auto word = std::bit_cast<Word>(value);
  for (std::size_t k = 0; k < sizeof(T); ++k)
    bytes.push_back(static_cast<std::uint8_t>(word >> (8 * k)));
}

void put_bytes(std::span<const std::uint8_t> part, Bytes& bytes) {
  put(static_cast<std::uint32_t>(part.size()), bytes);
  bytes.insert(bytes.end(), part.begin(), part.end());
}

void put_text(const std::string& text, Bytes& bytes) {
  put_bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, bytes);
}

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : reader_(bytes) {}

  template <class T>
  T take() {
    using Word = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
    Word word = 0;
    for (std::size_t k = 0; k < sizeof(T); ++k) word |= Word{reader_.byte()} << (8 * k);
    return std::bit_cast<T>(word);
  }
  Bytes bytes() {
    const auto part = reader_.bytes(take<std::uint32_t>());
    return {part.begin(), part.end()};
  }
  std::string text() {
    const Bytes part = bytes();
    return {part.begin(), part.end()};
  }
  bool overrun() const { return reader_.overrun(); }

 private:
  ByteReader reader_;
};

std::uint32_t checksum_of(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(Checksum().add_bytes(bytes.data(), bytes.size()).value());
}

Bytes header_bytes(const ContainerHeader& h) {
  Bytes bytes;
  put(static_cast<std::uint32_t>(h.payload), bytes);
  put(static_cast<std::int32_t>(h.layout.columns), bytes);
  put(static_cast<std::int32_t>(h.layout.rows), bytes);
  put(static_cast<std::int32_t>(h.layout.patch_cells), bytes);
  put(static_cast<std::uint32_t>(h.quantiser.rule == StepRule::Same ? 0 : 1), bytes);
  for (const double number : {h.quantiser.step_m, h.quantiser.offset_m, h.quantiser.rounding_m,
                              h.error_m, h.dx_m, h.dy_m, h.origin_m.x, h.origin_m.y})
    put(number, bytes);
  put(h.terrain_checksum, bytes);
  put_text(h.source, bytes);
  put_text(h.crs, bytes);
  put_bytes(h.models, bytes);
  put_bytes(h.parameters, bytes);
  return bytes;
}

bool is_positive(double number) { return number > 0.0 && std::isfinite(number); }

// Why a header cannot be what it says; empty if it can.
std::string read_header(std::span<const std::uint8_t> bytes, ContainerHeader& h) {
  Reader reader(bytes);
  h.payload = static_cast<Payload>(reader.take<std::uint32_t>());
  const auto columns = reader.take<std::int32_t>(), rows = reader.take<std::int32_t>(),
             cells = reader.take<std::int32_t>();
  const auto rule = reader.take<std::uint32_t>();
  for (double* number : {&h.quantiser.step_m, &h.quantiser.offset_m, &h.quantiser.rounding_m,
                         &h.error_m, &h.dx_m, &h.dy_m, &h.origin_m.x, &h.origin_m.y})
    *number = reader.take<double>();
  h.terrain_checksum = reader.take<std::uint64_t>();
  h.source = reader.text();
  h.crs = reader.text();
  h.models = reader.bytes();
  h.parameters = reader.bytes();
  if (reader.overrun()) return "its header ends too early";
  if (rule > 1 || static_cast<std::uint32_t>(h.payload) > 2)
    return "its header names what is unknown";
  h.quantiser.rule = rule == 0 ? StepRule::Same : StepRule::DoublesWithLevel;
  if (!is_positive(h.quantiser.step_m) || !std::isfinite(h.quantiser.offset_m) ||
      !is_positive(h.error_m) || !is_positive(h.dx_m) || !is_positive(h.dy_m) ||
      !std::isfinite(h.origin_m.x) || !std::isfinite(h.origin_m.y))
    return "a number of its header is none that it can be";
  const bool sizes = columns >= 2 && rows >= 2 && cells >= 8 && cells <= 1024 &&
                     std::has_single_bit(static_cast<unsigned>(cells));
  if (!sizes) return fmt::format("{} x {} samples in patches of {} are none", columns, rows, cells);
  h.layout = layout_of(columns, rows, cells);
  return "";
}

// Records of heights: every patch, and of version 1 one more.
std::int64_t height_records(const ContainerHeader& h) {
  return h.layout.patch_count() + (h.version == CodecVersion::Published ? 1 : 0);
}

}  // namespace

Bytes container_bytes(const ContainerHeader& header, const ContainerRecords& records) {
  require(static_cast<std::int64_t>(records.heights.size()) == height_records(header) &&
              static_cast<std::int64_t>(records.payload.size()) == header.layout.patch_count(),
          "a container of {} patches got {} and {} records", header.layout.patch_count(),
          records.heights.size(), records.payload.size());
  Bytes head = header_bytes(header);
  for (const auto* stream : {&records.heights, &records.payload}) {
    for (const Bytes& record : *stream) {
      put(static_cast<std::uint32_t>(record.size()), head);
      put(checksum_of(record), head);
    }
  }
  Bytes bytes(kMagic.begin(), kMagic.end());
  put(static_cast<std::uint32_t>(header.version), bytes);
  put(static_cast<std::uint32_t>(head.size()), bytes);
  put(Checksum().add_bytes(head.data(), head.size()).value(), bytes);
  bytes.insert(bytes.end(), head.begin(), head.end());
  for (const auto* stream : {&records.heights, &records.payload}) {
    for (const Bytes& record : *stream) bytes.insert(bytes.end(), record.begin(), record.end());
  }
  return bytes;
}

struct Container::Parts {
  struct Entry {
    std::int64_t at = 0;
    std::uint32_t size = 0, checksum = 0;
  };

  fs::path path;
  ContainerHeader header;
  std::int64_t file_bytes = 0;
  std::vector<Entry> heights, payload;
  std::mutex mutex;  // of the file's place
  std::ifstream file;

  [[noreturn]] void fail(const std::string& why) const {
    input_error("cannot read '{}': {}", path.string(), why);
  }

  Bytes read(std::int64_t at, std::size_t size) {
    Bytes bytes(size);
    const std::lock_guard lock(mutex);
    file.clear();
    file.seekg(at);
    if (size > 0 &&
        !file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
      fail(fmt::format("it ends before byte {}", at + static_cast<std::int64_t>(size)));
    return bytes;
  }

  void read_table(std::span<const std::uint8_t> bytes, std::int64_t at) {
    Reader reader(bytes);
    for (auto* entries : {&heights, &payload}) {
      for (Entry& entry : *entries) {
        entry = {at, reader.take<std::uint32_t>(), reader.take<std::uint32_t>()};
        at += entry.size;
      }
    }
    if (at != file_bytes) fail(fmt::format("it has {} bytes, its table says {}", file_bytes, at));
  }

  void open() {
    std::error_code error;
    file_bytes = static_cast<std::int64_t>(fs::file_size(path, error));
    if (error) fail(error.message());
    file.open(path, std::ios::binary);
    if (!file) fail(std::strerror(errno));
    if (file_bytes < static_cast<std::int64_t>(kFirstBytes)) fail("it is no container of patches");
    const Bytes first = read(0, kFirstBytes);
    if (!std::equal(kMagic.begin(), kMagic.end(), first.begin(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }))
      fail("it is no container of patches");
    Reader reader(std::span<const std::uint8_t>(first).subspan(kMagic.size()));
    const auto version = reader.take<std::uint32_t>(), size = reader.take<std::uint32_t>();
    const auto checksum = reader.take<std::uint64_t>();
    if (version != 1 && version != 2)
      fail(fmt::format("it is of format version {}, known are 1 and 2", version));
    header.version = static_cast<CodecVersion>(version);
    const std::int64_t end = static_cast<std::int64_t>(kFirstBytes) + size;
    if (end > file_bytes) fail("it ends within its header");
    const Bytes head = read(kFirstBytes, size);
    if (Checksum().add_bytes(head.data(), head.size()).value() != checksum)
      fail("its header is damaged: the checksum differs");
    if (const std::string why = read_header(head, header); !why.empty()) fail(why);
    const std::int64_t count = header.layout.patch_count();
    const auto table = static_cast<std::int64_t>(kEntryBytes) * (height_records(header) + count);
    if (table > static_cast<std::int64_t>(head.size())) fail("its table ends too early");
    heights.resize(static_cast<std::size_t>(height_records(header)));
    payload.resize(static_cast<std::size_t>(count));
    read_table(std::span<const std::uint8_t>(head).last(static_cast<std::size_t>(table)), end);
  }

  Bytes record(const std::vector<Entry>& entries, std::int64_t number, const char* what) {
    require(number >= 0 && number < static_cast<std::int64_t>(entries.size()),
            "a record's number must be in [0, {}), got {}", entries.size(), number);
    const Entry& entry = entries[static_cast<std::size_t>(number)];
    Bytes bytes = read(entry.at, entry.size);
    if (checksum_of(bytes) != entry.checksum)
      fail(fmt::format("the {} of patch {} are damaged: the checksum differs", what, number));
    return bytes;
  }
};

Container::Container(const fs::path& path) : parts_(std::make_unique<Parts>()) {
  parts_->path = path;
  parts_->open();
}

Container::~Container() = default;

const ContainerHeader& Container::header() const { return parts_->header; }
std::int64_t Container::file_bytes() const { return parts_->file_bytes; }
Bytes Container::heights(std::int64_t record) const {
  return parts_->record(parts_->heights, record, "heights");
}
Bytes Container::payload(std::int64_t record) const {
  return parts_->record(parts_->payload, record, "bounds");
}

}  // namespace plumb::mesh::patch_quadtree
