// Harm done to a picture on purpose, to learn what a comparison sees of it.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "image/colour_image.h"
#include "image/plane_image.h"

namespace plumb::compare {

/// Numbers for places, the same on every machine.
class Places {
 public:
  explicit Places(std::uint64_t seed) : engine_(seed) {}
  /// In [0, 1).
  double share() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  /// In [0, count), count >= 1.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(share() * static_cast<double>(count));
  }

 private:
  std::mt19937_64 engine_;
};

/// What shows through a hole: the colour of the first sky pixel (by depth or alpha; the top left
/// pixel where there is none), infinite depth, no point, no normal, no patch.
class Background {
 public:
  explicit Background(const image::PlaneImage& picture);
  void show(image::PlaneImage& picture, std::size_t pixel) const;

 private:
  std::vector<float> values_;  // a channel each
};

/// Pixels where a hole would be one: terrain, by depth or alpha, all where there is neither.
std::vector<std::size_t> terrain_pixels(const image::PlaneImage& picture);

/// A straight gap through the terrain, `length_px` long and `width_px` wide, at a place and an
/// angle of its own; where it leaves the terrain it stops.
image::PlaneImage with_crack(const image::PlaneImage& picture, int width_px, int length_px,
                             Places& places);
/// Single pixels, at places of their own.
image::PlaneImage with_pinholes(const image::PlaneImage& picture, int count, Places& places);
/// A square of background.
image::PlaneImage with_missing_tile(const image::PlaneImage& picture, int side_px, Places& places);
/// One step of 8 bits more, less or none on every colour channel and pixel, as displays encode it.
image::PlaneImage with_least_bit_noise(const image::PlaneImage& picture, Places& places);
/// The same picture moved by (x, y) pixels, straight lines between pixels, its rim repeated.
image::PlaneImage moved(const image::PlaneImage& picture, double x_px, double y_px);
/// Colours encoded for a display once more than they should be.
image::PlaneImage encoded_twice(const image::PlaneImage& picture);
/// Red, green and blue alone, as a PNG would have them: sRGB of 8 bits.
image::PlaneImage colours_alone(const image::PlaneImage& picture);
/// The bytes of that; grey is all three. Throws std::invalid_argument without colour.
image::Rgb8Image bytes_of(const image::PlaneImage& picture);

}  // namespace plumb::compare
