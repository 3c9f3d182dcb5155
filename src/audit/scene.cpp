#include "audit/scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "audit/terrain_table.h"
#include "audit/toml_document.h"
#include "core/check.h"

namespace plumb::audit {
namespace {

// What a key of a scene's table does, and where the scene lies.
struct Place {
  Scene& scene;
  const std::string& folder;
};

struct Key {
  const char* name;
  void (*read)(Place&, const TomlValue&);
};

constexpr Key kMethodKeys[] = {
    {"name", [](Place& p, const TomlValue& v) { p.scene.method = word_in(v); }},
    {"variant", [](Place& p, const TomlValue& v) { p.scene.choice.variant = word_in(v); }},
    {"tolerance",
     [](Place& p, const TomlValue& v) {
       p.scene.tolerance =
           parsed_argument(v, [](const std::string& t) { return parse_tolerance(t); });
     }},
    {"parameters",
     [](Place& p, const TomlValue& v) {
       for (const auto& [key, value] : table_in(v))
         p.scene.choice.parameters[key] = argument_in(value);
     }},
};

constexpr Key kRenderKeys[] = {
    {"what",
     [](Place& p, const TomlValue& v) {
       const std::string what = word_in(v);
       if (what != "method" && what != "truth")
         input_error("{}: expected \"method\" or \"truth\", got \"{}\"", v.where, what);
       p.scene.painter = what == "truth" ? Painter::Truth : Painter::Method;
     }},
    {"drape", [](Place& p, const TomlValue& v) { p.scene.drape = beside(word_in(v), p.folder); }},
};

template <std::size_t N>
void read_table(Place& place, const TomlValue& table, const std::string& owner,
                const Key (&keys)[N]) {
  for (const auto& [key, value] : table_in(table)) {
    const Key* known = nullptr;
    for (const Key& candidate : keys) {
      if (key == candidate.name) known = &candidate;
    }
    if (known == nullptr) {
      std::vector<std::string> names;
      for (const Key& candidate : keys) names.emplace_back(candidate.name);
      unknown_key(value, owner, names);
    }
    known->read(place, value);
  }
}

void read_terrain(Place& place, const TomlValue& value) {
  TerrainTable table;
  for (const TomlEntry& entry : table_in(value)) {
    if (!read_terrain_entry(table, entry))
      unknown_key(entry.value, "a scene's terrain", terrain_keys());
  }
  if (!table.source.empty()) place.scene.terrain = beside(table.source, place.folder);
  place.scene.read = table.read;
  place.scene.diagonal = table.diagonal;
}

void require_whole(const Scene& scene, bool has_camera, const std::string& name) {
  if (scene.terrain.empty()) input_error("{}: a scene needs a source in its [terrain]", name);
  if (!has_camera) input_error("{}: a scene needs a [camera]", name);
  if (scene.painter == Painter::Method && scene.method.empty())
    input_error("{}: a scene needs a name in its [method], or what = \"truth\" in its [render]",
                name);
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name, const std::string& folder) {
  Scene scene;
  Place place{scene, folder};
  bool has_camera = false;
  for (const auto& [key, value] : parse_toml(text, name)) {
    if (key == "terrain") {
      read_terrain(place, value);
    } else if (key == "camera") {
      scene.camera = camera_in(table_in(value), value.where);
      has_camera = true;
    } else if (key == "method") {
      read_table(place, value, "a scene's method", kMethodKeys);
    } else if (key == "render") {
      read_table(place, value, "a scene's render", kRenderKeys);
    } else {
      unknown_key(value, "a scene", {"terrain", "camera", "method", "render"});
    }
  }
  require_whole(scene, has_camera, name);
  return scene;
}

Scene read_scene_file(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return parse_scene(read_text_file(path, "scene"), path, folder);
}

}  // namespace plumb::audit
