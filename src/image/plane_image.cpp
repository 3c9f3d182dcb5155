#include "image/plane_image.h"

#include "core/check.h"

namespace plumb::image {

const char* name_of(Encoding encoding) { return encoding == Encoding::Srgb ? "sRGB" : "linear"; }

const Plane* PlaneImage::find(std::string_view name) const {
  for (const Plane& plane : planes) {
    if (plane.name == name) return &plane;
  }
  return nullptr;
}

PlaneImage planes_of(const AovImage& picture) {
  require_valid(picture);
  PlaneImage image;
  image.width_px = picture.width_px;
  image.height_px = picture.height_px;
  image.metadata = picture.metadata;
  for (const Channel& channel : channels()) {
    const std::vector<float>& values = picture.*channel.values;
    if (!values.empty()) image.planes.push_back({channel.name, values});
  }
  return image;
}

}  // namespace plumb::image
