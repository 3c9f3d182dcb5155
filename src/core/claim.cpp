#include "core/claim.h"

#include <cmath>

#include "core/check.h"
#include "core/number_text.h"

namespace plumb {

const char* name_of(Measure measure) {
  switch (measure) {
    case Measure::SampleError:
      return "sample-error";
    case Measure::SurfaceError:
      return "surface-error";
    case Measure::PixelError:
      return "pixel-error";
    case Measure::Coverage:
      return "coverage";
    case Measure::NearestError:
      return "nearest-error";
  }
  return "?";
}

const char* name_of(Unit unit) {
  switch (unit) {
    case Unit::Metre:
      return "m";
    case Unit::Pixel:
      return "px";
    case Unit::Count:
      return "";
  }
  return "?";
}

const char* name_of(Scope scope) { return scope == Scope::Frame ? "frame" : "patch"; }

Tolerance parse_tolerance(const std::string& text, const std::string& named) {
  Tolerance tolerance;
  std::string number = text;
  if (text.ends_with("px")) {
    tolerance.unit = Unit::Pixel;
    number.resize(text.size() - 2);
  } else if (text.ends_with("m")) {
    tolerance.unit = Unit::Metre;
    number.resize(text.size() - 1);
  } else {
    input_error("{} '{}': expected a number with its unit, such as 1px or 5m", named, text);
  }
  const auto value = parse_number(number);
  if (!value || !std::isfinite(*value) || *value < 0.0) {
    input_error("{} '{}': expected a finite number >= 0 before '{}'", named, text,
                name_of(tolerance.unit));
  }
  tolerance.value = *value;
  return tolerance;
}

std::string to_text(const Tolerance& tolerance) {
  return fmt::format("{}{}", tolerance.value, name_of(tolerance.unit));
}

}  // namespace plumb
