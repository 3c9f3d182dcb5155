// The only file that knows the TOML library.
#include "audit/toml_document.h"

#include <fmt/ranges.h>
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/check.h"

namespace plumb::audit {
namespace {

TomlTable entries_of(const toml::table& table, const std::string& name, const std::string& path);

TomlValue value_of(const toml::node& node, const std::string& name, const std::string& path) {
  TomlValue value;
  value.line = static_cast<int>(node.source().begin.line);
  value.where = fmt::format("{}, line {}: {}", name, value.line, path);
  if (const auto* text = node.as_string()) {
    value.data = text->get();
  } else if (const auto* truth = node.as_boolean()) {
    value.data = truth->get();
  } else if (const auto* whole = node.as_integer()) {
    value.data = whole->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.data = number->get();
  } else if (const auto* table = node.as_table()) {
    value.data = entries_of(*table, name, path + ".");
  } else if (const auto* array = node.as_array()) {
    TomlList list;
    for (const toml::node& item : *array) list.push_back(value_of(item, name, path));
    value.data = std::move(list);
  }
  return value;
}

// `path` is what stands before a key, "" or "camera.".
TomlTable entries_of(const toml::table& table, const std::string& name, const std::string& path) {
  struct Placed {
    toml::source_position place;
    TomlEntry entry;
  };
  std::vector<Placed> placed;
  for (const auto& [key, node] : table) {
    const std::string word(key.str());
    placed.push_back({key.source().begin, {word, value_of(node, name, path + word)}});
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const Placed& a, const Placed& b) { return a.place < b.place; });
  TomlTable entries;
  for (Placed& each : placed) entries.push_back(std::move(each.entry));
  return entries;
}

std::string number_text(const TomlValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return fmt::format("{}", *whole);
  if (const auto* number = std::get_if<double>(&value.data)) return fmt::format("{}", *number);
  input_error("{}: expected a text, a number or a list of numbers", value.where);
}

}  // namespace

TomlTable parse_toml(const std::string& text, const std::string& name) {
  try {
    return entries_of(toml::parse(text), name, "");
  } catch (const toml::parse_error& error) {
    input_error("{}, line {}: {}", name, error.source().begin.line, error.description());
  }
}

std::string read_text_file(const std::string& path, const std::string& what) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file) input_error("cannot read the {} '{}'", what, path);
  return text.str();
}

double number_in(const TomlValue& value) {
  if (const auto* number = std::get_if<double>(&value.data)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value.data))
    return static_cast<double>(*whole);
  input_error("{}: expected a number", value.where);
}

int whole_number_in(const TomlValue& value, int least, int most) {
  const auto* whole = std::get_if<std::int64_t>(&value.data);
  if (whole == nullptr || *whole < least || *whole > most)
    input_error("{}: expected a whole number from {} to {}", value.where, least, most);
  return static_cast<int>(*whole);
}

bool truth_in(const TomlValue& value) {
  const auto* truth = std::get_if<bool>(&value.data);
  if (truth == nullptr) input_error("{}: expected true or false", value.where);
  return *truth;
}

std::string word_in(const TomlValue& value) {
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr || text->empty()) input_error("{}: expected a name in quotes", value.where);
  return *text;
}

glm::dvec3 vector_in(const TomlValue& value) {
  const auto* list = std::get_if<TomlList>(&value.data);
  if (list == nullptr || list->size() != 3)
    input_error("{}: expected three numbers, [x, y, z]", value.where);
  glm::dvec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    result[axis] = number_in((*list)[static_cast<std::size_t>(axis)]);
    if (!std::isfinite(result[axis])) input_error("{}: expected finite numbers", value.where);
  }
  return result;
}

const TomlTable& table_in(const TomlValue& value) {
  const auto* table = std::get_if<TomlTable>(&value.data);
  if (table == nullptr) input_error("{}: expected a table", value.where);
  return *table;
}

const TomlList& tables_in(const TomlValue& value) {
  const auto* list = std::get_if<TomlList>(&value.data);
  const bool all = list != nullptr && std::all_of(list->begin(), list->end(), [](const auto& item) {
                     return std::holds_alternative<TomlTable>(item.data);
                   });
  if (!all) input_error("{}: expected tables, each under its own [[...]]", value.where);
  return *list;
}

std::string argument_in(const TomlValue& value) {
  if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
  const auto* list = std::get_if<TomlList>(&value.data);
  if (list == nullptr) return number_text(value);
  std::vector<std::string> parts;
  for (const TomlValue& item : *list) parts.push_back(number_text(item));
  return fmt::format("{}", fmt::join(parts, ","));
}

void unknown_key(const TomlValue& value, const std::string& owner,
                 const std::vector<std::string>& known) {
  input_error("{}: unknown key; {} has {}", value.where, owner, fmt::join(known, ", "));
}

std::string toml_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string toml_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

}  // namespace plumb::audit
