// Limits that a user sets.
#include <string_view>

#include <fmt/format.h>

#include "audit/claim_check.h"
#include "core/check.h"
#include "core/number_text.h"

namespace plumb::audit {

const std::vector<LimitMeasure>& limit_measures() {
  static const std::vector<LimitMeasure> measures{
      {"pixel-error", Unit::Pixel,
       "distance on screen between a drawn point and the truth above or below it (also in m)"},
      {"sample-error", Unit::Pixel, "displacement of a height sample, on screen or in m"},
      {"surface-error", Unit::Pixel, "the same between the samples as well"},
      {"reverse-pixel-error", Unit::Pixel,
       "from the truth's hit to the drawn surface above or below it"},
      {"nearest-error", Unit::Pixel,
       "distance to the nearest point of the other surface, projected, both ways (of stacks also "
       "in "
       "m)"},
      {"coverage", Unit::Count, "holes, overshoots and see-through pixels"},
      {"topology", Unit::Count,
       "open and non-manifold edges, non-manifold vertices, degenerate and folded triangles"},
      {"popping", Unit::Pixel,
       "of a path: how far what is drawn of a point went between two frames, the camera's own "
       "motion "
       "taken away"},
      {"uncovered-samples", Unit::Count, "samples with nothing drawn over them"},
  };
  return measures;
}

Limit parse_limit(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  std::string known;
  for (const LimitMeasure& measure : limit_measures()) {
    known += (known.empty() ? "" : ", ") + std::string(measure.name);
    if (name != measure.name || equals == std::string::npos) continue;
    const std::string value = text.substr(equals + 1);
    if (measure.unit == Unit::Count) {
      const auto count = parse_number(value);
      if (!count || !(*count >= 0.0))
        input_error("limit '{}': expected a number >= 0 after '='", text);
      return {name, *count, Unit::Count};
    }
    const Tolerance bound = parse_tolerance(value, fmt::format("limit '{}': bound", text));
    const bool metres_too =
        std::string_view(measure.meaning).find("in m") != std::string_view::npos ||
        name == "surface-error";
    if (bound.unit == Unit::Metre && !metres_too)
      input_error("limit '{}': {} is measured in px", text, name);
    return {name, bound.value, bound.unit};
  }
  input_error("limit '{}': expected MEASURE=VALUE, MEASURE one of {}", text, known);
}

}  // namespace plumb::audit
