#include "compare/planted_defects.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/coverage_check.h"
#include "compare/picture_pair.h"
#include "compare/value_models.h"
#include "core/check.h"
#include "core/parallel.h"
#include "core/reproducible_math.h"
#include "image/srgb.h"

namespace plumb::compare {
namespace {

using image::Plane;
using image::PlaneImage;

bool is_colour(const std::string& channel) {
  return channel == "R" || channel == "G" || channel == "B" || channel == "Y";
}

template <class Change>
void change_colours(PlaneImage& picture, const Change& change) {
  for (Plane& plane : picture.planes) {
    if (!is_colour(plane.name)) continue;
    for (float& value : plane.values) value = change(value);
  }
}

}  // namespace

Background::Background(const PlaneImage& picture) {
  std::size_t sky = 0;
  if (const auto shown = shown_terrain(picture)) {
    const auto found = std::find(shown->begin(), shown->end(), std::uint8_t{0});
    if (found != shown->end()) sky = static_cast<std::size_t>(found - shown->begin());
  }
  for (const Plane& plane : picture.planes) {
    float value = 0.0f;
    if (is_colour(plane.name)) value = plane.values[sky];
    if (plane.name == "Z") value = std::numeric_limits<float>::infinity();
    if (plane.name == "id" || plane.name == "lod") value = -1.0f;
    values_.push_back(value);
  }
}

void Background::show(PlaneImage& picture, std::size_t pixel) const {
  for (std::size_t c = 0; c < values_.size(); ++c) picture.planes[c].values[pixel] = values_[c];
}

std::vector<std::size_t> terrain_pixels(const PlaneImage& picture) {
  const auto shown = shown_terrain(picture);
  std::vector<std::size_t> pixels;
  for (std::size_t k = 0; k < picture.size(); ++k) {
    if (!shown || (*shown)[k] != 0) pixels.push_back(k);
  }
  return pixels;
}

namespace {

// Makes holes at pixels of the terrain that lie in the picture.
class Holes {
 public:
  explicit Holes(const PlaneImage& picture)
      : picture_(picture), background_(picture), terrain_(picture.size(), 0) {
    for (const std::size_t k : terrain_pixels(picture)) terrain_[k] = 1;
  }
  void make(int x, int y) {
    if (x < 0 || y < 0 || x >= picture_.width_px || y >= picture_.height_px) return;
    const std::size_t k =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width_px) +
        static_cast<std::size_t>(x);
    if (terrain_[k] != 0) background_.show(picture_, k);
  }
  PlaneImage take() { return std::move(picture_); }

 private:
  PlaneImage picture_;
  Background background_;
  std::vector<std::uint8_t> terrain_;
};

struct Pixel {
  int x, y;
};

Pixel somewhere(const PlaneImage& picture, const std::vector<std::size_t>& among, Places& places) {
  const std::size_t k = among[places.below(among.size())];
  const auto width = static_cast<std::size_t>(picture.width_px);
  return {static_cast<int>(k % width), static_cast<int>(k / width)};
}

}  // namespace

PlaneImage with_crack(const PlaneImage& picture, int width_px, int length_px, Places& places) {
  const std::vector<std::size_t> terrain = terrain_pixels(picture);
  if (terrain.empty()) return picture;
  const Pixel middle = somewhere(picture, terrain, places);
  const double angle = 6.283185307179586 * places.share();
  const double along_x = reproducible_cos(angle), along_y = reproducible_sin(angle);
  Holes holes(picture);
  const bool flat = std::abs(along_x) > std::abs(along_y);
  for (int k = -length_px / 2; k < length_px - length_px / 2; ++k) {
    const int aside =
        static_cast<int>(std::lround(k * (flat ? along_y / along_x : along_x / along_y)));
    for (int w = 0; w < width_px; ++w) {
      if (flat) {
        holes.make(middle.x + k, middle.y + aside + w);
      } else {
        holes.make(middle.x + aside + w, middle.y + k);
      }
    }
  }
  return holes.take();
}

