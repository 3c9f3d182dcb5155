#include "core/atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "core/check.h"

namespace plumb {
namespace fs = std::filesystem;
namespace {

// The file that writing to `path` replaces: the end of a chain of symbolic links.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return path;
  if (!fs::is_regular_file(status)) {
    input_error("cannot write '{}': what stands there is not a regular file", path.string());
  }
  fs::path resolved = fs::canonical(path, error);
  return error ? path : resolved;
}

}  // namespace

TemporarySibling::TemporarySibling(const fs::path& final_path) : final_(target_of(final_path)) {
  if (!final_.has_filename()) input_error("cannot write '{}': not a file name", final_.string());
  const fs::path folder = final_.has_parent_path() ? final_.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    input_error("cannot write '{}': its folder does not exist", final_.string());
  }
  static std::atomic<unsigned> next{0};
  // Cut, so that a long name stays within what file systems allow (255 bytes).
  const std::string stem = final_.stem().string().substr(0, 160);
  temporary_ = folder / fmt::format(".{}.{}-{}.tmp{}", stem, ::getpid(), next.fetch_add(1),
                                    final_.extension().string());
}

TemporarySibling::~TemporarySibling() {
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
}

void TemporarySibling::commit() {
  std::error_code error;
  fs::rename(temporary_, final_, error);
  if (error) input_error("cannot write '{}': {}", final_.string(), error.message());
  committed_ = true;
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  TemporarySibling sibling(path);
  errno = 0;
  std::ofstream file(sibling.path(), std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) {
    input_error("cannot write '{}': {}", path.string(),
                errno != 0 ? std::strerror(errno) : "writing failed");
  }
  sibling.commit();
}

}  // namespace plumb
