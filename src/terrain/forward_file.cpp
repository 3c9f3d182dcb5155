#include "terrain/forward_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/check.h"

namespace plumb::terrain {
namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 20;

}  // namespace

ForwardFile::ForwardFile(const std::string& path, std::string name) : name_(std::move(name)) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    input_error("{}: there is no such file", name_);
  errno = 0;
  input_.open(path, std::ios::binary);
  if (!input_)
    input_error("{}: it cannot be opened: {}", name_,
                errno != 0 ? std::strerror(errno) : "no reason was given");
  size_ = std::filesystem::file_size(path, error);
  if (error) input_error("{}: {}", name_, error.message());
}

bool ForwardFile::fill_more() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (buffer_.size() < end_ + kPieceBytes) buffer_.resize(std::max(2 * end_, end_ + kPieceBytes));
  input_.read(reinterpret_cast<char*>(buffer_.data() + end_),
              static_cast<std::streamsize>(buffer_.size() - end_));
  const auto got = static_cast<std::size_t>(input_.gcount());
  end_ += got;
  return got > 0;
}

void ForwardFile::fill(std::size_t count) {
  const std::uint64_t there = left();
  while (count <= there && end_ - begin_ < count) {
    if (!fill_more()) break;
  }
  if (end_ - begin_ < count)
    input_error("{}: the file ends at byte {}, expected {} bytes from byte {} on", name_, size_,
                count, at_);
}

void ForwardFile::skip(std::uint64_t count) {
  while (count > 0) {
    const auto step = static_cast<std::size_t>(std::min<std::uint64_t>(count, kPieceBytes));
    read(step);
    count -= step;
  }
}

bool ForwardFile::read_line(std::string_view& line, std::size_t most_bytes) {
  const unsigned char* end = nullptr;
  for (std::size_t seen = 0; end == nullptr; seen = end_ - begin_) {
    if (seen > most_bytes)
      input_error("{}: line {} has more than {} bytes", name_, line_ + 1, most_bytes);
    if ((seen == end_ - begin_) && !fill_more()) break;
    end = static_cast<const unsigned char*>(
        std::memchr(buffer_.data() + begin_ + seen, '\n', end_ - begin_ - seen));
  }
  const unsigned char* start = buffer_.data() + begin_;
  if (end == nullptr && begin_ == end_) return false;
  const auto length =
      static_cast<std::size_t>((end != nullptr ? end : buffer_.data() + end_) - start);
  line = {reinterpret_cast<const char*>(start), length};
  if (line.ends_with('\r')) line.remove_suffix(1);
  const std::size_t taken = length + (end != nullptr ? 1 : 0);
  begin_ += taken;
  at_ += taken;
  ++line_;
  return true;
}

}  // namespace plumb::terrain
