#include "audit/camera_path.h"

#include <algorithm>
#include <utility>

#include "core/check.h"
#include "terrain/path_presets.h"

namespace plumb::audit {
namespace {

constexpr int kMostFrames = 100000;

struct Key {
  glm::dvec3 eye_m, target_m;
};

// Through b at s = 0 and c at s = 1, with the directions of its neighbours' chords.
glm::dvec3 catmull_rom(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                       const glm::dvec3& d, double s) {
  const glm::dvec3 leaving = 0.5 * (c - a), arriving = 0.5 * (d - b);
  const double s2 = s * s, s3 = s2 * s;
  return b +
         ((3.0 * s2 - 2.0 * s3) * (c - b) + (s3 - 2.0 * s2 + s) * leaving + (s3 - s2) * arriving);
}

// Position k of n frames along the keys: the whole part is a key's number.
glm::dvec3 along(const std::vector<Key>& keys, glm::dvec3 Key::*place, int frame, int frames) {
  const auto last = static_cast<std::int64_t>(keys.size()) - 1;
  const std::int64_t steps = std::max(frames - 1, 1);
  const std::int64_t whole = frame * last / steps, rest = frame * last % steps;
  const auto key = [&](std::int64_t k) {
    return keys[static_cast<std::size_t>(std::clamp<std::int64_t>(k, 0, last))].*place;
  };
  if (rest == 0) return key(whole);
  const double s = static_cast<double>(rest) / static_cast<double>(steps);
  if (last == 1) return key(0) + s * (key(1) - key(0));
  return catmull_rom(key(whole - 1), key(whole), key(whole + 1), key(whole + 2), s);
}

const TomlValue* find(const TomlTable& table, const std::string& key) {
  for (const TomlEntry& entry : table) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

std::vector<CameraDescription> frames_of_list(const TomlTable& root, const TomlValue& list) {
  for (const TomlEntry& entry : root) {
    if (entry.key != "camera") unknown_key(entry.value, "a list of cameras", {"camera"});
  }
  std::vector<CameraDescription> frames;
  for (const TomlValue& item : tables_in(list))
    frames.push_back(camera_in(table_in(item), item.where));
  return frames;
}

std::vector<Key> keys_of(const TomlValue& list) {
  std::vector<Key> keys;
  for (const TomlValue& item : tables_in(list)) {
    const CameraDescription camera = camera_in(table_in(item), item.where);
    CameraDescription bare;
    bare.eye_m = camera.eye_m;
    bare.target_m = camera.target_m;
    if (!(camera == bare))
      input_error("{}: a key has eye and target alone; what all frames share stands in [path]",
                  item.where);
    keys.push_back({camera.eye_m.value(), camera.target_m.value()});
  }
  if (keys.size() < 2) input_error("{}: a path needs two keys or more", list.where);
  return keys;
}

std::vector<CameraDescription> fly_over(const TomlTable& root, const TomlValue& path,
                                        const std::string& name) {
  const TomlValue* list = nullptr;
  for (const TomlEntry& entry : root) {
    if (entry.key == "key") {
      list = &entry.value;
    } else if (entry.key != "path") {
      unknown_key(entry.value, "a path", {"path", "key"});
    }
  }
  if (list == nullptr)
    input_error("{}: a path needs [[key]] tables, each with eye and target", name);
  const std::vector<Key> keys = keys_of(*list);

  // What is left of [path] without `frames` is a camera's, which the keys complete.
  TomlTable shared;
  int frames = 0;
  for (const TomlEntry& entry : table_in(path)) {
    if (entry.key == "frames") {
      frames = whole_number_in(entry.value, 1, kMostFrames);
    } else if (entry.key == "eye" || entry.key == "target" || entry.key == "preset") {
      input_error("{}: eye and target stand in [[key]] tables", entry.value.where);
    } else {
      shared.push_back(entry);
    }
  }
  if (frames == 0) input_error("{}: a path needs frames, how many pictures it has", path.where);
  const auto vector = [&](const char* key) {
    TomlValue component;
    component.where = path.where;
    component.data = 0.0;
    return TomlEntry{key, TomlValue{TomlList(3, component), path.where, path.line}};
  };
  shared.push_back(vector("eye"));
  shared.push_back(vector("target"));
  CameraDescription frame = camera_in(shared, path.where);
  std::vector<CameraDescription> all;
  for (int k = 0; k < frames; ++k) {
    frame.eye_m = along(keys, &Key::eye_m, k, frames);
    frame.target_m = along(keys, &Key::target_m, k, frames);
    all.push_back(frame);
  }
  return all;
}

}  // namespace

std::vector<CameraDescription> frames_of(const CameraDescription& description) {
  if (description.frame || !terrain::is_path_preset(description.preset)) return {description};
  std::vector<CameraDescription> frames(
      static_cast<std::size_t>(description.frames.value_or(terrain::kPathFrames)), description);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    frames[k].frame = static_cast<int>(k) + 1;
    frames[k].frames = static_cast<int>(frames.size());
  }
  return frames;
}

std::vector<CameraDescription> parse_camera_path(const std::string& text, const std::string& name) {
  const TomlTable root = parse_toml(text, name);
  if (const TomlValue* path = find(root, "path")) return fly_over(root, *path, name);
  if (const TomlValue* list = find(root, "camera")) return frames_of_list(root, *list);
  return frames_of(camera_in(root, name));
}

std::vector<CameraDescription> read_camera_path(const std::string& path) {
  return parse_camera_path(read_text_file(path, "camera file"), path);
}

}  // namespace plumb::audit
