#include "terrain/generator_parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/number_text.h"
#include "terrain/read_options.h"

namespace plumb::terrain {
namespace {

constexpr const char* kPrefix = "generate:";

const GeneratorHelp& help_of(const std::string& name) {
  std::string known;
  for (const GeneratorHelp& help : generator_help()) {
    if (help.name == name) return help;
    known += (known.empty() ? "" : " ") + help.name;
  }
  input_error("generate:{}: there is no such generator; known are {}", name, known);
}

std::string known_parameters(const GeneratorHelp& help) {
  std::string known;
  for (const GeneratorParameter& parameter : help.parameters) {
    known += (known.empty() ? "" : " ") + parameter.name;
  }
  return known;
}

const GeneratorParameter* find(const GeneratorHelp& help, const std::string& name) {
  for (const GeneratorParameter& parameter : help.parameters) {
    if (parameter.name == name) return &parameter;
  }
  return nullptr;
}

}  // namespace

bool is_generator(const std::string& argument) { return argument.starts_with(kPrefix); }

GeneratorValues::GeneratorValues(const std::string& argument) {
  const std::string rest =
      is_generator(argument) ? argument.substr(std::string(kPrefix).size()) : argument;
  const std::size_t mark = rest.find('?');
  help_ = &help_of(rest.substr(0, mark));
  std::string query = mark == std::string::npos ? "" : rest.substr(mark + 1);
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string item = query.substr(0, end);
    query = end == std::string::npos ? "" : query.substr(end + 1);
    const std::size_t equals = item.find('=');
    const std::string key = item.substr(0, equals);
    if (!find(*help_, key)) {
      input_error("generate:{}: there is no parameter '{}'; known are {}", name(), key,
                  known_parameters(*help_));
    }
    if (equals == std::string::npos || equals + 1 == item.size()) {
      input_error("generate:{}: parameter '{}' has no value, expected {}=VALUE", name(), key, key);
    }
    if (!given_.emplace(key, item.substr(equals + 1)).second) {
      input_error("generate:{}: parameter '{}' is given twice", name(), key);
    }
  }
}

std::string GeneratorValues::canonical() const {
  std::string result = kPrefix + name();
  char separator = '?';
  for (const GeneratorParameter& parameter : help_->parameters) {
    result += fmt::format("{}{}={}", separator, parameter.name, text(parameter.name));
    separator = '&';
  }
  return result;
}

const std::string& GeneratorValues::text(const std::string& parameter) const {
  const auto found = given_.find(parameter);
  if (found != given_.end()) return found->second;
  const GeneratorParameter* known = find(*help_, parameter);
  require(known != nullptr, "generator {} has no parameter {}", name(), parameter);
  return known->default_value;
}

void GeneratorValues::refuse(const std::string& parameter, const std::string& expected) const {
  input_error("generate:{}: {} '{}': expected {}", name(), parameter, text(parameter), expected);
}

double GeneratorValues::number(const std::string& parameter, double low, double high) const {
  const auto value = parse_number(text(parameter));
  if (!value || !(*value >= low && *value <= high)) {
    refuse(parameter, fmt::format("a number from {} to {}", low, high));
  }
  return *value;
}

int GeneratorValues::whole(const std::string& parameter, int low, int high) const {
  const auto value = parse_integer(text(parameter));
  if (!value || *value < low || *value > high) {
    refuse(parameter, fmt::format("a whole number from {} to {}", low, high));
  }
  return static_cast<int>(*value);
}

std::uint64_t GeneratorValues::seed() const {
  const auto value = parse_integer(text("seed"));
  if (!value || *value < 0) refuse("seed", "a whole number >= 0");
  return static_cast<std::uint64_t>(*value);
}

std::pair<double, double> GeneratorValues::pair(const std::string& parameter, double low,
                                                double high) const {
  const std::string& both = text(parameter);
  const std::size_t comma = both.find(',');
  const auto first = parse_number(both.substr(0, comma));
  const auto second = comma == std::string::npos ? first : parse_number(both.substr(comma + 1));
  const auto fits = [&](double value) { return value >= low && value <= high; };
  if (!first || !second || !fits(*first) || !fits(*second)) {
    refuse(parameter, fmt::format("A or A,B with numbers from {} to {}", low, high));
  }
  return {*first, *second};
}

glm::dvec2 GeneratorValues::origin_m() const {
  const auto both = pair("origin", -1e9, 1e9);
  const glm::dvec2 origin(both.first, both.second);
  if (whole("utm", 0, 1) == 0) return origin;
  // The canonical argument names an origin that was not given as well.
  if (origin != glm::dvec2(0.0)) refuse("origin", "either origin or utm=1, not both");
  return {500000.0, 4500000.0};
}

GridShape GeneratorValues::shape() const {
  const std::string& size = text("size");
  GridShape shape;
  if (size.find('x') == std::string::npos) {
    shape.columns = shape.rows = whole("size", 1, std::numeric_limits<int>::max());
  } else {
    try {
      const RawSize both = parse_raw_size(size);
      shape.columns = both.columns;
      shape.rows = both.rows;
    } catch (const InputError&) {
      refuse("size", "N or WIDTHxHEIGHT in samples, >= 1");
    }
  }
  const auto spacing = pair("spacing", 1e-6, 1e6);
  shape.dx_m = spacing.first;
  shape.dy_m = spacing.second;
  return shape;
}

}  // namespace plumb::terrain
