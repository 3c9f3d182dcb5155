#include "terrain/stacks/range_coder.h"

#include <utility>

namespace plumb::terrain {
namespace {

constexpr int kProbabilityBits = 11, kRate = 5;
constexpr std::uint32_t kLeastRange = 1u << 24;

void see_zero(BitModel& model) {
  model.zero =
      static_cast<std::uint16_t>(model.zero + (((1u << kProbabilityBits) - model.zero) >> kRate));
}

void see_one(BitModel& model) {
  model.zero = static_cast<std::uint16_t>(model.zero - (model.zero >> kRate));
}

}  // namespace

void RangeEncoder::put(unsigned bit, BitModel& model) {
  const std::uint32_t bound = (range_ >> kProbabilityBits) * model.zero;
  if (bit == 0) {
    range_ = bound;
    see_zero(model);
  } else {
    low_ += bound;
    range_ -= bound;
    see_one(model);
  }
  for (; range_ < kLeastRange; range_ <<= 8) shift();
}

// The top byte of low_ leaves, unless it is 255: then a carry may still change it and those before.
void RangeEncoder::shift() {
  if (low_ < 0xff000000u || low_ > 0xffffffffu) {
    const auto carry = static_cast<std::uint8_t>(low_ >> 32);
    for (std::uint8_t byte = first_; waiting_ > 0; --waiting_, byte = 0xff)
      bytes_.push_back(static_cast<std::uint8_t>(byte + carry));
    first_ = static_cast<std::uint8_t>(low_ >> 24);
  }
  ++waiting_;
  low_ = (low_ & 0x00ffffffu) << 8;
}

Bytes RangeEncoder::finish() {
  for (int k = 0; k < 5; ++k) shift();
  return std::move(bytes_);
}

RangeDecoder::RangeDecoder(std::span<const std::uint8_t> bytes) : reader_(bytes) {
  for (int k = 0; k < 5; ++k) code_ = code_ << 8 | reader_.byte();
}

unsigned RangeDecoder::take(BitModel& model) {
  const std::uint32_t bound = (range_ >> kProbabilityBits) * model.zero;
  unsigned bit = 0;
  if (code_ < bound) {
    range_ = bound;
    see_zero(model);
  } else {
    code_ -= bound;
    range_ -= bound;
    bit = 1;
    see_one(model);
  }
  for (; range_ < kLeastRange; range_ <<= 8) code_ = code_ << 8 | reader_.byte();
  return bit;
}

}  // namespace plumb::terrain
