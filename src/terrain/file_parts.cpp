#include "terrain/file_parts.h"

#include <algorithm>

#include "core/check.h"

namespace plumb::terrain {

FileParts::FileParts(const std::string& file, const std::vector<FilePart>& parts)
    : IOProxy(file, Read), input_(file, std::ios::binary), parts_(parts) {
  require(!parts.empty(), "a file has at least one part");
  std::uint64_t end = 0;
  for (const FilePart& part : parts) ends_.push_back(end += part.size);
}

std::size_t FileParts::read(void* buffer, std::size_t size) {
  const std::size_t done = pread(buffer, size, m_pos);
  m_pos += static_cast<std::int64_t>(done);
  return done;
}

std::size_t FileParts::pread(void* buffer, std::size_t size, std::int64_t offset) {
  auto* bytes = static_cast<unsigned char*>(buffer);
  std::size_t done = 0;
  while (done < size) {
    const std::size_t more =
        read_at(bytes + done, size - done, static_cast<std::uint64_t>(offset) + done);
    if (more == 0) break;
    done += more;
  }
  return done;
}

/// Reads as much as one part holds of it.
std::size_t FileParts::read_at(unsigned char* buffer, std::size_t size, std::uint64_t offset) {
  const auto end = std::upper_bound(ends_.begin(), ends_.end(), offset);
  if (end == ends_.end()) return 0;
  const FilePart& part = parts_[static_cast<std::size_t>(end - ends_.begin())];
  const std::uint64_t left = *end - offset;
  const std::uint64_t at = part.at + part.size - left;
  if (at != input_at_) input_.seekg(static_cast<std::streamoff>(at));
  const std::size_t wanted = static_cast<std::size_t>(std::min<std::uint64_t>(left, size));
  input_.read(reinterpret_cast<char*>(buffer), static_cast<std::streamsize>(wanted));
  const auto done = static_cast<std::size_t>(input_.gcount());
  input_at_ = at + done;
  return done;
}

}  // namespace plumb::terrain
