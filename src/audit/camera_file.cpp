#include "audit/camera_file.h"

#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "audit/scene.h"
#include "audit/toml_document.h"
#include "core/box.h"
#include "core/check.h"
#include "core/number_text.h"
#include "core/reproducible_math.h"
#include "terrain/camera_presets.h"
#include "terrain/path_presets.h"

namespace plumb::audit {
namespace {

constexpr int kLargestSide_px = 65536;
constexpr int kMostPathFrames = 100000;

EngineCamera& engine_of(CameraDescription& camera) {
  if (!camera.engine) camera.engine.emplace();
  return *camera.engine;
}

// One of several words.
template <class Enum>
Enum choice_in(const TomlValue& value, const std::vector<std::pair<const char*, Enum>>& choices) {
  const std::string word = word_in(value);
  std::string names;
  for (const auto& [name, meaning] : choices) {
    if (word == name) return meaning;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  input_error("{}: '{}' is none of {}", value.where, word, names);
}

std::array<double, 16> matrix_in(const TomlValue& value) {
  const auto* list = std::get_if<TomlList>(&value.data);
  if (list == nullptr || list->size() != 16)
    input_error("{}: expected a matrix of sixteen numbers", value.where);
  std::array<double, 16> numbers;
  for (std::size_t k = 0; k < 16; ++k) numbers[k] = number_in((*list)[k]);
  return numbers;
}

std::array<EngineAxis, 3> axes_in(const TomlValue& value) {
  try {
    return parse_world_axes(word_in(value));
  } catch (const std::invalid_argument& error) {
    input_error("{}: {}", value.where, error.what());
  }
}

using Description = CameraDescription;

struct Key {
  const char* name;
  void (*read)(CameraDescription&, const TomlValue&);
};

constexpr Key kKeys[] = {
    {"eye", [](CameraDescription& c, const TomlValue& v) { c.eye_m = vector_in(v); }},
    {"target", [](CameraDescription& c, const TomlValue& v) { c.target_m = vector_in(v); }},
    {"up", [](CameraDescription& c, const TomlValue& v) { c.up = vector_in(v); }},
    {"fov_y_deg", [](CameraDescription& c, const TomlValue& v) { c.fov_y_deg = number_in(v); }},
    {"width", [](CameraDescription& c,
                 const TomlValue& v) { c.width_px = whole_number_in(v, 1, kLargestSide_px); }},
    {"height", [](CameraDescription& c,
                  const TomlValue& v) { c.height_px = whole_number_in(v, 1, kLargestSide_px); }},
    {"near", [](CameraDescription& c, const TomlValue& v) { c.near_m = number_in(v); }},
    {"far", [](CameraDescription& c, const TomlValue& v) { c.far_m = number_in(v); }},
    {"tilt_deg", [](CameraDescription& c, const TomlValue& v) { c.tilt_deg = number_in(v); }},
    {"view", [](Description& c, const TomlValue& v) { engine_of(c).view = matrix_in(v); }},
    {"projection",
     [](Description& c, const TomlValue& v) { engine_of(c).projection = matrix_in(v); }},
    {"layout",
     [](Description& c, const TomlValue& v) {
       engine_of(c).layout = choice_in<MatrixLayout>(
           v, {{"column-major", MatrixLayout::ColumnMajor}, {"row-major", MatrixLayout::RowMajor}});
     }},
    {"vectors",
     [](Description& c, const TomlValue& v) {
       engine_of(c).vectors =
           choice_in<VectorKind>(v, {{"column", VectorKind::Column}, {"row", VectorKind::Row}});
     }},
    {"clip",
     [](Description& c, const TomlValue& v) {
       engine_of(c).clip = choice_in<ClipSpace>(v, {{"opengl", ClipSpace::OpenGl},
                                                    {"d3d", ClipSpace::Direct3d},
                                                    {"vulkan", ClipSpace::Vulkan}});
     }},
    {"reverse_z", [](Description& c, const TomlValue& v) { engine_of(c).reverse_z = truth_in(v); }},
    {"world_axes",
     [](Description& c, const TomlValue& v) { engine_of(c).world_axes = axes_in(v); }},
    {"metres_per_unit",
     [](Description& c, const TomlValue& v) { engine_of(c).metres_per_unit = number_in(v); }},
    {"origin",
     [](Description& c, const TomlValue& v) { engine_of(c).world_origin_m = vector_in(v); }},
    {"preset", [](CameraDescription& c, const TomlValue& v) { c.preset = word_in(v); }},
    {"frame", [](CameraDescription& c,
                 const TomlValue& v) { c.frame = whole_number_in(v, 1, kMostPathFrames); }},
    {"frames", [](CameraDescription& c,
                  const TomlValue& v) { c.frames = whole_number_in(v, 1, kMostPathFrames); }},
};

void require_whole(const CameraDescription& camera, const std::string& name) {
  const bool placed = camera.eye_m || camera.target_m || camera.up;
  if (camera.engine) {
    if (placed || !camera.preset.empty() || camera.fov_y_deg)
      input_error("{}: a camera has either an engine's matrices, or eye and target, or a preset",
                  name);
    constexpr std::array<double, 16> kNone{};
    if (camera.engine->view == kNone || camera.engine->projection == kNone)
      input_error("{}: an engine's camera needs both view and projection", name);
    if (!camera.width_px || !camera.height_px)
      input_error("{}: an engine's camera needs width and height, the size of its window", name);
    return;
  }
  if ((camera.frame || camera.frames) && !terrain::is_path_preset(camera.preset))
    input_error("{}: frame and frames belong to a preset that is a path", name);
  if (!camera.preset.empty() && placed)
    input_error("{}: a camera has either a preset or eye, target and up, not both", name);
  if (camera.preset.empty() && !(camera.eye_m && camera.target_m))
    input_error("{}: a camera needs eye and target, or a preset", name);
}

}  // namespace

CameraDescription camera_in(const TomlTable& table, const std::string& name) {
  CameraDescription camera;
  for (const auto& [key, value] : table) {
    const Key* known = nullptr;
    for (const Key& candidate : kKeys) {
      if (key == candidate.name) known = &candidate;
    }
    if (known == nullptr) {
      std::vector<std::string> names;
      for (const Key& candidate : kKeys) names.emplace_back(candidate.name);
      unknown_key(value, "a camera", names);
    }
    known->read(camera, value);
  }
  require_whole(camera, name);
  return camera;
}

CameraDescription parse_camera_toml(const std::string& text, const std::string& name) {
  return camera_in(parse_toml(text, name), name);
}

CameraDescription read_camera_file(const std::string& path) {
  return parse_camera_toml(read_text_file(path, "camera file"), path);
}

CameraDescription parse_inline_camera(const std::string& text) {
  const TomlTable root = parse_toml("camera = " + text, "--camera");
  if (root.size() != 1) input_error("--camera '{}': expected one table, {{ ... }}", text);
  return camera_in(table_in(root.front().value), "--camera");
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

LookAt turned_for_tilt(LookAt camera, double tilt_deg, const terrain::Heightfield& field) {
  if (!(tilt_deg >= -180.0 && tilt_deg <= 180.0))
    input_error("a terrain's tilt must lie between -180 and 180 degrees, got {}", tilt_deg);
  const Box box = bounds(field);
  const glm::dvec3 middle =
      field.world_origin_m() + (box.empty() ? glm::dvec3(0.0) : 0.5 * (box.low + box.high));
  const double c = reproducible_cos(radians(tilt_deg)), s = reproducible_sin(radians(tilt_deg));
  const auto turned = [&](const glm::dvec3& v) {
    return glm::dvec3(v.x, c * v.y + s * v.z, c * v.z - s * v.y);
  };
  camera.eye_m = middle + turned(camera.eye_m - middle);
  camera.target_m = middle + turned(camera.target_m - middle);
  camera.up = turned(camera.up);
  return camera;
}

namespace {

LookAt frame_of_path(const CameraDescription& description, const terrain::Heightfield& field,
                     const LookAt& picture) {
  const int frames = description.frames.value_or(terrain::kPathFrames);
  if (!description.frame)
    input_error("camera preset '{}': it is a path of {} cameras, say which with frame",
                description.preset, frames);
  if (*description.frame > frames)
    input_error("camera preset '{}': frame {} of {}", description.preset, *description.frame,
                frames);
  return terrain::path_preset_camera(field, description.preset, *description.frame, frames,
                                     picture.width_px, picture.height_px, picture.fov_y_deg);
}

}  // namespace

LookAt resolve_camera(const CameraDescription& description, const terrain::Heightfield& field) {
  LookAt camera;
  camera.width_px = description.width_px.value_or(camera.width_px);
  camera.height_px = description.height_px.value_or(camera.height_px);
  camera.fov_y_deg = description.fov_y_deg.value_or(camera.fov_y_deg);
  if (!(camera.fov_y_deg > 0.0 && camera.fov_y_deg < 180.0))
    input_error("a camera's field of view must lie between 0 and 180 degrees, got {}",
                camera.fov_y_deg);
  if (terrain::is_path_preset(description.preset)) {
    camera = frame_of_path(description, field, camera);
  } else if (!description.preset.empty()) {
    camera = terrain::preset_camera(field, description.preset, camera.width_px, camera.height_px,
                                    camera.fov_y_deg);
  } else {
    camera.eye_m = description.eye_m.value();
    camera.target_m = description.target_m.value();
    camera.up = description.up.value_or(camera.up);
  }
  if (description.tilt_deg) camera = turned_for_tilt(camera, *description.tilt_deg, field);
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

PlacedCamera place_camera(const CameraDescription& description, const terrain::Heightfield& field) {
  if (!description.engine) {
    const LookAt look_at = resolve_camera(description, field);
    return {make_camera(look_at), description_of(look_at)};
  }
  if (description.fov_y_deg)
    input_error("a field of view belongs to no engine's camera: its projection has one");
  if (description.tilt_deg)
    input_error("a tilt belongs to no engine's camera: its view matrix may have one");
  EngineCamera engine = *description.engine;
  engine.width_px = description.width_px.value_or(engine.width_px);
  engine.height_px = description.height_px.value_or(engine.height_px);
  try {
    PlacedCamera placed{camera_of(engine), description};
    placed.camera.near_m = description.near_m.value_or(placed.camera.near_m);
    placed.camera.far_m = description.far_m.value_or(placed.camera.far_m);
    require(placed.camera.near_m > 0.0 && placed.camera.near_m < placed.camera.far_m,
            "near and far must satisfy 0 < near < far, got {} and {}", placed.camera.near_m,
            placed.camera.far_m);
    return placed;
  } catch (const std::invalid_argument& error) {
    input_error("these matrices are no camera: {}", error.what());
  }
}

}  // namespace plumb::audit
