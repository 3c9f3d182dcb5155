// Adaptive coding of single bits, without a division.
#pragma once

#include <cstdint>
#include <span>

#include "core/byte_stream.h"

namespace plumb::terrain {

/// How likely a 0 is, in 2048ths; it moves by a 32nd of the way to what came, and so stays in [31,
/// 2017].
struct BitModel {
  std::uint16_t zero = 1024;
};

/// Source: [Martin 1979], with carries as Pavlov's LZMA has them.
class RangeEncoder {
 public:
  void put(unsigned bit, BitModel& model);
  /// The bytes; nothing may be put any more.
  Bytes finish();

 private:
  void shift();

  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xffffffffu;
  std::uint64_t waiting_ = 1;  // bytes that a carry may still change, the first of them `first_`
  std::uint8_t first_ = 0;
  Bytes bytes_;
};

/// Reads what an encoder wrote. Bytes beyond the end are zeros, as many as are asked for: whether
/// they were is seen by `overrun`.
///
///   (1) A bit takes at least -log2(2017/2048) = 1/46 of a bit: so n bytes hold fewer than
///       kMostBitsInAByte * (n + 4) bits, and nobody can claim more of a file.
class RangeDecoder {
 public:
  static constexpr std::uint64_t kMostBitsInAByte = 8 * 46;

  explicit RangeDecoder(std::span<const std::uint8_t> bytes);
  unsigned take(BitModel& model);
  bool overrun() const { return reader_.overrun(); }
  /// Bytes not yet read: none, where a whole file was.
  std::size_t left() const { return reader_.left(); }

 private:
  ByteReader reader_;
  std::uint32_t range_ = 0xffffffffu, code_ = 0;
};

}  // namespace plumb::terrain
