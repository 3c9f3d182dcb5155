// Files that appear whole under their name, or not at all, and the folders they lie in.
#pragma once

#include <filesystem>
#include <string_view>

namespace plumb {

/// A name beside `final_path` to write to, and the renaming once it is written.
///
/// The temporary name lies in the same folder (so that renaming is one step) and keeps the
/// extension (so that writers that go by it choose the same format). Whatever was written is
/// removed when the object dies without `commit`, an exception passing by included.
///
///   (1) `final_path` never names a partial file; a file that stood there is replaced or untouched.
///   (2) A symbolic link is followed: what it names is replaced, the link stays.
/// Throws InputError with the path if its folder is missing, or if something stands there that is
/// no regular file (a folder, a device).
class TemporarySibling {
 public:
  explicit TemporarySibling(const std::filesystem::path& final_path);
  ~TemporarySibling();
  TemporarySibling(const TemporarySibling&) = delete;
  TemporarySibling& operator=(const TemporarySibling&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  /// Gives the file its final name. Throws InputError if it cannot; once only.
  void commit();

 private:
  std::filesystem::path final_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// From now on an interruption (SIGINT, SIGTERM, SIGHUP) removes the temporary files that this
/// process is writing and ends it with status 128 + the signal's number: 130 for SIGINT. A signal
/// that is ignored (SIGHUP under nohup) stays so. For a program's main; the library installs no
/// handler by itself.
void remove_temporary_files_on_interrupt();

/// Writes `bytes` as the whole file `path`. Throws InputError with path and cause; no partial file
/// is left.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Makes a folder and those above it, unless it stands there. Throws InputError with its name and
/// the cause.
void make_folder(const std::filesystem::path& folder);

}  // namespace plumb
