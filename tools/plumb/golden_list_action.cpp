// plumb golden list: which cases there are, without drawing any.
#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "core/check.h"
#include "golden_actions.h"
#include "golden_manifest.h"
#include "golden_picture.h"
#include "text_table.h"

namespace plumb::tool {
namespace {

struct ListedCase {
  GoldenCase golden;
  std::string kind;      // "scene", "picture"
  std::string drawn_by;  // who draws it, or the file that is kept of another program
};

ListedCase listed(const GoldenManifest& manifest, const GoldenCase& golden) {
  if (manifest.is_drawn(golden.name))
    return {golden, "scene",
            painter_text(audit::read_scene_file(manifest.scene(golden.name).string()))};
  const std::vector<std::filesystem::path> files = manifest.references(golden.name);
  return {golden, "picture",
          files.empty() ? "another program (no reference)"
                        : "another program, " + files.front().filename().string()};
}

std::string list_json(const GoldenManifest& manifest, const std::vector<ListedCase>& cases,
                      const std::string& command) {
  nlohmann::ordered_json json{{"schema", "plumb.golden-list/1"},
                              {"command", command},
                              {"manifest", manifest.path().string()}};
  json["cases"] = nlohmann::ordered_json::array();
  for (const ListedCase& each : cases)
    json["cases"].push_back({{"name", each.golden.name},
                             {"kind", each.kind},
                             {"drawn_by", each.drawn_by},
                             {"tolerance", each.golden.tolerance},
                             {"checksum", checksum_digits(each.golden.checksum)},
                             {"why", each.golden.why}});
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string list_text(const std::vector<ListedCase>& cases) {
  std::vector<std::vector<std::string>> rows;
  for (const ListedCase& each : cases)
    rows.push_back({each.golden.name, each.drawn_by, each.golden.tolerance,
                    checksum_digits(each.golden.checksum), each.golden.why});
  return text_table({{"case"}, {"drawn by"}, {"tolerance"}, {"checksum"}, {"why"}}, rows);
}

}  // namespace

int golden_list(const GoldenOptions& options, const Invocation& invocation) {
  const GoldenManifest manifest = read_manifest(options.folder);
  std::vector<ListedCase> cases;
  std::string unreadable;
  for (const GoldenCase& golden : manifest.cases) {
    try {
      cases.push_back(listed(manifest, golden));
    } catch (const InputError& error) {
      cases.push_back({golden, "scene", "a scene that cannot be read"});
      if (unreadable.empty()) unreadable = error.what();
    }
  }
  std::cout << (options.json ? list_json(manifest, cases, invocation.command_line())
                             : list_text(cases));
  if (!unreadable.empty()) input_error("{}", unreadable);
  return 0;
}

}  // namespace plumb::tool
