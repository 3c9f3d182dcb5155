// The only file that knows the TOML library for cameras.
#include "audit/camera_file.h"

#include <fmt/ranges.h>
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include "core/check.h"
#include "core/number_text.h"
#include "terrain/camera_presets.h"

namespace plumb::audit {
namespace {

// One key's value in a file, with what a message needs to say where it stands.
struct Entry {
  const toml::node& node;
  std::string where;  // "camera.toml, line 3: eye"
};

double number(const Entry& entry) {
  const std::optional<double> value = entry.node.value<double>();
  if (!entry.node.is_number() || !value) input_error("{}: expected a number", entry.where);
  return *value;
}

int whole_number(const Entry& entry) {
  const std::optional<std::int64_t> value = entry.node.value<std::int64_t>();
  if (!entry.node.is_integer() || !value || *value < 1 || *value > 65536)
    input_error("{}: expected a whole number from 1 to 65536", entry.where);
  return static_cast<int>(*value);
}

glm::dvec3 vector(const Entry& entry) {
  const toml::array* array = entry.node.as_array();
  if (array == nullptr || array->size() != 3)
    input_error("{}: expected three numbers, [x, y, z]", entry.where);
  glm::dvec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    result[axis] = number({*array->get(static_cast<std::size_t>(axis)), entry.where});
    if (!std::isfinite(result[axis])) input_error("{}: expected finite numbers", entry.where);
  }
  return result;
}

std::string word(const Entry& entry) {
  const std::optional<std::string> value = entry.node.value<std::string>();
  if (!entry.node.is_string() || !value || value->empty())
    input_error("{}: expected a name in quotes", entry.where);
  return *value;
}

struct Key {
  const char* name;
  void (*read)(CameraDescription&, const Entry&);
};

constexpr Key kKeys[] = {
    {"eye", [](CameraDescription& c, const Entry& e) { c.eye_m = vector(e); }},
    {"target", [](CameraDescription& c, const Entry& e) { c.target_m = vector(e); }},
    {"up", [](CameraDescription& c, const Entry& e) { c.up = vector(e); }},
    {"fov_y_deg", [](CameraDescription& c, const Entry& e) { c.fov_y_deg = number(e); }},
    {"width", [](CameraDescription& c, const Entry& e) { c.width_px = whole_number(e); }},
    {"height", [](CameraDescription& c, const Entry& e) { c.height_px = whole_number(e); }},
    {"near", [](CameraDescription& c, const Entry& e) { c.near_m = number(e); }},
    {"far", [](CameraDescription& c, const Entry& e) { c.far_m = number(e); }},
    {"preset", [](CameraDescription& c, const Entry& e) { c.preset = word(e); }},
};

[[noreturn]] void unknown_key(const std::string& where) {
  std::vector<std::string> names;
  for (const Key& key : kKeys) names.emplace_back(key.name);
  input_error("{}: unknown key; a camera has {}", where, fmt::join(names, ", "));
}

void require_whole(const CameraDescription& camera, const std::string& name) {
  const bool placed = camera.eye_m || camera.target_m || camera.up;
  if (!camera.preset.empty() && placed)
    input_error("{}: a camera has either a preset or eye, target and up, not both", name);
  if (camera.preset.empty() && !(camera.eye_m && camera.target_m))
    input_error("{}: a camera needs eye and target, or a preset", name);
}

}  // namespace

CameraDescription parse_camera_toml(const std::string& text, const std::string& name) {
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    input_error("{}, line {}: {}", name, error.source().begin.line, error.description());
  }
  CameraDescription camera;
  for (const auto& [key, node] : table) {
    const std::string where =
        fmt::format("{}, line {}: {}", name, node.source().begin.line, std::string_view(key.str()));
    const Key* known = nullptr;
    for (const Key& candidate : kKeys) {
      if (key.str() == candidate.name) known = &candidate;
    }
    if (known == nullptr) unknown_key(where);
    known->read(camera, {node, where});
  }
  require_whole(camera, name);
  return camera;
}

CameraDescription read_camera_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (!file) input_error("cannot read the camera file '{}'", path);
  return parse_camera_toml(text.str(), path);
}

std::optional<CameraDescription> parse_camera_numbers(const std::string& text) {
  if (text.find(',') == std::string::npos) return std::nullopt;
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    const std::optional<double> value = parse_number(part);
    if (!value || !std::isfinite(*value))
      input_error("camera '{}': '{}' is not a finite number", text, part);
    numbers.push_back(*value);
  }
  if ((numbers.size() != 6 && numbers.size() != 7) || text.back() == ',')
    input_error("camera '{}': expected six or seven numbers, ex,ey,ez,tx,ty,tz[,fov]", text);
  CameraDescription camera;
  camera.eye_m = glm::dvec3(numbers[0], numbers[1], numbers[2]);
  camera.target_m = glm::dvec3(numbers[3], numbers[4], numbers[5]);
  if (numbers.size() == 7) camera.fov_y_deg = numbers[6];
  return camera;
}

LookAt resolve_camera(const CameraDescription& description, const terrain::Heightfield& field) {
  LookAt camera;
  camera.width_px = description.width_px.value_or(camera.width_px);
  camera.height_px = description.height_px.value_or(camera.height_px);
  camera.fov_y_deg = description.fov_y_deg.value_or(camera.fov_y_deg);
  if (!(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0))
    input_error("a camera's field of view must lie between 0 and 180 degrees, got {}",
                camera.fov_y_deg);
  if (!description.preset.empty()) {
    camera = terrain::preset_camera(field, description.preset, camera.width_px, camera.height_px,
                                    camera.fov_y_deg);
  } else {
    camera.eye_m = description.eye_m.value();
    camera.target_m = description.target_m.value();
    camera.up = description.up.value_or(camera.up);
  }
  camera.near_m = description.near_m.value_or(camera.near_m);
  camera.far_m = description.far_m.value_or(camera.far_m);
  if (!(camera.far_m > camera.near_m))
    input_error("a camera's far must be greater than its near {}, got {}", camera.near_m,
                camera.far_m);
  try {
    make_camera(camera);
  } catch (const std::invalid_argument& error) {
    input_error("this is no camera: {}", error.what());
  }
  return camera;
}

}  // namespace plumb::audit
