#include "version.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "build_versions.h"  // generated
#include "core/instruction_set.h"

namespace plumb::tool {

std::string version_number() { return kPlumbVersion; }

std::string version_text() {
  std::string text =
      fmt::format("plumb {}\ncompiler   {} ({})\n", kPlumbVersion, kCompiler, kBuildType);
  text += "libraries  ";
  bool first = true;
  for (const LibraryVersion& library : kLibraries) {
    text += fmt::format("{}{} {}", first ? "" : ", ", library.name, library.version);
    first = false;
  }
  return text + fmt::format("\nkernels    {}\n", name_of(instruction_set()));
}

std::string version_json() {
  nlohmann::ordered_json json;
  json["schema"] = "plumb.version/1";
  json["plumb"] = kPlumbVersion;
  json["compiler"] = kCompiler;
  json["build_type"] = kBuildType;
  for (const LibraryVersion& library : kLibraries)
    json["libraries"][library.name] = library.version;
  json["kernels"] = name_of(instruction_set());
  return json.dump(2) + "\n";
}

}  // namespace plumb::tool
