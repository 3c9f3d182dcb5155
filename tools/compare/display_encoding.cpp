#include "compare/display_encoding.h"

#include <bit>
#include <cstdint>

#include "compare/value_models.h"

namespace plumb::compare {
namespace {

constexpr int kDigits = 10;          // of the mantissa that choose a place
constexpr int kLeft = 23 - kDigits;  // those between two places
constexpr float kLeast = 0x1.0p-9f, kMost = 0x1.0p8f;
constexpr std::uint32_t kFirst = std::bit_cast<std::uint32_t>(kLeast) >> kLeft;
constexpr std::uint32_t kLast = std::bit_cast<std::uint32_t>(kMost) >> kLeft;

}  // namespace

DisplayEncoding::DisplayEncoding() {
  for (std::uint32_t place = kFirst; place <= kLast; ++place)
    at_.push_back(static_cast<float>(linear_to_srgb(double{std::bit_cast<float>(place << kLeft)})));
}

float DisplayEncoding::operator()(float linear) const {
  if (!(linear > 0.0f)) return 0.0f;
  if (!(linear >= kLeast && linear < kMost))
    return static_cast<float>(linear_to_srgb(double{linear}));
  const auto bits = std::bit_cast<std::uint32_t>(linear);
  const std::size_t place = (bits >> kLeft) - kFirst;
  const float share = static_cast<float>(bits & ((1u << kLeft) - 1u)) / float{1u << kLeft};
  return at_[place] + share * (at_[place + 1] - at_[place]);
}

}  // namespace plumb::compare
