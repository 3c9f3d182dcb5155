#include "image/camera_metadata.h"

#include <cstdint>

namespace plumb::image {
namespace {

// Calls visit(name, double&) or visit(name, int&) for every number of a camera.
template <class AnyCamera, class Visit>
void for_each_number(AnyCamera& camera, const Visit& visit) {
  const auto vector = [&](const std::string& name, auto& v) {
    visit(name + ".x", v.x);
    visit(name + ".y", v.y);
    visit(name + ".z", v.z);
  };
  vector("camera.eye", camera.eye_m);
  vector("camera.right", camera.right);
  vector("camera.up", camera.up);
  vector("camera.forward", camera.forward);
  visit("camera.width", camera.width_px);
  visit("camera.height", camera.height_px);
  visit("camera.gamma_h", camera.gamma_h);
  visit("camera.gamma_v", camera.gamma_v);
  visit("camera.centre.x", camera.centre_px.x);
  visit("camera.centre.y", camera.centre_px.y);
  visit("camera.near", camera.near_m);
  visit("camera.far", camera.far_m);
}

template <class T>
bool get(const std::map<std::string, MetadataValue>& metadata, const std::string& name, T& value) {
  const auto found = metadata.find(name);
  if (found == metadata.end()) return false;
  const T* stored = std::get_if<T>(&found->second);
  if (stored == nullptr) return false;
  value = *stored;
  return true;
}

}  // namespace

void add_camera(const Camera& camera, std::map<std::string, MetadataValue>& metadata) {
  for_each_number(camera, [&](const std::string& name, const auto& value) {
    metadata[name] = MetadataValue(value);
  });
}

std::optional<Camera> camera_of(const std::map<std::string, MetadataValue>& metadata) {
  Camera camera;
  bool complete = true;
  for_each_number(camera, [&](const std::string& name, auto& value) {
    complete = get(metadata, name, value) && complete;
  });
  if (!complete) return std::nullopt;
  return camera;
}

}  // namespace plumb::image
