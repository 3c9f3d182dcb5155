#include "image/plane_image.h"

#include <algorithm>
#include <span>

#include "core/check.h"
#include "core/hash.h"

namespace plumb::image {
namespace {

// Where channels() has the name; behind them all for a name of another's.
std::size_t place_of(const std::string& name) {
  std::size_t place = 0;
  while (place < channels().size() && name != channels()[place].name) ++place;
  return place;
}

std::vector<const Plane*> in_order(const std::vector<Plane>& planes) {
  std::vector<const Plane*> order;
  for (const Plane& plane : planes) order.push_back(&plane);
  std::stable_sort(order.begin(), order.end(), [](const Plane* a, const Plane* b) {
    const std::size_t place_a = place_of(a->name), place_b = place_of(b->name);
    return place_a != place_b ? place_a < place_b : a->name < b->name;
  });
  return order;
}

}  // namespace

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

std::uint64_t raw_checksum(const PlaneImage& picture) {
  Checksum sum;
  sum.add(std::int64_t{picture.width_px}).add(std::int64_t{picture.height_px});
  for (const Plane* plane : in_order(picture.planes))
    sum.add(std::string_view(plane->name)).add(std::span<const float>(plane->values));
  if (picture.encoding == Encoding::Srgb) sum.add(std::string_view(name_of(picture.encoding)));
  return sum.value();
}

}  // namespace plumb::image
