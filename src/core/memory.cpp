#include "core/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include "core/check.h"

namespace plumb {
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

void require_memory(std::int64_t bytes, std::string_view what) {
  const std::uint64_t there = available_memory_bytes();
  if (bytes > 0 && static_cast<std::uint64_t>(bytes) > there) {
    input_error("{} needs {} bytes of memory, there are {}", what, bytes, there);
  }
}

}  // namespace plumb
