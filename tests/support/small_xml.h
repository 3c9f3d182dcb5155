// Whether a text is well-formed XML, of the little that our own files use of it: a declaration,
// elements, attributes in double quotes, text, references. No comments, sections or doctypes.
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace plumb::testing {

/// Why it is not; "" if it is.
inline std::string xml_fault(const std::string& xml) {
  static const std::string kText =
      R"((?:[^<&"\x00-\x08\x0b\x0c\x0e-\x1f]|&(?:amp|lt|gt|quot|apos|#[0-9]+);)*)";
  static const std::regex kDeclaration(R"(^<\?xml [^?<>]*\?>\s*)");
  static const std::regex kTag(
      "^<(/?)([A-Za-z_][-A-Za-z0-9_.]*)((?:\\s+[A-Za-z_][-A-Za-z0-9_.]*=\"" + kText +
      "\")*)\\s*(/?)>");
  static const std::regex kBetween("^" + kText + "$");
  std::string rest = std::regex_replace(xml, kDeclaration, "");
  std::vector<std::string> open;
  int roots = 0;
  while (!rest.empty()) {
    const std::string between = rest.substr(0, rest.find('<'));
    const bool blank = between.find_first_not_of(" \n") == std::string::npos;
    if (!std::regex_match(between, kBetween) || (open.empty() && !blank)) return "text: " + between;
    rest.erase(0, between.size());
    if (rest.empty()) break;
    std::smatch tag;
    if (!std::regex_search(rest, tag, kTag)) return "tag: " + rest.substr(0, 80);
    const bool closes = tag[1].length() > 0, is_empty = tag[4].length() > 0;
    const std::string name = tag[2];
    if (closes && (is_empty || tag[3].length() > 0 || open.empty() || open.back() != name))
      return "closes: " + name;
    if (!closes && open.empty() && ++roots > 1) return "a second root: " + name;
    if (closes) open.pop_back();
    if (!closes && !is_empty) open.push_back(name);
    rest = tag.suffix();
  }
  if (!open.empty()) return "left open: " + open.back();
  return roots == 1 ? "" : "no root";
}

}  // namespace plumb::testing
