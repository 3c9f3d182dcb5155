// The values of a PLY file's data, one after another. Not for users of the library.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "core/check.h"
#include "terrain/forward_file.h"
#include "terrain/ply_header.h"
#include "terrain/text_tokens.h"

namespace plumb::terrain {

/// Values as bytes. Both kinds have the same members, so that one template reads from either.
class BinaryPlyValues {
 public:
  BinaryPlyValues(ForwardFile& file, bool big_endian) : file_(file), big_endian_(big_endian) {}

  /// Fewest bytes that a value of this type takes.
  static std::uint64_t least_bytes(PlyType type) { return size_of(type); }
  void begin_row() { row_at_ = file_.at(); }
  void end_row() {}
  std::string where() const { return fmt::format("byte {}", row_at_); }

  double next(PlyType type) {
    switch (type) {
      case PlyType::Int8:
        return next_as<std::int8_t>();
      case PlyType::UInt8:
        return next_as<std::uint8_t>();
      case PlyType::Int16:
        return next_as<std::int16_t>();
      case PlyType::UInt16:
        return next_as<std::uint16_t>();
      case PlyType::Int32:
        return next_as<std::int32_t>();
      case PlyType::UInt32:
        return next_as<std::uint32_t>();
      case PlyType::Float32:
        return static_cast<double>(next_as<float>());
      case PlyType::Float64:
        return next_as<double>();
    }
    return 0.0;
  }
  void skip(PlyType type, std::uint64_t count) { file_.skip(count * size_of(type)); }

 private:
  static_assert(std::endian::native == std::endian::little, "bytes are turned round for big ones");
  template <class T>
  T next_as() {
    std::array<unsigned char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), file_.read(sizeof(T)), sizeof(T));
    if (big_endian_) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  ForwardFile& file_;
  bool big_endian_;
  std::uint64_t row_at_ = 0;
};

/// Values as text, a line for each row; empty lines do not count.
class TextPlyValues {
 public:
  explicit TextPlyValues(ForwardFile& file) : file_(file) {}

  static std::uint64_t least_bytes(PlyType) { return 1; }  // the last needs nothing behind it
  void begin_row() {
    std::string_view blank;
    do {
      if (!file_.read_line(line_))
        input_error("{}: the file ends after line {}, expected more elements", file_.name(),
                    file_.line());
      blank = line_;
    } while (next_token(blank).empty());
  }
  void end_row() {
    const std::string_view token = next_token(line_);
    if (!token.empty()) fail(token, "the line's end");
  }
  std::string where() const { return fmt::format("line {}", file_.line()); }

  double next(PlyType) {
    const std::string_view token = next_token(line_);
    const auto value = number_in(token);
    if (!value) fail(token, "a number");
    return *value;
  }
  void skip(PlyType type, std::uint64_t count) {
    for (std::uint64_t k = 0; k < count; ++k) next(type);
  }

 private:
  [[noreturn]] void fail(std::string_view token, const char* expected) const {
    input_error("{}: {}: expected {}, got {}", file_.name(), where(), expected,
                token.empty() ? "the line's end" : shown(token));
  }

  ForwardFile& file_;
  std::string_view line_;
};

}  // namespace plumb::terrain
