#include "report/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "core/check.h"

namespace plumb::report {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

struct Letter {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  // 0: no letter begins here
};

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

// The UTF-8 letter at the beginning of the text, in its shortest form only.
Letter first_letter(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if (!continues(text[i])) return {};
    code = (code << 6) | (static_cast<unsigned char>(text[i]) & 0x3fu);
  }
  const std::uint32_t least = bytes == 4 ? 0x10000 : bytes == 3 ? 0x800 : 0x80;
  if (code < least || code > 0x10ffff) return {};
  return {code, bytes};
}

// Source: [XML 1.0, fifth edition, production 2].
bool may_stand_in_xml(std::uint32_t code) {
  if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
  return code != 0x7f && !(code >= 0xd800 && code <= 0xdfff) && code != 0xfffe && code != 0xffff;
}

std::string_view reference_for(std::uint32_t code) {
  switch (code) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&apos;";
    case '\t':
      return "&#9;";
    case '\n':
      return "&#10;";
    case '\r':
      return "&#13;";
    default:
      return {};
  }
}

// Line ends stay what they are where a person may read them.
std::string escape_element(std::string_view text) {
  std::string escaped;
  while (true) {
    const std::size_t end = text.find('\n');
    escaped += escape_xml(text.substr(0, end));
    if (end == std::string_view::npos) return escaped;
    escaped += '\n';
    text.remove_prefix(end + 1);
  }
}

std::string outcome_of(const JUnitCase& judged) {
  if (judged.failure) {
    return fmt::format("<failure message=\"{}\">{}</failure>", escape_xml(judged.failure->message),
                       escape_element(judged.failure->text));
  }
  if (judged.error) return fmt::format("<error message=\"{}\"/>", escape_xml(*judged.error));
  if (judged.skipped) return fmt::format("<skipped message=\"{}\"/>", escape_xml(*judged.skipped));
  return "";
}

}  // namespace

std::string escape_xml(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  while (!text.empty()) {
    const Letter letter = first_letter(text);
    const std::size_t bytes = std::max<std::size_t>(letter.bytes, 1);
    if (letter.bytes == 0 || !may_stand_in_xml(letter.code)) {
      escaped += kReplacement;
    } else if (const std::string_view reference = reference_for(letter.code); !reference.empty()) {
      escaped += reference;
    } else {
      escaped += text.substr(0, bytes);
    }
    text.remove_prefix(bytes);
  }
  return escaped;
}

std::string to_junit_xml(const JUnitSuite& suite) {
  std::size_t failures = 0, errors = 0, skipped = 0;
  std::string body;
  for (const JUnitCase& judged : suite.cases) {
    const int outcomes = int{judged.failure.has_value()} + int{judged.error.has_value()} +
                         int{judged.skipped.has_value()};
    require(outcomes <= 1, "the case '{}' has {} outcomes", judged.name, outcomes);
    failures += judged.failure.has_value();
    errors += judged.error.has_value();
    skipped += judged.skipped.has_value();
    body += fmt::format("  <testcase classname=\"{}\" name=\"{}\" time=\"0\"",
                        escape_xml(judged.class_name), escape_xml(judged.name));
    body += outcomes == 0 ? std::string("/>\n")
                          : fmt::format(">\n    {}\n  </testcase>\n", outcome_of(judged));
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" "
      "time=\"0\">\n{}</testsuite>\n",
      escape_xml(suite.name), suite.cases.size(), failures, errors, skipped, body);
}

}  // namespace plumb::report
