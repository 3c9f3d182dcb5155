#include "terrain/ply_header.h"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/check.h"
#include "terrain/text_tokens.h"

namespace plumb::terrain {
namespace {

constexpr std::size_t kMostHeaderLineBytes = 1 << 16;

struct TypeName {
  const char *old_name, *name;
  PlyType type;
  std::size_t bytes;
};
constexpr std::array<TypeName, 8> kTypes{{{"char", "int8", PlyType::Int8, 1},
                                          {"uchar", "uint8", PlyType::UInt8, 1},
                                          {"short", "int16", PlyType::Int16, 2},
                                          {"ushort", "uint16", PlyType::UInt16, 2},
                                          {"int", "int32", PlyType::Int32, 4},
                                          {"uint", "uint32", PlyType::UInt32, 4},
                                          {"float", "float32", PlyType::Float32, 4},
                                          {"double", "float64", PlyType::Float64, 8}}};

template <class... Args>
[[noreturn]] void fail(const ForwardFile& file, fmt::format_string<Args...> message,
                       Args&&... args) {
  input_error("{}: line {}: {}", file.name(), file.line(),
              fmt::format(message, std::forward<Args>(args)...));
}

std::string_view header_line(ForwardFile& file) {
  std::string_view line;
  if (!file.read_line(line, kMostHeaderLineBytes))
    input_error("{}: the file ends after line {}, expected a header that ends with 'end_header'",
                file.name(), file.line());
  return line;
}

PlyType type_in(const ForwardFile& file, std::string_view word) {
  std::string known;
  for (const TypeName& type : kTypes) {
    if (word == type.old_name || word == type.name) return type.type;
    known += fmt::format("{}{} or {}", known.empty() ? "" : ", ", type.old_name, type.name);
  }
  fail(file, "expected a type ({}), got {}", known, shown(word));
}

PlyFormat format_in(const ForwardFile& file, std::string_view rest) {
  const std::string_view format = next_token(rest), version = next_token(rest);
  if (version == "1.0") {
    if (format == "ascii") return PlyFormat::Ascii;
    if (format == "binary_little_endian") return PlyFormat::LittleEndian;
    if (format == "binary_big_endian") return PlyFormat::BigEndian;
  }
  fail(file,
       "expected 'format' with ascii, binary_little_endian or binary_big_endian and 1.0, got {} {}",
       shown(format), shown(version));
}

PlyElement element_in(const ForwardFile& file, std::string_view rest) {
  PlyElement element;
  element.name = next_token(rest);
  const std::string_view word = next_token(rest);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), element.count);
  if (word.empty() || error != std::errc() || end != word.data() + word.size())
    fail(file, "expected 'element', a name and how many there are, got {} {}", shown(element.name),
         shown(word));
  return element;
}

PlyProperty property_in(const ForwardFile& file, std::string_view rest) {
  PlyProperty property;
  std::string_view word = next_token(rest);
  if (word == "list") {
    property.count_type = type_in(file, next_token(rest));
    if (*property.count_type == PlyType::Float32 || *property.count_type == PlyType::Float64)
      fail(file, "expected a list with a count of a type of integers");
    word = next_token(rest);
  }
  property.type = type_in(file, word);
  property.name = next_token(rest);
  if (property.name.empty()) fail(file, "expected 'property', a type and a name");
  return property;
}

void take_comment(std::string_view rest, PlyHeader& header) {
  if (next_token(rest) == "origin_m" && !header.origin_m) header.origin_m = std::string(rest);
}

void check(const ForwardFile& file, const PlyHeader& header) {
  for (const PlyElement& element : header.elements) {
    if (element.count > 0 && element.properties.empty())
      fail(file, "expected a property of element {}, which has none", shown(element.name));
  }
}

}  // namespace

std::size_t size_of(PlyType type) { return kTypes[static_cast<std::size_t>(type)].bytes; }

PlyHeader read_ply_header(ForwardFile& file) {
  if (header_line(file) != "ply") fail(file, "expected 'ply', the first line of a PLY file");
  PlyHeader header;
  std::optional<PlyFormat> format;
  for (;;) {
    std::string_view rest = header_line(file);
    const std::string_view word = next_token(rest);
    if (word == "end_header") break;
    if (word == "format") {
      format = format_in(file, rest);
    } else if (word == "element") {
      header.elements.push_back(element_in(file, rest));
    } else if (word == "property") {
      if (header.elements.empty()) fail(file, "expected an element before its property");
      header.elements.back().properties.push_back(property_in(file, rest));
    } else if (word == "comment") {
      take_comment(rest, header);
    } else if (word != "obj_info" && !word.empty()) {
      fail(file,
           "expected a line of a PLY header (format, comment, element, property, end_header), "
           "got {}",
           shown(word));
    }
  }
  if (!format) fail(file, "expected a line 'format' before the header's end");
  header.format = *format;
  check(file, header);
  return header;
}

std::optional<glm::dvec3> ply_origin_m(const std::string& text) {
  std::string_view rest = text;
  glm::dvec3 origin_m{0.0};
  for (int axis = 0; axis < 3; ++axis) {
    const auto value = number_in(next_token(rest));
    if (!value || !std::isfinite(*value)) return std::nullopt;
    origin_m[axis] = *value;
  }
  return next_token(rest).empty() ? std::optional(origin_m) : std::nullopt;
}

}  // namespace plumb::terrain
