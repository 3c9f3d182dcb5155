// What a user sets of a method, as text, read and checked.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "audit/method.h"
#include "core/check.h"

namespace plumb::audit {

/// A whole number from 0 to a million; `otherwise` if the choice has no such parameter. Each of
/// these throws InputError, with the parameter's name, for anything else.
int integer_parameter(const MethodChoice& choice, const std::string& name, int otherwise);

/// A power of two from 8 to `most`.
int power_parameter(const MethodChoice& choice, const std::string& name, int otherwise, int most);

enum class Least { AboveZero, Zero };

/// A finite number, above zero or of at least zero.
double number_parameter(const MethodChoice& choice, const std::string& name, double otherwise,
                        Least least = Least::AboveZero);

/// The value that a word stands for; the first one if the parameter is left out.
template <class Value>
Value word_parameter(const MethodChoice& choice, const std::string& name,
                     const std::vector<std::pair<std::string, Value>>& words) {
  const auto found = choice.parameters.find(name);
  if (found == choice.parameters.end()) return words.front().second;
  std::string known;
  for (const auto& [word, value] : words) {
    if (word == found->second) return value;
    known += (known.empty() ? "" : ", ") + word;
  }
  input_error("parameter {}: expected one of {}, got '{}'", name, known, found->second);
}

}  // namespace plumb::audit
