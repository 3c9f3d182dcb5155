// Words and numbers in a line of text. Not for users of the library.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace plumb::terrain {

/// The next word of `rest`, which then begins behind it; empty at the end.
inline std::string_view next_token(std::string_view& rest) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v'; };
  std::size_t begin = 0;
  while (begin < rest.size() && blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !blank(rest[end])) ++end;
  const std::string_view token = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return token;
}

/// The number that the token spells, correctly rounded; what is too small for a double is zero.
/// Nothing if it is no number or one too large. "inf" and "nan" are numbers.
inline std::optional<double> number_in(std::string_view token) {
  if (token.starts_with('+')) token.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (token.empty() || end != token.data() + token.size()) return std::nullopt;
  if (error == std::errc()) return value;
  const bool too_small = error == std::errc::result_out_of_range &&
                         (token.find("e-") != token.npos || token.find("E-") != token.npos);
  return too_small ? std::optional<double>(0.0) : std::nullopt;
}

/// A token as a message shows it: in quotes, its beginning only, without control characters.
inline std::string shown(std::string_view token) {
  constexpr std::size_t kMostShown = 40;
  std::string text = "'";
  for (const char c : token.substr(0, kMostShown)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (token.size() > kMostShown ? "...'" : "'");
}

}  // namespace plumb::terrain
