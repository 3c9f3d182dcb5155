#include "audit/method_parameters.h"

#include <bit>
#include <cmath>

#include "core/number_text.h"

namespace plumb::audit {

int integer_parameter(const MethodChoice& choice, const std::string& name, int otherwise) {
  const auto found = choice.parameters.find(name);
  if (found == choice.parameters.end()) return otherwise;
  const auto value = parse_integer(found->second);
  if (!value || *value < 0 || *value > 1'000'000)
    input_error("parameter {}: expected a whole number, got '{}'", name, found->second);
  return static_cast<int>(*value);
}

int power_parameter(const MethodChoice& choice, const std::string& name, int otherwise, int most) {
  const int value = integer_parameter(choice, name, otherwise);
  if (value < 8 || value > most || !std::has_single_bit(static_cast<unsigned>(value)))
    input_error("parameter {}: expected a power of two from 8 to {}, got {}", name, most, value);
  return value;
}

double number_parameter(const MethodChoice& choice, const std::string& name, double otherwise,
                        Least least) {
  const auto found = choice.parameters.find(name);
  if (found == choice.parameters.end()) return otherwise;
  const auto value = parse_number(found->second);
  const bool fits = value && (least == Least::Zero ? *value >= 0.0 : *value > 0.0);
  if (!fits || !std::isfinite(*value))
    input_error("parameter {}: expected a number {}, got '{}'", name,
                least == Least::Zero ? "of at least zero" : "above zero", found->second);
  return *value;
}

}  // namespace plumb::audit
