// What a TOML file holds, each value with its place, without the TOML library's types.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace plumb::audit {

struct TomlValue;
struct TomlEntry;
using TomlList = std::vector<TomlValue>;
using TomlTable = std::vector<TomlEntry>;  // in the file's order

/// One value; dates and times, which no file of ours has, are the first alternative.
struct TomlValue {
  std::variant<std::monostate, bool, std::int64_t, double, std::string, TomlList, TomlTable> data;
  std::string where;  // "scene.toml, line 3: camera.eye"
  int line = 0;       // of the file, from 1
};

struct TomlEntry {
  std::string key;
  TomlValue value;
};

/// The root table of a file. Throws InputError, one line with the file and the line in it, for what
/// is no TOML; `name` stands for the file in messages.
TomlTable parse_toml(const std::string& text, const std::string& name);
/// The whole file as text. Throws InputError ("cannot read the WHAT 'PATH'").
std::string read_text_file(const std::string& path, const std::string& what);

/// The value as what it must be. Each throws InputError, one line with the value's place and what
/// was expected.
double number_in(const TomlValue& value);
int whole_number_in(const TomlValue& value, int least, int most);
bool truth_in(const TomlValue& value);              // true or false
std::string word_in(const TomlValue& value);        // a text that is not empty
glm::dvec3 vector_in(const TomlValue& value);       // three finite numbers
const TomlTable& table_in(const TomlValue& value);  // [name]
const TomlList& tables_in(const TomlValue& value);  // [[name]]
/// A text, a number or a list of numbers as the command line would have it: "10,20" for [10, 20].
std::string argument_in(const TomlValue& value);

/// Throws the InputError for a key that nothing knows: "WHERE: unknown key; OWNER has A, B".
[[noreturn]] void unknown_key(const TomlValue& value, const std::string& owner,
                              const std::vector<std::string>& known);

/// A text in TOML's quotes, whatever is in it.
std::string toml_text(const std::string& text);
/// A number that reads back as the same double: always with a point or an exponent.
std::string toml_number(double value);

}  // namespace plumb::audit
