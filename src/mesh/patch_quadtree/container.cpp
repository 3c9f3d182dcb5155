#include "mesh/patch_quadtree/container.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <mutex>
#include <utility>

#include "core/check.h"
#include "core/hash.h"
#include "core/memory.h"
#include "mesh/patch_quadtree/container_header.h"

namespace plumb::mesh::patch_quadtree {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostBytes = std::numeric_limits<std::uint32_t>::max();

std::vector<TableEntry> entries_of(const std::vector<Bytes>& records) {
  std::vector<TableEntry> entries;
  for (const Bytes& record : records) {
    require(record.size() <= kMostBytes, "a record must be under 4 GiB, got {} bytes",
            record.size());
    entries.push_back({static_cast<std::uint32_t>(record.size()), record_checksum(record)});
  }
  return entries;
}

}  // namespace

Bytes container_bytes(const ContainerHeader& header, const ContainerRecords& records) {
  require(static_cast<std::int64_t>(records.heights.size()) == height_records(header) &&
              static_cast<std::int64_t>(records.payload.size()) == header.layout.patch_count(),
          "a container of {} patches got {} and {} records", header.layout.patch_count(),
          records.heights.size(), records.payload.size());
  const RecordTable table{entries_of(records.heights), entries_of(records.payload)};
  const Bytes head = header_bytes(header, table);
  require(head.size() <= kMostBytes,
          "a container's header must be under 4 GiB, got {} bytes: larger patches need less",
          head.size());
  Bytes bytes = first_part({header.version, static_cast<std::uint32_t>(head.size()),
                            Checksum().add_bytes(head.data(), head.size()).value()});
  std::size_t all = bytes.size() + head.size();
  for (const auto* stream : {&records.heights, &records.payload}) {
    for (const Bytes& record : *stream) all += record.size();
  }
  bytes.reserve(all);
  bytes.insert(bytes.end(), head.begin(), head.end());
  for (const auto* stream : {&records.heights, &records.payload}) {
    for (const Bytes& record : *stream) bytes.insert(bytes.end(), record.begin(), record.end());
  }
  return bytes;
}

struct Container::Parts {
  struct Record {
    std::int64_t at = 0;
    TableEntry entry;
  };

  std::string name;
  ContainerHeader header;
  std::int64_t file_bytes = 0;
  std::vector<Record> heights, payload;
  Bytes memory;      // the whole file, or:
  std::mutex mutex;  // of the file's place
  std::ifstream file;

  [[noreturn]] void fail(const std::string& why) const {
    input_error("cannot read '{}': {}", name, why);
  }

  void open_file(const fs::path& path) {
    std::error_code error;
    file_bytes = static_cast<std::int64_t>(fs::file_size(path, error));
    if (error) fail(error.message());
    file.open(path, std::ios::binary);
    if (!file) fail(std::strerror(errno));
  }

  Bytes read(std::int64_t at, std::size_t size) {
    const std::int64_t end = at + static_cast<std::int64_t>(size);
    if (end > file_bytes) fail(fmt::format("it ends before byte {}", end));
    if (!file.is_open()) return Bytes(memory.begin() + at, memory.begin() + end);
    Bytes bytes(size);
    const std::lock_guard lock(mutex);
    file.clear();
    file.seekg(at);
    if (size > 0 &&
        !file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
      fail(fmt::format("it ends before byte {}", end));
    return bytes;
  }

  void read_head() {
    if (file_bytes < static_cast<std::int64_t>(kFirstBytes)) fail("it is no container of patches");
    FirstPart first;
    if (const std::string why = read_first_part(read(0, kFirstBytes), first); !why.empty())
      fail(why);
    header.version = first.version;
    const std::int64_t begin = kFirstBytes, end = begin + first.header_bytes;
    if (end > file_bytes) fail("it ends within its header");
    // The header and, made of it, places of records.
    require_memory(5 * std::int64_t{first.header_bytes}, "the header of '" + name + "'");
    const Bytes head = read(begin, first.header_bytes);
    if (Checksum().add_bytes(head.data(), head.size()).value() != first.checksum)
      fail("its header is damaged: the checksum differs");
    RecordTable table;
    if (const std::string why = read_header(head, header, table); !why.empty()) fail(why);
    place_records(table, end);
  }

  void place_records(const RecordTable& table, std::int64_t at) {
    for (const auto& [entries, records] :
         {std::pair{&table.heights, &heights}, std::pair{&table.payload, &payload}}) {
      records->reserve(entries->size());
      for (const TableEntry& entry : *entries) {
        records->push_back({at, entry});
        at += entry.size;
      }
    }
    if (at != file_bytes) fail(fmt::format("it has {} bytes, its table says {}", file_bytes, at));
  }

  const Record& record(const std::vector<Record>& records, std::int64_t number) const {
    require(number >= 0 && number < static_cast<std::int64_t>(records.size()),
            "a record's number must be in [0, {}), got {}", records.size(), number);
    return records[static_cast<std::size_t>(number)];
  }

  Bytes bytes(const std::vector<Record>& records, std::int64_t number, const char* what) {
    const Record& found = record(records, number);
    Bytes bytes = read(found.at, found.entry.size);
    if (record_checksum(bytes) != found.entry.checksum)
      fail(fmt::format("the {} of patch {} are damaged: the checksum differs", what, number));
    return bytes;
  }
};

Container::Container(const fs::path& path) : parts_(std::make_unique<Parts>()) {
  parts_->name = path.string();
  parts_->open_file(path);
  parts_->read_head();
}

Container::Container(Bytes file, std::string name) : parts_(std::make_unique<Parts>()) {
  parts_->name = std::move(name);
  parts_->memory = std::move(file);
  parts_->file_bytes = static_cast<std::int64_t>(parts_->memory.size());
  parts_->read_head();
}

Container::~Container() = default;

const std::string& Container::name() const { return parts_->name; }
const ContainerHeader& Container::header() const { return parts_->header; }
std::int64_t Container::file_bytes() const { return parts_->file_bytes; }
Bytes Container::heights(std::int64_t record) const {
  return parts_->bytes(parts_->heights, record, "heights");
}
Bytes Container::payload(std::int64_t record) const {
  return parts_->bytes(parts_->payload, record, "bounds");
}
std::int64_t Container::heights_bytes(std::int64_t record) const {
  return parts_->record(parts_->heights, record).entry.size;
}
std::int64_t Container::payload_bytes(std::int64_t record) const {
  return parts_->record(parts_->payload, record).entry.size;
}

bool is_container(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::ifstream file(path, std::ios::binary);
  Bytes bytes(8);
  return file.read(reinterpret_cast<char*>(bytes.data()), 8) && begins_with_magic(bytes);
}

}  // namespace plumb::mesh::patch_quadtree
