#include "core/memory.h"

#include <unistd.h>

#include <fstream>
#include <limits>
#include <string>

#include "core/check.h"

namespace plumb {

std::int64_t available_memory_bytes() {
  std::ifstream meminfo("/proc/meminfo");
  for (std::string key; meminfo >> key;) {
    std::int64_t kibibytes = 0;
    if (key == "MemAvailable:" && meminfo >> kibibytes) return kibibytes * 1024;
    meminfo.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  const long pages = sysconf(_SC_AVPHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? static_cast<std::int64_t>(pages) * size
                               : std::numeric_limits<std::int64_t>::max();
}

void require_memory(std::int64_t bytes, std::string_view what) {
  const std::int64_t there = available_memory_bytes();
  if (bytes > there) input_error("{} needs {} bytes of memory, there are {}", what, bytes, there);
}

}  // namespace plumb
