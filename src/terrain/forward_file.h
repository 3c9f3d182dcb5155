// A file read once, from its front to its end, in lines or in bytes. Not for users of the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::terrain {

/// Holds one piece of the file at a time. What it hands out lives until the next call.
///
///   (1) No more memory than the longest line, or the longest run of bytes asked for at once.
/// Throws InputError, which begins with `name` ("mesh 'a.ply'"), if the file cannot be read or ends
/// too early.
class ForwardFile {
 public:
  ForwardFile(const std::string& path, std::string name);

  const std::string& name() const { return name_; }
  std::uint64_t at() const { return at_; }  // bytes read so far
  std::uint64_t left() const { return size_ - at_; }
  std::int64_t line() const { return line_; }  // number of the last line read, from 1

  /// The next line without its end, be it LF or CRLF; false at the end of the file. Throws
  /// InputError if a line has more than `most_bytes`.
  bool read_line(std::string_view& line, std::size_t most_bytes = std::size_t{1} << 26);

  /// The next `count` bytes.
  const unsigned char* read(std::size_t count) {
    if (end_ - begin_ < count) fill(count);
    const unsigned char* bytes = buffer_.data() + begin_;
    begin_ += count;
    at_ += count;
    return bytes;
  }
  void skip(std::uint64_t count);

 private:
  void fill(std::size_t count);  // until so many bytes are there
  bool fill_more();              // false: nothing is left

  std::string name_;
  std::ifstream input_;
  std::uint64_t size_ = 0, at_ = 0;
  std::int64_t line_ = 0;
  std::vector<unsigned char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what is in the buffer and not yet handed out
};

}  // namespace plumb::terrain
