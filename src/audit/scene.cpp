#include "audit/scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

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

// An error about an argument's text, with the place where it stands.
template <class Parse>
auto parsed(const TomlValue& value, const Parse& parse) {
  try {
    return parse(argument_in(value));
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (what.starts_with(value.where)) throw;
    input_error("{}: {}", value.where, what);
  }
}

// A file's name is meant beside the scene; generators, and what only GDAL can make sense of, stay.
std::string source_in(const TomlValue& value, const std::string& folder) {
  const std::string source = word_in(value);
  if (folder.empty() || source.find(':') != std::string::npos || source.starts_with("/"))
    return source;
  return (std::filesystem::path(folder) / source).lexically_normal().string();
}

constexpr Key kTerrainKeys[] = {
    {"source", [](Place& p, const TomlValue& v) { p.scene.terrain = source_in(v, p.folder); }},
    {"window",
     [](Place& p, const TomlValue& v) { p.scene.read.window = parsed(v, terrain::parse_window); }},
    {"spacing",
     [](Place& p, const TomlValue& v) {
       const terrain::Spacing spacing = parsed(v, terrain::parse_spacing);
       p.scene.read.spacing_x_m = spacing.x_m;
       p.scene.read.spacing_y_m = spacing.y_m;
     }},
    {"band",
     [](Place& p, const TomlValue& v) { p.scene.read.band = whole_number_in(v, 1, 65535); }},
    {"decode",
     [](Place& p, const TomlValue& v) { p.scene.read.decode = parsed(v, terrain::parse_decode); }},
    {"height_scale",
     [](Place& p, const TomlValue& v) { p.scene.read.height_scale = number_in(v); }},
    {"height_offset",
     [](Place& p, const TomlValue& v) { p.scene.read.height_offset_m = number_in(v); }},
    {"nodata", [](Place& p, const TomlValue& v) { p.scene.read.no_data = number_in(v); }},
    {"no_data",
     [](Place& p, const TomlValue& v) {
       p.scene.read.no_data_policy = parsed(v, terrain::parse_no_data_policy);
     }},
    {"crs", [](Place& p, const TomlValue& v) { p.scene.read.crs = word_in(v); }},
    {"raw", [](Place& p,
               const TomlValue& v) { p.scene.read.raw_size = parsed(v, terrain::parse_raw_size); }},
    {"origin",
     [](Place& p, const TomlValue& v) { p.scene.read.origin = parsed(v, terrain::parse_origin); }},
    {"byte_order",
     [](Place& p, const TomlValue& v) {
       p.scene.read.byte_order = parsed(v, terrain::parse_byte_order);
     }},
    {"surface",
     [](Place& p, const TomlValue& v) {
       p.scene.read.top_surface = parsed(v, terrain::parse_surface);
     }},
    {"diagonal",
     [](Place& p, const TomlValue& v) {
       p.scene.diagonal = name_of(parsed(v, terrain::parse_diagonal));
     }},
};

constexpr Key kMethodKeys[] = {
    {"name", [](Place& p, const TomlValue& v) { p.scene.method = word_in(v); }},
    {"variant", [](Place& p, const TomlValue& v) { p.scene.choice.variant = word_in(v); }},
    {"tolerance",
     [](Place& p, const TomlValue& v) {
       p.scene.tolerance = parsed(v, [](const std::string& t) { return parse_tolerance(t); });
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
    {"drape", [](Place& p, const TomlValue& v) { p.scene.drape = source_in(v, p.folder); }},
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
      read_table(place, value, "a scene's terrain", kTerrainKeys);
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
