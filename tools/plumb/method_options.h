// The options that choose a method, for every command that draws.
#pragma once

#include <string>
#include <vector>

#include "audit/method.h"
#include "core/claim.h"
#include "options.h"

namespace plumb::tool {

struct MethodOptions {
  std::string method = "restricted-quadtree";
  std::string variant;
  std::string tolerance = "1px";
  std::vector<std::string> parameters;  // "name=value"
  std::string prepared;                 // a file of plumb build

  friend bool operator==(const MethodOptions&, const MethodOptions&) = default;
};

void add_method_options(Options& options, MethodOptions& method);

/// What the options mean, in the table of methods that come with plumb.
struct MethodRequest {
  const audit::Method* method = nullptr;
  audit::MethodChoice choice;
  std::string variant;  // as settled
  Tolerance tolerance;
};

/// Throws InputError for what is unknown or cannot be read.
MethodRequest method_request(const MethodOptions& options);

/// The measures that a limit may name, as a list.
std::string limit_names();

}  // namespace plumb::tool
