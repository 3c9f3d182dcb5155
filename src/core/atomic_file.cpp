#include "core/atomic_file.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <fstream>
#include <mutex>
#include <string>
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

// The names that an interruption must remove. A signal handler may only read them, so they are kept
// for good: a few bytes for each file that is written. A file too many for the table is removed by
// its owner alone.
std::array<std::atomic<const char*>, 64> open_names{};

void remember(const fs::path& path) {
  static std::mutex mutex;
  static std::deque<std::string> names;
  const std::lock_guard<std::mutex> lock(mutex);
  names.push_back(path.string());
  for (std::atomic<const char*>& slot : open_names) {
    const char* free_slot = nullptr;
    if (slot.compare_exchange_strong(free_slot, names.back().c_str())) return;
  }
}

void forget(const fs::path& path) {
  for (std::atomic<const char*>& slot : open_names) {
    const char* name = slot.load();
    if (name != nullptr && path == name) slot.store(nullptr);
  }
}

extern "C" void end_interrupted(int signal_number) {
  for (const std::atomic<const char*>& slot : open_names) {
    const char* name = slot.load();
    if (name != nullptr) ::unlink(name);
  }
  ::_exit(128 + signal_number);
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
  remember(temporary_);
}

TemporarySibling::~TemporarySibling() {
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
  forget(temporary_);
}

void TemporarySibling::commit() {
  std::error_code error;
  fs::rename(temporary_, final_, error);
  if (error) input_error("cannot write '{}': {}", final_.string(), error.message());
  committed_ = true;
}

void remove_temporary_files_on_interrupt() {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    ::sigaction(signal_number, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = end_interrupted;
    sigfillset(&action.sa_mask);
    ::sigaction(signal_number, &action, nullptr);
  }
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

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) input_error("cannot make the folder '{}': {}", folder.string(), error.message());
}

}  // namespace plumb
