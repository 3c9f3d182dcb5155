#include "audit/sweep/scene_camera.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <variant>

#include "audit/camera_file.h"
#include "audit/camera_path.h"
#include "audit/scene.h"
#include "audit/terrain_table.h"
#include "core/check.h"
#include "terrain/camera_presets.h"
#include "terrain/path_presets.h"

namespace plumb::audit::sweep {
namespace {

bool is_preset(const std::string& name) {
  const auto& presets = terrain::preset_help();
  return terrain::is_path_preset(name) ||
         std::any_of(presets.begin(), presets.end(), [&](const auto& p) { return p.name == name; });
}

SweepCamera camera_by_name(const TomlValue& value, const std::string& folder) {
  const std::string word = word_in(value);
  SweepCamera camera{word, word, {}, false, value.where};
  if (is_preset(word)) {
    CameraDescription preset;
    preset.preset = word;
    camera.frames = frames_of(preset);
    camera.is_path = camera.frames.size() > 1;
    return camera;
  }
  const std::string path = beside(word, folder);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    std::string presets;
    for (const auto& preset : terrain::preset_help())
      presets += (presets.empty() ? "" : ", ") + preset.name;
    for (const auto& preset : terrain::path_preset_help()) presets += ", " + preset.name;
    input_error("{}: '{}' is neither a preset ({}) nor a file", value.where, path, presets);
  }
  camera.frames = read_camera_path(path);
  camera.is_path = camera.frames.size() > 1;
  return camera;
}

SweepCamera camera_table(const TomlValue& value) {
  SweepCamera camera;
  camera.where = value.where;
  TomlTable rest;
  for (const TomlEntry& entry : table_in(value)) {
    if (entry.key == "name") {
      camera.name = word_in(entry.value);
    } else {
      rest.push_back(entry);
    }
  }
  const CameraDescription described = camera_in(rest, value.where);
  camera.frames = frames_of(described);
  camera.is_path = camera.frames.size() > 1;
  if (camera.name.empty()) camera.name = described.preset;
  if (camera.name.empty()) input_error("{}: a camera of a sweep needs a name", value.where);
  camera.argument = inline_toml(described);
  return camera;
}

}  // namespace

SweepCamera sweep_camera_in(const TomlValue& value, const std::string& folder) {
  return std::holds_alternative<TomlTable>(value.data) ? camera_table(value)
                                                       : camera_by_name(value, folder);
}

}  // namespace plumb::audit::sweep
