// Numbers, texts and counted bytes as they stand in a file: the lowest byte first.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>

#include "core/byte_stream.h"
#include "core/check.h"

namespace plumb {

template <class T>
using WordOf = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;

/// A number of four or eight bytes.
template <class T>
void put(T value, Bytes& bytes) {
  const auto word = std::bit_cast<WordOf<T>>(value);
  for (std::size_t k = 0; k < sizeof(T); ++k)
    bytes.push_back(static_cast<std::uint8_t>(word >> (8 * k)));
}

/// A size of four bytes. Throws std::invalid_argument, naming what it is of, if it needs more.
inline void put_size(std::size_t size, const char* of, Bytes& bytes) {
  require(size <= std::numeric_limits<std::uint32_t>::max(), "{} must be under 4 GiB, got {} bytes",
          of, size);
  put(static_cast<std::uint32_t>(size), bytes);
}

/// Their size, then the bytes. Throws as put_size does.
inline void put_bytes(std::span<const std::uint8_t> part, const char* what, Bytes& bytes) {
  put_size(part.size(), what, bytes);
  bytes.insert(bytes.end(), part.begin(), part.end());
}
inline void put_text(const std::string& text, const char* what, Bytes& bytes) {
  put_bytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, what, bytes);
}

/// The number again, zero beyond the end.
template <class T>
T take(ByteReader& reader) {
  WordOf<T> word = 0;
  for (std::size_t k = 0; k < sizeof(T); ++k) word |= WordOf<T>{reader.byte()} << (8 * k);
  return std::bit_cast<T>(word);
}

/// Reads the same again; what is beyond the end reads as zeros, or as nothing, and is remembered.
class LittleEndianReader {
 public:
  explicit LittleEndianReader(std::span<const std::uint8_t> bytes) : reader_(bytes) {}

  template <class T>
  T take() {
    return plumb::take<T>(reader_);
  }
  Bytes bytes() {
    const auto part = reader_.bytes(take<std::uint32_t>());
    return {part.begin(), part.end()};
  }
  std::string text() {
    const Bytes part = bytes();
    return {part.begin(), part.end()};
  }
  std::size_t left() const { return reader_.left(); }
  bool overrun() const { return reader_.overrun(); }

 private:
  ByteReader reader_;
};

}  // namespace plumb
