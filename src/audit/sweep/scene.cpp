#include "audit/sweep/scene.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "audit/scene.h"
#include "audit/sweep/scene_camera.h"
#include "audit/sweep/scene_terrain.h"
#include "audit/terrain_table.h"
#include "audit/toml_document.h"
#include "core/check.h"

namespace plumb::audit::sweep {
namespace {

constexpr int kLargestSide_px = 65536;

// The file as it stands, before methods and lists are joined.
struct Draft {
  std::string name, folder;
  const MethodTable& table;
  SweepScene scene;
  std::vector<std::string> methods;
  std::vector<std::string> variants{"conservative"};
  std::vector<Tolerance> tolerances_px, tolerances_m;
  std::optional<int> width_px, height_px;
  std::map<std::string, std::vector<std::map<std::string, std::string>>> parameters;
  std::map<std::string, Only> only;
};

template <class Read>
auto list_of(const TomlValue& value, const char* what, const Read& read) {
  const auto* list = std::get_if<TomlList>(&value.data);
  if (list == nullptr || list->empty())
    input_error("{}: expected a list of {}, [..., ...]", value.where, what);
  std::vector<decltype(read(value))> items;
  for (const TomlValue& item : *list) {
    items.push_back(read(item));
  }
  return items;
}

std::vector<std::string> words_in(const TomlValue& value) {
  auto words = list_of(value, "names in quotes", word_in);
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (std::find(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(k), words[k]) !=
        words.begin() + static_cast<std::ptrdiff_t>(k))
      input_error("{}: '{}' stands in it twice", value.where, words[k]);
  }
  return words;
}

std::vector<Tolerance> tolerances_in(const TomlValue& value, Unit unit) {
  std::vector<Tolerance> tolerances = list_of(value, "numbers", [&](const TomlValue& item) {
    const Tolerance tolerance{number_in(item), unit};
    if (!(tolerance.value >= 0.0) || !std::isfinite(tolerance.value))
      input_error("{}: expected numbers of at least zero, got {}", item.where, tolerance.value);
    return tolerance;
  });
  for (std::size_t k = 1; k < tolerances.size(); ++k) {
    if (std::find(tolerances.begin(), tolerances.begin() + static_cast<std::ptrdiff_t>(k),
                  tolerances[k]) != tolerances.begin() + static_cast<std::ptrdiff_t>(k))
      input_error("{}: {} stands in it twice", value.where, tolerances[k].value);
  }
  return tolerances;
}

const Method& method_in(const Draft& draft, const std::string& name, const std::string& where) {
  try {
    return find_method(draft.table, name);
  } catch (const InputError& error) {
    input_error("{}: {}", where, error.what());
  }
}

void read_methods(Draft& draft, const TomlValue& value) {
  draft.methods = words_in(value);
  for (const std::string& name : draft.methods) method_in(draft, name, value.where);
}

std::map<std::string, std::string> parameters_in(const Method& method, const TomlValue& value) {
  std::map<std::string, std::string> set;
  for (const TomlEntry& entry : table_in(value)) {
    std::vector<std::string> known;
    for (const auto& parameter : method.parameters) known.push_back(parameter.first);
    if (std::find(known.begin(), known.end(), entry.key) == known.end()) {
      if (known.empty()) known.emplace_back("none");
      unknown_key(entry.value, "method " + method.name, known);
    }
    set[entry.key] = argument_in(entry.value);
  }
  return set;
}

void read_parameters(Draft& draft, const TomlValue& value) {
  for (const TomlEntry& entry : table_in(value)) {
    const Method& method = method_in(draft, entry.key, entry.value.where);
    auto& sets = draft.parameters[entry.key];
    if (const auto* list = std::get_if<TomlList>(&entry.value.data)) {
      for (const TomlValue& item : *list) sets.push_back(parameters_in(method, item));
    } else {
      sets.push_back(parameters_in(method, entry.value));
    }
  }
}

void read_only(Draft& draft, const TomlValue& value) {
  for (const TomlEntry& entry : table_in(value)) {
    method_in(draft, entry.key, entry.value.where);
    Only& only = draft.only[entry.key];
    std::vector<Tolerance> metres;
    for (const auto& [key, list] : table_in(entry.value)) {
      if (key == "terrains") {
        only.terrains = words_in(list);
      } else if (key == "variants") {
        only.variants = words_in(list);
      } else if (key == "tolerances_px") {
        only.tolerances = tolerances_in(list, Unit::Pixel);
      } else if (key == "tolerances_m") {
        metres = tolerances_in(list, Unit::Metre);
      } else {
        unknown_key(list, "a method of its own in a sweep",
                    {"terrains", "variants", "tolerances_px", "tolerances_m"});
      }
    }
    only.tolerances.insert(only.tolerances.end(), metres.begin(), metres.end());
  }
}

void read_cameras(Draft& draft, const TomlValue& value) {
  draft.scene.cameras = list_of(value, "presets, files and tables", [&](const TomlValue& item) {
    return sweep_camera_in(item, draft.folder);
  });
}

void read_key(Draft& draft, const std::string& key, const TomlValue& value) {
  if (key == "terrains") {
    draft.scene.terrains = list_of(value, "sources and tables", [&](const TomlValue& item) {
      return terrain_in(item, draft.folder);
    });
  } else if (key == "methods") {
    read_methods(draft, value);
  } else if (key == "variants") {
    draft.variants = words_in(value);
  } else if (key == "tolerances_px") {
    draft.tolerances_px = tolerances_in(value, Unit::Pixel);
  } else if (key == "tolerances_m") {
    draft.tolerances_m = tolerances_in(value, Unit::Metre);
  } else if (key == "sizes_px") {
    draft.scene.sizes = tolerances_in(value, Unit::Pixel);
  } else if (key == "cameras") {
    read_cameras(draft, value);
  } else if (key == "width") {
    draft.width_px = whole_number_in(value, 1, kLargestSide_px);
  } else if (key == "height") {
    draft.height_px = whole_number_in(value, 1, kLargestSide_px);
  } else if (key == "parameters") {
    read_parameters(draft, value);
  } else if (key == "only") {
    read_only(draft, value);
  } else {
    unknown_key(value, "a sweep",
                {"terrains", "methods", "variants", "tolerances_px", "tolerances_m", "sizes_px",
                 "cameras", "width", "height", "parameters", "only"});
  }
}

// Two runs must not be one.
template <class Items>
void require_different_names(const Items& items, const char* what) {
  for (std::size_t k = 0; k < items.size(); ++k) {
    for (std::size_t earlier = 0; earlier < k; ++earlier) {
      if (items[earlier].name == items[k].name)
        input_error("{}: two {} are called '{}': give one of them another name", items[k].where,
                    what, items[k].name);
    }
  }
}

// A variant that no method at all has is a mistake; one that those of the sweep lack is none.
void require_variants(const Draft& draft) {
  std::set<std::string> known;
  for (const Method& method : draft.table)
    known.insert(method.variants.begin(), method.variants.end());
  const auto check = [&](const std::vector<std::string>& variants, const std::string& where) {
    for (const std::string& variant : variants) {
      if (!known.contains(variant))
        input_error("{}: {}: no method has a variant '{}': there are {}", draft.name, where,
                    variant, fmt::join(known, ", "));
    }
  };
  check(draft.variants, "variants");
  for (const auto& [method, only] : draft.only)
    check(only.variants, "only." + method + ".variants");
}

// Tables for methods and terrains that the sweep does not have are mistakes.
void require_used(const Draft& draft) {
  const auto runs = [&](const std::string& method) {
    return std::find(draft.methods.begin(), draft.methods.end(), method) != draft.methods.end();
  };
  for (const auto& [method, sets] : draft.parameters) {
    if (!runs(method))
      input_error("{}: parameters.{}: the sweep does not run that method", draft.name, method);
  }
  for (const auto& [method, only] : draft.only) {
    if (!runs(method))
      input_error("{}: only.{}: the sweep does not run that method", draft.name, method);
    for (const std::string& terrain : only.terrains) {
      const auto& all = draft.scene.terrains;
      if (std::none_of(all.begin(), all.end(), [&](const auto& t) { return t.name == terrain; }))
        input_error("{}: only.{}.terrains: no terrain is called '{}'", draft.name, method, terrain);
    }
  }
}

void complete(Draft& draft) {
  SweepScene& scene = draft.scene;
  if (scene.terrains.empty()) input_error("{}: a sweep needs terrains = [...]", draft.name);
  if (draft.methods.empty()) input_error("{}: a sweep needs methods = [...]", draft.name);
  if (scene.cameras.empty()) {
    scene.cameras.push_back({"oblique", "oblique", {}, false, draft.name});
    scene.cameras.back().frames.emplace_back().preset = "oblique";
  }
  require_different_names(scene.terrains, "terrains");
  require_different_names(scene.cameras, "cameras");
  require_used(draft);
  require_variants(draft);
  std::vector<Tolerance> tolerances = draft.tolerances_px;
  tolerances.insert(tolerances.end(), draft.tolerances_m.begin(), draft.tolerances_m.end());
  if (tolerances.empty()) tolerances.push_back({1.0, Unit::Pixel});
  for (const std::string& name : draft.methods) {
    const Only& only = draft.only[name];
    SweepMethod method{name, draft.variants, tolerances, only.terrains, draft.parameters[name]};
    if (!only.variants.empty()) method.variants = only.variants;
    if (!only.tolerances.empty()) method.tolerances = only.tolerances;
    if (method.parameters.empty()) method.parameters.emplace_back();
    if (method.terrains.empty()) {
      for (const SweepTerrain& terrain : scene.terrains) method.terrains.push_back(terrain.name);
    }
    scene.methods.push_back(std::move(method));
  }
  for (SweepCamera& camera : scene.cameras) {
    for (CameraDescription& frame : camera.frames) {
      if (!frame.width_px) frame.width_px = draft.width_px;
      if (!frame.height_px) frame.height_px = draft.height_px;
    }
  }
}

}  // namespace

SweepScene parse_sweep(const std::string& text, const std::string& name, const MethodTable& table,
                       const std::string& folder) {
  Draft draft{name, folder, table, {}, {}, {"conservative"}, {}, {}, {}, {}, {}, {}};
  for (const auto& [key, value] : parse_toml(text, name)) read_key(draft, key, value);
  complete(draft);
  return std::move(draft.scene);
}

SweepScene read_sweep_file(const std::string& path, const MethodTable& table) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return parse_sweep(read_text_file(path, "sweep"), path, table, folder);
}

}  // namespace plumb::audit::sweep
