#include "audit/sweep/scene_terrain.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "audit/terrain_table.h"
#include "core/check.h"
#include "terrain/generators.h"

namespace plumb::audit::sweep {
namespace {

// "alpine" of "generate:alpine?size=65", "alps" of "dem/alps.tif".
std::string name_of_source(const std::string& source) {
  if (!terrain::is_generator(source)) return std::filesystem::path(source).stem().string();
  const std::size_t begin = source.find(':') + 1;
  return source.substr(begin, source.find('?') - begin);
}

std::string kind_of_source(const std::string& source) {
  const std::string name = name_of_source(source);
  if (!terrain::is_generator(source)) return name;
  constexpr std::array<std::pair<const char*, const char*>, 11> kKinds{{{"plane", "smooth"},
                                                                        {"tilted-plane", "smooth"},
                                                                        {"paraboloid", "smooth"},
                                                                        {"sinusoid", "smooth"},
                                                                        {"dunes", "smooth"},
                                                                        {"alpine", "alpine"},
                                                                        {"canyon", "alpine"},
                                                                        {"urban", "urban"},
                                                                        {"step", "urban"},
                                                                        {"spike", "urban"},
                                                                        {"checkerboard", "urban"}}};
  for (const auto& [generator, kind] : kKinds) {
    if (name == generator) return kind;
  }
  return name;
}

std::vector<std::string> known_keys() {
  std::vector<std::string> keys{"name", "kind"};
  for (std::string& key : terrain_keys()) keys.push_back(std::move(key));
  return keys;
}

}  // namespace

SweepTerrain terrain_in(const TomlValue& value, const std::string& folder) {
  SweepTerrain terrain;
  terrain.where = value.where;
  TerrainTable table;
  if (std::holds_alternative<TomlTable>(value.data)) {
    for (const TomlEntry& entry : table_in(value)) {
      if (entry.key == "name") {
        terrain.name = word_in(entry.value);
      } else if (entry.key == "kind") {
        terrain.kind = word_in(entry.value);
      } else if (!read_terrain_entry(table, entry)) {
        unknown_key(entry.value, "a sweep's terrain", known_keys());
      }
    }
  } else {
    table.source = word_in(value);
  }
  if (table.source.empty()) input_error("{}: a terrain needs a source", value.where);
  terrain.source = table.source;
  terrain.path = beside(table.source, folder);
  terrain.read = table.read;
  terrain.diagonal = table.diagonal;
  if (terrain.name.empty()) terrain.name = name_of_source(table.source);
  if (terrain.kind.empty()) terrain.kind = kind_of_source(table.source);
  return terrain;
}

}  // namespace plumb::audit::sweep
