#include "image/aov_image.h"

#include "core/check.h"
#include "core/hash.h"
#include "image/camera_metadata.h"

namespace plumb::image {
namespace {

constexpr int kLargestExactId = 1 << 24;

void require_shape(std::size_t size, std::size_t wanted, const char* what) {
  require(size == 0 || size == wanted, "{} must have one entry a pixel, {}, got {}", what, wanted,
          size);
}

void add_hits(const HitImage& hits, AovImage& image) {
  const std::size_t size = image.size();
  image.z.resize(size);
  image.px.resize(size);
  image.py.resize(size);
  image.pz.resize(size);
  for (std::size_t k = 0; k < size; ++k) {
    image.z[k] = static_cast<float>(hits.depth_m[k]);
    image.px[k] = static_cast<float>(hits.from_eye_m[k].x);
    image.py[k] = static_cast<float>(hits.from_eye_m[k].y);
    image.pz[k] = static_cast<float>(hits.from_eye_m[k].z);
  }
  image.overdraw.assign(hits.overdraw.begin(), hits.overdraw.end());
}

void add_normals(const HitImage& hits, std::span<const glm::dvec3> normals, AovImage& image) {
  if (normals.empty()) return;
  image.nx.assign(image.size(), 0.0f);
  image.ny = image.nz = image.nx;
  for (std::size_t k = 0; k < image.size(); ++k) {
    if (!hits.hit(k)) continue;
    image.nx[k] = static_cast<float>(normals[k].x);
    image.ny[k] = static_cast<float>(normals[k].y);
    image.nz[k] = static_cast<float>(normals[k].z);
  }
}

std::vector<float> numbers(const HitImage& hits, std::span<const int> values) {
  std::vector<float> result(values.size(), -1.0f);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!hits.hit(k)) continue;
    require(values[k] >= 0 && values[k] <= kLargestExactId,
            "an id or lod must lie in 0..2^24, got {}", values[k]);
    result[k] = static_cast<float>(values[k]);
  }
  return result;
}

}  // namespace

const std::array<Channel, 13>& channels() {
  static const std::array<Channel, 13> list{{{"R", &AovImage::r},
                                             {"G", &AovImage::g},
                                             {"B", &AovImage::b},
                                             {"Z", &AovImage::z},
                                             {"P.X", &AovImage::px},
                                             {"P.Y", &AovImage::py},
                                             {"P.Z", &AovImage::pz},
                                             {"N.X", &AovImage::nx},
                                             {"N.Y", &AovImage::ny},
                                             {"N.Z", &AovImage::nz},
                                             {"id", &AovImage::id},
                                             {"lod", &AovImage::lod},
                                             {"overdraw", &AovImage::overdraw}}};
  return list;
}

void require_valid(const AovImage& image) {
  require(image.width_px >= 1 && image.height_px >= 1,
          "an image must be at least 1 x 1 pixels, got {} x {}", image.width_px, image.height_px);
  for (const Channel& channel : channels()) {
    require_shape((image.*channel.values).size(), image.size(), channel.name);
  }
}

std::uint64_t raw_checksum(const AovImage& image) {
  Checksum sum;
  sum.add(std::int64_t{image.width_px}).add(std::int64_t{image.height_px});
  for (const Channel& channel : channels()) {
    const std::vector<float>& values = image.*channel.values;
    if (values.empty()) continue;
    sum.add(std::string_view(channel.name)).add(std::span<const float>(values));
  }
  return sum.value();
}

AovImage make_aov(const HitImage& hits, const Camera& camera, const PixelAttributes& attributes) {
  require(hits.width_px == camera.width_px && hits.height_px == camera.height_px,
          "a picture of {} x {} pixels is not of the camera's {} x {}", hits.width_px,
          hits.height_px, camera.width_px, camera.height_px);
  AovImage image;
  image.width_px = hits.width_px;
  image.height_px = hits.height_px;
  const std::size_t size = image.size();
  require(hits.depth_m.size() == size && hits.from_eye_m.size() == size,
          "depths and points must have one entry a pixel, {}, got {} and {}", size,
          hits.depth_m.size(), hits.from_eye_m.size());
  require_shape(hits.overdraw.size(), size, "overdraw");
  require_shape(attributes.normals.size(), size, "normals");
  require_shape(attributes.ids.size(), size, "ids");
  require_shape(attributes.lods.size(), size, "lods");
  add_hits(hits, image);
  add_normals(hits, attributes.normals, image);
  image.id = numbers(hits, attributes.ids);
  image.lod = numbers(hits, attributes.lods);
  if (attributes.colours != nullptr) {
    require_shape(attributes.colours->r.size(), size, "colours");
    image.r = attributes.colours->r;
    image.g = attributes.colours->g;
    image.b = attributes.colours->b;
  }
  add_camera(camera, image.metadata);
  require_valid(image);
  return image;
}

PatchPlanes patch_planes(const HitImage& hits, const DrawnSurface& surface) {
  PatchPlanes planes{std::vector<int>(hits.size(), -1), std::vector<int>(hits.size(), -1)};
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (!hits.hit(k)) continue;
    const int patch = patch_of(surface, hits.primitive[k]);
    planes.ids[k] = patch;
    planes.lods[k] =
        surface.patches.empty() ? 0 : surface.patches[static_cast<std::size_t>(patch)].lod;
  }
  return planes;
}

}  // namespace plumb::image
