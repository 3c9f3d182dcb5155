// A camera in an image's header, so that the image can be made again from it.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/camera.h"
#include "image/aov_image.h"

namespace plumb::image {

/// Adds the camera as doubles under "camera.eye.x" and the like.
void add_camera(const Camera& camera, std::map<std::string, MetadataValue>& metadata);

/// The camera that `add_camera` put there, bit for bit; nothing if any part of it is missing.
std::optional<Camera> camera_of(const std::map<std::string, MetadataValue>& metadata);

}  // namespace plumb::image
