#include "terrain/memory_check.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

#include "core/check.h"

namespace plumb::terrain {
namespace {

std::optional<std::uint64_t> first_number_in(const char* path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  if (file >> value) return value;  // a limit of "max" is no number
  return std::nullopt;
}

std::uint64_t system_available() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word) {
    std::uint64_t kibibytes = 0;
    if (word == "MemAvailable:" && file >> kibibytes) return kibibytes * 1024;
  }
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGE_SIZE);
  return pages > 0 && page > 0
             ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page)
             : std::numeric_limits<std::uint64_t>::max();
}

std::uint64_t left_of(std::uint64_t limit, std::uint64_t used) {
  return limit > used ? limit - used : 0;
}

std::uint64_t address_space_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  file >> pages;
  return pages * static_cast<std::uint64_t>(std::max(1L, sysconf(_SC_PAGE_SIZE)));
}

}  // namespace

std::uint64_t available_memory_bytes() {
  std::uint64_t available = system_available();
  if (const auto limit = first_number_in("/sys/fs/cgroup/memory.max")) {
    const auto used = first_number_in("/sys/fs/cgroup/memory.current").value_or(0);
    available = std::min(available, left_of(*limit, used));
  }
  if (const auto limit = first_number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes")) {
    const auto used = first_number_in("/sys/fs/cgroup/memory/memory.usage_in_bytes").value_or(0);
    available = std::min(available, left_of(*limit, used));
  }
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    available = std::min(available, left_of(limit.rlim_cur, address_space_bytes()));
  }
  return available;
}

void require_memory(const std::string& name, std::int64_t columns, std::int64_t rows,
                    int bytes_per_sample, std::uint64_t available_bytes) {
  // Sizes fit in 31 bits each, so the bytes fit in 64 bits for up to four bytes a sample; in double
  // they always do, and 2^53 bytes are more than any machine has.
  const double needed = static_cast<double>(columns) * static_cast<double>(rows) * bytes_per_sample;
  if (needed > static_cast<double>(available_bytes)) {
    input_error("{}: {} x {} samples need {:.0f} bytes of memory, there are {}", name, columns,
                rows, needed, available_bytes);
  }
  constexpr double kMostCells = 2147483646.0;  // two triangles a cell are counted in 32 bits
  if (static_cast<double>(columns - 1) * static_cast<double>(rows - 1) > kMostCells) {
    input_error(
        "{}: {} x {} samples have more than the 2^31 - 2 cells that a terrain may have: "
        "choose a part with --window",
        name, columns, rows);
  }
}

}  // namespace plumb::terrain
