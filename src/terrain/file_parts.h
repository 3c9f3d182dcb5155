// Parts of a file read as if they were all of it. Not for users of the library.
#pragma once

#include <OpenImageIO/filesystem.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "core/png_file.h"

namespace plumb::terrain {

/// What OpenImageIO reads in place of the file: its parts, one behind another, none in memory.
class FileParts : public OIIO::Filesystem::IOProxy {
 public:
  /// `parts` lie in `file`, in rising order, none empty.
  FileParts(const std::string& file, const std::vector<FilePart>& parts);

  const char* proxytype() const override { return "parts of a file"; }
  std::size_t read(void* buffer, std::size_t size) override;
  std::size_t pread(void* buffer, std::size_t size, std::int64_t offset) override;
  std::size_t size() const override { return static_cast<std::size_t>(ends_.back()); }

 private:
  std::size_t read_at(unsigned char* buffer, std::size_t size, std::uint64_t offset);

  std::ifstream input_;
  std::uint64_t input_at_ = 0;
  std::vector<FilePart> parts_;
  std::vector<std::uint64_t> ends_;  // of each part, counted over all before it
};

}  // namespace plumb::terrain
