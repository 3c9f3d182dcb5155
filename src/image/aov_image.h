// A picture with everything that is known of each pixel, and the header to make it again.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/camera.h"
#include "core/drawn_surface.h"
#include "core/hit_image.h"
#include "image/colour_image.h"

namespace plumb::image {

using MetadataValue = std::variant<std::string, double, std::int32_t>;

/// Float channels, each one entry a pixel from the top left, or empty where it is not known.
struct AovImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> r, g, b;     // linear
  std::vector<float> z;           // view depth, metres; +inf where nothing is seen
  std::vector<float> px, py, pz;  // the point seen relative to the eye, metres; zero there
  std::vector<float> nx, ny, nz;  // unit normal; zero there
  std::vector<float> id;          // patch or node; -1 there
  std::vector<float> lod;         // 0 is the finest; -1 there
  std::vector<float> overdraw;    // fragments that fell on the pixel
  std::map<std::string, MetadataValue> metadata;  // names without their "plumb:"

  std::size_t size() const { return static_cast<std::size_t>(width_px) * height_px; }
};

struct Channel {
  const char* name;  // in files
  std::vector<float> AovImage::*values;
};

/// Every channel, in the order of checksums and files: R G B Z P.X P.Y P.Z N.X N.Y N.Z id lod
/// overdraw.
const std::array<Channel, 13>& channels();

/// Throws std::invalid_argument unless the size is at least 1 x 1 and each channel full or empty.
void require_valid(const AovImage& image);

/// Checksum of the size and of the raw bits of every channel that is there, before any file format;
/// the metadata is no part of it.
std::uint64_t raw_checksum(const AovImage& image);

/// What is known of each pixel besides its hit; anything may be left empty.
struct PixelAttributes {
  std::span<const glm::dvec3> normals = {};
  std::span<const int> ids = {};  // 0 to 2^24, which a float holds exactly; ignored without a hit
  std::span<const int> lods = {};
  const ColourImage* colours = nullptr;
};

/// The channels of a picture, with the camera in its metadata.
/// Throws std::invalid_argument if shapes differ or an id is not exact in a float.
AovImage make_aov(const HitImage& hits, const Camera& camera,
                  const PixelAttributes& attributes = {});

/// Patch and level of each pixel's triangle; -1 where nothing is seen.
struct PatchPlanes {
  std::vector<int> ids;
  std::vector<int> lods;
};
PatchPlanes patch_planes(const HitImage& hits, const DrawnSurface& surface);

}  // namespace plumb::image
