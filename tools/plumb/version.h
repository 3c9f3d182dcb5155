// Which program this is, and what it was built with.
#pragma once

#include <string>

namespace plumb::tool {

std::string version_number();  // "0.1.0"
std::string version_text();    // lines for people
std::string version_json();    // one JSON object: plumb, compiler, libraries, kernels

}  // namespace plumb::tool
