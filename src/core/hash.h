// Checksums of raw values: names for bits, not a defence against malice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace plumb {

/// A running 64-bit checksum (FNV-1a over little-endian 8-byte words, the last one padded with
/// zeros, then mixed). The same values in the same order give the same checksum on every machine.
class Checksum {
 public:
  Checksum& add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (; size >= 8; bytes += 8, size -= 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, 8);
      mix(word);
    }
    if (size > 0) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, size);
      mix(word);
    }
    return *this;
  }
  template <class T>
  requires std::is_arithmetic_v<T> Checksum& add(T value) {
    return add_bytes(&value, sizeof value);
  }
  template <class T>
  requires std::is_trivially_copyable_v<T> Checksum& add(std::span<const T> values) {
    add(static_cast<std::uint64_t>(values.size()));
    return add_bytes(values.data(), values.size_bytes());
  }
  Checksum& add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    return add_bytes(text.data(), text.size());
  }

  std::uint64_t value() const {
    std::uint64_t x = state_;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }
  /// Sixteen hexadecimal digits.
  std::string text() const;

 private:
  void mix(std::uint64_t word) { state_ = ((state_ ^ word) * 0x100000001b3ULL) ^ (state_ >> 29); }
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace plumb
