#include "method_options.h"

#include <algorithm>

#include "audit/claim_check.h"
#include "core/check.h"

namespace plumb::tool {

void add_method_options(Options& options, MethodOptions& method) {
  std::vector<std::string> names;
  for (const audit::Method& known : audit::built_in_methods()) names.push_back(known.name);
  options.group("Method");
  options.choice(method.method, "--method", names, "How the terrain is approximated");
  options.text(method.variant, "--variant", "NAME",
               "published or conservative; the method's first where it is left out");
  options.text(method.tolerance, "--tolerance", "NUMBERpx|NUMBERm",
               "How far the method may stray, on screen or in metres");
  options.texts(method.parameters, "--set", "NAME=VALUE", "A parameter of the method's own");
  options.text(method.prepared, "--prepared", "FILE",
               "Draw from what plumb build made of this terrain");
}

MethodRequest method_request(const MethodOptions& options) {
  MethodRequest request;
  request.method = &audit::find_method(audit::built_in_methods(), options.method);
  request.choice.variant = options.variant;
  request.tolerance = parse_tolerance(options.tolerance);
  for (const std::string& text : options.parameters) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      input_error("--set '{}': expected NAME=VALUE", text);
    request.choice.parameters[text.substr(0, equals)] = text.substr(equals + 1);
  }
  if (!options.prepared.empty()) {
    const auto& known = request.method->parameters;
    if (std::none_of(known.begin(), known.end(),
                     [](const auto& parameter) { return parameter.first == "prepared"; }))
      input_error("--prepared '{}': {} draws from no file", options.prepared, request.method->name);
    request.choice.parameters["prepared"] = options.prepared;
  }
  request.choice = audit::resolved_choice(*request.method, std::move(request.choice));
  request.variant = request.choice.variant;
  return request;
}

std::string limit_names() {
  std::string names;
  for (const audit::LimitMeasure& measure : audit::limit_measures())
    names += (names.empty() ? "" : ", ") + std::string(measure.name);
  return names;
}

}  // namespace plumb::tool
