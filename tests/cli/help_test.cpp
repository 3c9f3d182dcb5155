// The help, and that what it shows works.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <sstream>

#include "support/run_command.h"

namespace plumb::testing {
namespace {

// The subcommands that `plumb --help` lists.
std::vector<std::string> listed_commands() {
  std::vector<std::string> names;
  std::istringstream help(run_plumb({"--help"}).out);
  bool inside = false;
  for (std::string line; std::getline(help, line);) {
    if (line.rfind("Subcommands", 0) == 0) {
      inside = true;
    } else if (inside && line.rfind("  ", 0) == 0 && line[2] != ' ') {
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    } else if (line.empty()) {
      inside = false;
    }
  }
  return names;
}

std::string example_of(const std::string& command) {
  const std::string help = run_plumb({command, "--help"}).out;
  const std::string heading = "Example:\n  ";
  const std::size_t at = help.find(heading);
  if (at == std::string::npos) return "";
  return help.substr(at + heading.size(),
                     help.find('\n', at + heading.size()) - at - heading.size());
}

TEST(Help, ListsTheCommands) {
  const std::vector<std::string> names = listed_commands();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.front(), "info");
}

TEST(Help, OfEveryCommandHasAnExampleThatWorksAsPrinted) {
  for (const std::string& name : listed_commands()) {
    const TemporaryFolder folder;
    const std::string example = example_of(name);
    ASSERT_NE(example.find("plumb " + name), std::string::npos) << name << ": " << example;
    const std::string path = std::string(PLUMB_BIN_DIR) + ":" + ::getenv("PATH");
    const CommandResult result =
        run_command({"sh", "-c", example}, {folder.path().string(), {{"PATH", path}}});
    EXPECT_EQ(result.status, 0) << example << "\n" << result.err;
  }
}

TEST(Version, NamesTheProgramAndItsLibraries) {
  const CommandResult text = run_plumb({"--version"});
  EXPECT_EQ(text.status, 0);
  EXPECT_EQ(text.out.rfind("plumb ", 0), 0u);
  const CommandResult result =
      run_plumb({"--version", "--json"}, {.environment = {{"PLUMB_ISA", "sse2"}}});
  EXPECT_EQ(result.status, 0);
  const nlohmann::json json = nlohmann::json::parse(result.out);
  EXPECT_EQ(text.out.substr(6, text.out.find('\n') - 6), json.at("plumb"));
  EXPECT_EQ(json.at("kernels"), "sse2");
  for (const char* library : {"Embree", "OpenImageIO", "GDAL", "TBB", "GLM"})
    EXPECT_FALSE(json.at("libraries").at(library).get<std::string>().empty()) << library;
}

}  // namespace
}  // namespace plumb::testing