PlaneImage with_pinholes(const PlaneImage& picture, int count, Places& places) {
  const std::vector<std::size_t> terrain = terrain_pixels(picture);
  if (terrain.empty()) return picture;
  Holes holes(picture);
  for (int k = 0; k < count; ++k) {
    const Pixel at = somewhere(picture, terrain, places);
    holes.make(at.x, at.y);
  }
  return holes.take();
}

PlaneImage with_missing_tile(const PlaneImage& picture, int side_px, Places& places) {
  const std::vector<std::size_t> terrain = terrain_pixels(picture);
  if (terrain.empty()) return picture;
  const Pixel middle = somewhere(picture, terrain, places);
  Holes holes(picture);
  for (int y = 0; y < side_px; ++y) {
    for (int x = 0; x < side_px; ++x)
      holes.make(middle.x - side_px / 2 + x, middle.y - side_px / 2 + y);
  }
  return holes.take();
}

PlaneImage with_least_bit_noise(const PlaneImage& picture, Places& places) {
  PlaneImage noisy = picture;
  const bool linear = picture.encoding == image::Encoding::Linear;
  change_colours(noisy, [&](float value) {
    if (!std::isfinite(value)) return value;
    const double shown = linear ? linear_to_srgb(std::max(0.0, double{value})) : double{value};
    const double step = (static_cast<double>(places.below(3)) - 1.0) / 255.0;
    const double changed = std::max(0.0, shown + step);
    if (!linear) return static_cast<float>(std::min(1.0, changed));
    return static_cast<float>(changed <= 1.0 ? image::srgb_to_linear(changed) : double{value});
  });
  return noisy;
}

PlaneImage moved(const PlaneImage& picture, double x_px, double y_px) {
  PlaneImage result = picture;
  const int width = picture.width_px, height = picture.height_px;
  for (std::size_t c = 0; c < picture.planes.size(); ++c) {
    const std::vector<float>& from = picture.planes[c].values;
    const auto at = [&](int x, int y) {
      const auto column = static_cast<std::size_t>(std::clamp(x, 0, width - 1));
      return double{from[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) *
                             static_cast<std::size_t>(width) +
                         column]};
    };
    parallel_for(height, 16, [&](std::int64_t row) {
      for (int x = 0; x < width; ++x) {
        const double u = x - x_px, v = static_cast<double>(row) - y_px;
        const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
        const double s = u - i, t = v - j;
        double value = at(i, j);
        if (s != 0.0 || t != 0.0)
          value = (1.0 - t) * ((1.0 - s) * at(i, j) + s * at(i + 1, j)) +
                  t * ((1.0 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
        if (std::isnan(value)) value = at(i, j);  // sky beside ground: one or the other
        result.planes[c].values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x)] = static_cast<float>(value);
      }
    });
  }
  return result;
}

PlaneImage encoded_twice(const PlaneImage& picture) {
  PlaneImage result = picture;
  change_colours(result, [](float value) {
    return value > 0.0f ? static_cast<float>(linear_to_srgb(double{value})) : value;
  });
  return result;
}

PlaneImage colours_alone(const PlaneImage& picture) {
  const std::vector<const Plane*> from = colour_planes(picture);
  require(!from.empty(), "a picture must have colour");
  PlaneImage result;
  result.width_px = picture.width_px;
  result.height_px = picture.height_px;
  result.encoding = image::Encoding::Srgb;
  result.bits = 8;
  constexpr const char* kNames[3] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    Plane bytes{kNames[c], from[c]->values};
    for (float& value : bytes.values) {
      if (picture.encoding == image::Encoding::Linear) {
        value = static_cast<float>(image::linear_to_srgb8(value)) / 255.0f;
      } else {
        value = static_cast<float>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))) / 255.0f;
      }
    }
    result.planes.push_back(std::move(bytes));
  }
  return result;
}

image::Rgb8Image bytes_of(const PlaneImage& picture) {
  const PlaneImage shown = colours_alone(picture);
  image::Rgb8Image bytes{shown.width_px, shown.height_px, {}};
  bytes.rgb.resize(3 * shown.size());
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < shown.size(); ++k)
      bytes.rgb[3 * k + c] = static_cast<std::uint8_t>(shown.planes[c].values[k] * 255.0f + 0.5f);
  }
  return bytes;
}

}  // namespace plumb::compare
