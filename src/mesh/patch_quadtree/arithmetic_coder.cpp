#include "mesh/patch_quadtree/arithmetic_coder.h"

#include <cstddef>

namespace plumb::mesh::patch_quadtree {
namespace {

constexpr std::uint32_t kHalf = 0x80000000u, kQuarter = 0x40000000u;
constexpr std::uint32_t kMostTotal = 1u << 14;

}  // namespace

AdaptiveModel::AdaptiveModel(int symbols)
    : counts_(static_cast<std::size_t>(symbols), 1), total_(static_cast<std::uint32_t>(symbols)) {}

std::uint32_t AdaptiveModel::below(int symbol) const {
  std::uint32_t sum = 0;
  for (int k = 0; k < symbol; ++k) sum += counts_[static_cast<std::size_t>(k)];
  return sum;
}

int AdaptiveModel::find(std::uint32_t at, std::uint32_t& below) const {
  below = 0;
  int symbol = 0;
  while (symbol + 1 < symbols() && below + count(symbol) <= at) below += count(symbol++);
  return symbol;
}

void AdaptiveModel::add(int symbol) {
  constexpr std::uint32_t kStep = 32;
  counts_[static_cast<std::size_t>(symbol)] += kStep;
  total_ += kStep;
  if (total_ <= kMostTotal) return;
  total_ = 0;
  for (std::uint32_t& count : counts_) {
    count = (count + 1) / 2;
    total_ += count;
  }
}

void ArithmeticEncoder::put(int symbol, AdaptiveModel& model) {
  narrow(model.below(symbol), model.count(symbol), model.total());
  model.add(symbol);
}

void ArithmeticEncoder::put_bits(std::uint32_t bits, int count) {
  for (int k = count - 1; k >= 0; --k) narrow((bits >> k) & 1u, 1, 2);
}

void ArithmeticEncoder::narrow(std::uint32_t below, std::uint32_t count, std::uint32_t total) {
  const std::uint64_t range = std::uint64_t{high_} - low_ + 1;
  high_ = static_cast<std::uint32_t>(low_ + range * (below + count) / total - 1);
  low_ = static_cast<std::uint32_t>(low_ + range * below / total);
  for (;;) {
    if (high_ < kHalf) {
      write_bit_and_followers(false);
    } else if (low_ >= kHalf) {
      write_bit_and_followers(true);
    } else if (low_ >= kQuarter && high_ < kHalf + kQuarter) {
      ++followers_;
      low_ -= kQuarter;
      high_ -= kQuarter;
    } else {
      return;
    }
    low_ <<= 1;
    high_ = (high_ << 1) | 1u;
  }
}

void ArithmeticEncoder::write_bit_and_followers(bool bit) {
  write_bit(bit);
  for (; followers_ > 0; --followers_) write_bit(!bit);
}

void ArithmeticEncoder::write_bit(bool bit) {
  if (free_bits_ == 0) {
    bytes_.push_back(0);
    free_bits_ = 8;
  }
  --free_bits_;
  if (bit) bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | (1u << free_bits_));
}

std::vector<std::uint8_t> ArithmeticEncoder::finish() {
  ++followers_;
  write_bit_and_followers(low_ >= kQuarter);
  return std::move(bytes_);
}

ArithmeticDecoder::ArithmeticDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
  for (int k = 0; k < 32; ++k) value_ = (value_ << 1) | next_bit();
}

std::uint32_t ArithmeticDecoder::next_bit() {
  if (left_ == 0) {
    ++at_;
    left_ = 8;
  }
  --left_;
  const std::size_t byte = at_ - 1;
  return byte < bytes_.size() ? (bytes_[byte] >> left_) & 1u : 0u;
}

std::uint32_t ArithmeticDecoder::place(std::uint32_t total) const {
  const std::uint64_t range = std::uint64_t{high_} - low_ + 1;
  return static_cast<std::uint32_t>(((std::uint64_t{value_} - low_ + 1) * total - 1) / range);
}

void ArithmeticDecoder::narrow(std::uint32_t below, std::uint32_t count, std::uint32_t total) {
  const std::uint64_t range = std::uint64_t{high_} - low_ + 1;
  high_ = static_cast<std::uint32_t>(low_ + range * (below + count) / total - 1);
  low_ = static_cast<std::uint32_t>(low_ + range * below / total);
  for (;;) {
    std::uint32_t shift = 0;
    if (high_ < kHalf) {
      shift = 0;
    } else if (low_ >= kHalf) {
      shift = kHalf;
    } else if (low_ >= kQuarter && high_ < kHalf + kQuarter) {
      shift = kQuarter;
    } else {
      return;
    }
    low_ = (low_ - shift) << 1;
    high_ = ((high_ - shift) << 1) | 1u;
    value_ = ((value_ - shift) << 1) | next_bit();
  }
}

int ArithmeticDecoder::take(AdaptiveModel& model) {
  std::uint32_t below = 0;
  const int symbol = model.find(place(model.total()), below);
  narrow(below, model.count(symbol), model.total());
  model.add(symbol);
  return symbol;
}

std::uint32_t ArithmeticDecoder::take_bits(int count) {
  std::uint32_t bits = 0;
  for (int k = 0; k < count; ++k) {
    const std::uint32_t bit = place(2) >= 1 ? 1u : 0u;
    narrow(bit, 1, 2);
    bits = (bits << 1) | bit;
  }
  return bits;
}

}  // namespace plumb::mesh::patch_quadtree
