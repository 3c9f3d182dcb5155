// A case as a line for a shell.
#include <fmt/format.h>

#include <string_view>

#include "audit/soundness/case.h"

namespace plumb::audit::soundness {
namespace {

// Six or seven numbers say a camera that only stands and looks.
bool is_plain(const CameraDescription& camera) {
  return camera.preset.empty() && !camera.engine && !camera.up && !camera.near_m && !camera.far_m;
}

std::string camera_text(const CameraDescription& camera) {
  const bool is_preset = !camera.preset.empty() && !camera.near_m && !camera.far_m;
  if (is_preset) return camera.preset;
  if (!is_plain(camera) || !camera.eye_m || !camera.target_m) return inline_toml(camera);
  const glm::dvec3 e = *camera.eye_m, t = *camera.target_m;
  return fmt::format("{},{},{},{},{},{}", e.x, e.y, e.z, t.x, t.y, t.z);
}

}  // namespace

std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

std::string audit_command(const Scene& scene) {
  std::string line = "plumb audit " + shell_word(scene.terrain);
  const auto add = [&](const std::string& option, const std::string& value) {
    line += " " + option + " " + shell_word(value);
  };
  if (scene.read.window) {
    const terrain::Window& w = *scene.read.window;
    add("--window", fmt::format("{},{},{},{}", w.x, w.y, w.width, w.height));
  }
  if (scene.read.no_data_policy == terrain::NoDataPolicy::Fill) add("--no-data", "fill");
  const CameraDescription& camera = scene.camera;
  const std::string view = camera_text(camera);
  add("--camera", view);
  if (!view.starts_with('{')) {
    if (camera.width_px && camera.height_px)
      add("--size", fmt::format("{}x{}", *camera.width_px, *camera.height_px));
    if (camera.fov_y_deg) add("--fov", fmt::format("{}", *camera.fov_y_deg));
    if (camera.tilt_deg) add("--tilt", fmt::format("{}", *camera.tilt_deg));
  }
  add("--method", scene.method);
  if (!scene.choice.variant.empty()) add("--variant", scene.choice.variant);
  add("--tolerance", to_text(scene.tolerance));
  for (const auto& [name, value] : scene.choice.parameters) add("--set", name + "=" + value);
  return line;
}

}  // namespace plumb::audit::soundness
