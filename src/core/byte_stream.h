// Numbers as bytes, and bits as bytes: the small parts of a record.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace plumb {

using Bytes = std::vector<std::uint8_t>;

/// Seven bits a byte, the lowest first, the top bit set where more follow.
inline void put_number(std::uint64_t number, Bytes& bytes) {
  for (; number >= 128; number >>= 7) bytes.push_back(static_cast<std::uint8_t>(number | 128u));
  bytes.push_back(static_cast<std::uint8_t>(number));
}

/// Their number, then the bytes.
inline void put_part(std::span<const std::uint8_t> part, Bytes& bytes) {
  put_number(part.size(), bytes);
  bytes.insert(bytes.end(), part.begin(), part.end());
}

/// Differences as whole numbers from zero: 0, 1, -1, 2, -2, ... are 0, 1, 2, 3, 4, ...
inline std::uint32_t folded(std::int32_t d) {
  return d > 0 ? 2 * static_cast<std::uint32_t>(d) - 1 : 2 * static_cast<std::uint32_t>(-d);
}
inline std::int32_t unfolded(std::uint32_t number) {
  return static_cast<std::int32_t>((number & 1u) != 0 ? (number >> 1) + 1 : 0u - (number >> 1));
}

/// Reads bytes one after the other; what is beyond the end reads as zeros and is remembered.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint8_t byte() {
    if (at_ < bytes_.size()) return bytes_[at_++];
    overrun_ = true;
    return 0;
  }
  std::uint64_t number() {
    std::uint64_t result = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const std::uint8_t next = byte();
      result |= std::uint64_t{next & 127u} << shift;
      if ((next & 128u) == 0) return result;
    }
    overrun_ = true;
    return 0;
  }
  /// The next `count` bytes; fewer if there are no more.
  std::span<const std::uint8_t> bytes(std::uint64_t count) {
    if (count > bytes_.size() - at_) {
      overrun_ = true;
      count = bytes_.size() - at_;
    }
    const auto part = bytes_.subspan(at_, static_cast<std::size_t>(count));
    at_ += part.size();
    return part;
  }
  std::span<const std::uint8_t> rest() { return bytes(bytes_.size() - at_); }
  std::size_t left() const { return bytes_.size() - at_; }
  bool overrun() const { return overrun_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool overrun_ = false;
};

/// Elias gamma codes, the highest bit of a byte first.
class GammaWriter {
 public:
  /// number >= 1
  void put(std::uint32_t number) {
    const int length = std::bit_width(number);
    for (int k = 1; k < length; ++k) put_bit(0);
    for (int k = length - 1; k >= 0; --k) put_bit(number >> k & 1u);
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  void put_bit(std::uint32_t bit) {
    if (free_ == 0) {
      bytes_.push_back(0);
      free_ = 8;
    }
    --free_;
    bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | bit << free_);
  }

  Bytes bytes_;
  int free_ = 0;
};

class GammaReader {
 public:
  explicit GammaReader(std::span<const std::uint8_t> bytes) : reader_(bytes) {}

  /// Zero where there is no such number.
  std::uint32_t take() {
    int zeros = 0;
    while (bit() == 0) {
      if (++zeros > 31 || reader_.overrun()) return 0;
    }
    std::uint32_t number = 1;
    for (int k = 0; k < zeros; ++k) number = number << 1 | bit();
    return number;
  }
  bool overrun() const { return reader_.overrun(); }

 private:
  std::uint32_t bit() {
    if (left_ == 0) {
      byte_ = reader_.byte();
      left_ = 8;
    }
    --left_;
    return byte_ >> left_ & 1u;
  }

  ByteReader reader_;
  std::uint32_t byte_ = 0;
  int left_ = 0;
};

}  // namespace plumb
