// Adaptive arithmetic coding. Source: [Witten, Neal & Cleary 1987].
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace plumb::mesh::patch_quadtree {

/// Counts of symbols seen so far; every one begins with a count of 1, and counts are halved when
/// their sum passes 2^14, so that what was long ago weighs less.
class AdaptiveModel {
 public:
  explicit AdaptiveModel(int symbols);

  int symbols() const { return static_cast<int>(counts_.size()); }
  std::uint32_t total() const { return total_; }
  std::uint32_t count(int symbol) const { return counts_[static_cast<std::size_t>(symbol)]; }
  /// Counts of the symbols before this one.
  std::uint32_t below(int symbol) const;
  /// The symbol whose share of [0, total) holds `at`.
  int find(std::uint32_t at, std::uint32_t& below) const;
  void add(int symbol);

 private:
  std::vector<std::uint32_t> counts_;
  std::uint32_t total_;
};

class ArithmeticEncoder {
 public:
  void put(int symbol, AdaptiveModel& model);
  /// The lowest `count` bits, each as likely 0 as 1; count <= 31.
  void put_bits(std::uint32_t bits, int count);
  /// The bytes; nothing may be put any more.
  std::vector<std::uint8_t> finish();

 private:
  void narrow(std::uint32_t below, std::uint32_t count, std::uint32_t total);
  void write_bit(bool bit);
  void write_bit_and_followers(bool bit);

  std::uint32_t low_ = 0, high_ = 0xffffffffu;
  std::uint64_t followers_ = 0;
  std::vector<std::uint8_t> bytes_;
  int free_bits_ = 0;  // of the last byte
};

/// Reads what an encoder wrote. Bytes beyond the end are zeros, as many as are asked for: whether
/// they were is seen by `overrun`.
class ArithmeticDecoder {
 public:
  explicit ArithmeticDecoder(std::span<const std::uint8_t> bytes);
  int take(AdaptiveModel& model);
  std::uint32_t take_bits(int count);
  /// True if more was read than an encoder can have written.
  bool overrun() const { return at_ > bytes_.size() + 4; }

 private:
  void narrow(std::uint32_t below, std::uint32_t count, std::uint32_t total);
  std::uint32_t place(std::uint32_t total) const;
  std::uint32_t next_bit();

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;  // of the next byte
  int left_ = 0;        // bits of the one before
  std::uint32_t low_ = 0, high_ = 0xffffffffu, value_ = 0;
};

}  // namespace plumb::mesh::patch_quadtree
