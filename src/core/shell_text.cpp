#include "core/shell_text.h"

#include <string_view>

namespace plumb {
namespace {

bool needs_no_quotes(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
  return !text.empty() && text.find_first_not_of(kPlain) == std::string::npos;
}

}  // namespace

std::string shell_quoted(const std::string& word) {
  if (needs_no_quotes(word)) return word;
  std::string result = "'";
  for (const char c : word) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_quoted(word);
  return line;
}

}  // namespace plumb
