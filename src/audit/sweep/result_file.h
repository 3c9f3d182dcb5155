// Files of a sweep's results: one JSON object a line (docs/formats/sweep-results.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::audit::sweep {

/// A line, and what joining, ordering and resuming need of it.
struct ResultLine {
  std::string text;           // without its line feed
  std::string key;            // of what was asked
  std::int64_t index = 0;     // place in the scene's order, from 0
  std::string status;         // "done", "failed" or "skipped"
  std::string verdict;        // of a run that is done: "held", "broken" or "none"
  std::string error;          // of a run that is not done
  std::string run;            // for people: "alpine, tessellation, published, 1px, oblique"
  bool shared_times = false;  // other runs used the machine meanwhile
};

struct ResultLines {
  std::vector<ResultLine> lines;  // as they stand in the file
  std::size_t whole_bytes = 0;    // of the text, without a torn last line
};

/// Reads the lines of a text; a last line without its line feed is torn and left out. Throws
/// InputError, one line with `name` and the line's number, for a line that is no such object, and
/// for one whose key is not that of what it asked.
ResultLines parse_results(std::string_view text, const std::string& name);

/// The same from a file. Throws InputError if it cannot be read.
ResultLines read_results(const std::filesystem::path& path);

/// The line with another index.
ResultLine with_index(const ResultLine& line, std::int64_t index);

/// The line without what may differ between two runs or machines, and without its index: two such
/// texts are equal if the results are.
std::string result_text(const ResultLine& line);

/// All lines, each with its line feed.
std::string joined_text(const std::vector<ResultLine>& lines);

/// A result file that this process alone appends to: a lock on it is held while the object lives.
class ResultFile {
 public:
  /// Opens the file, or makes it, and takes a torn last line away. Throws InputError with path and
  /// cause; if another process holds the lock; and as parse_results does.
  explicit ResultFile(std::filesystem::path path);
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// What stood in the file when it was opened or last replaced, and was appended since.
  const std::vector<ResultLine>& lines() const { return lines_; }

  /// Appends one line, whole. Not for two threads at once. Throws InputError with path and cause;
  /// what was written of the line is taken away then, as far as that is possible.
  void append(const std::string& text);
  /// Puts these lines in the place of all. Throws InputError with path and cause; the file is then
  /// as it was.
  void replace(std::vector<ResultLine> lines);

 private:
  void open();
  void close();

  std::filesystem::path path_;
  int file_ = -1;
  std::vector<ResultLine> lines_;
};

}  // namespace plumb::audit::sweep
