// What the numbers of a stranger's depth buffer mean.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/camera.h"
#include "image/depth_file.h"

namespace plumb::audit {

/// With near n, far f and view depth w (1/f = 0 where far is infinite).
enum class DepthConvention {
  Linear,    // w
  Distance,  // along the pixel's ray, from the eye
  Window,    // d in 0..1: 1/w = (1 - d)/n + d/f. What a GPU stores; OpenGL's window depth, whose
             // range of -1..1 is halved before it is stored, is the same number
  Ndc,       // OpenGL's normalised device depth, -1..1: 2 d - 1
  ReverseZ,  // 1 - d: 1 at the near plane, 0 at the far one
};

/// "linear", "distance", "window", "opengl-ndc", "reverse-z".
const char* name_of(DepthConvention convention);
/// These names, and "opengl", "d3d" and "vulkan" for window. Throws InputError that lists them.
DepthConvention parse_depth_convention(const std::string& text);
const std::vector<std::string>& depth_convention_names();

struct DepthMeaning {
  DepthConvention convention = DepthConvention::Linear;
  bool rows_from_bottom = false;    // the file's first row is the picture's lowest
  bool columns_from_right = false;  // its first column the picture's last: never right, but found
  double metres_per_unit = 1.0;     // of linear and distance; negative where depths are
  std::optional<double> sky = std::nullopt;  // a stored number that means: nothing was drawn here
};

/// The view depths that a stored number may stand for, as the buffer rounded it: low <= value <=
/// high; +inf is sky.
struct DepthRange {
  double low = 0.0, value = 0.0, high = 0.0;

  bool is_sky() const { return value == kSky; }
  static constexpr double kSky = std::numeric_limits<double>::infinity();
};

/// Nothing for a number that is none of the convention's: NaN, a depth that is not positive, window
/// depth out of its range. Sky is +inf of linear depth and distance, what the far end of window
/// depth is cleared to (1, of reverse-z 0), and `meaning.sky`.
///
/// ray_length  length of the pixel's ray of view depth one
///
///   (1) 1/w is linear in window depth, so a range of stored numbers is one of depths, without any
///       case for an infinite far plane. Half a step h of a window depth is a range of about
///       h w^2 (1/n - 1/f) metres either way.
std::optional<DepthRange> depth_range(float stored, const image::NumberFormat& format,
                                      const DepthMeaning& meaning, const Camera& camera,
                                      double ray_length);

/// Index into the buffer's numbers of what pixel (x, y) of the picture shows.
inline std::size_t stored_index(const image::DepthBuffer& buffer, const DepthMeaning& meaning,
                                int x, int y) {
  const int row = meaning.rows_from_bottom ? buffer.height_px - 1 - y : y;
  const int column = meaning.columns_from_right ? buffer.width_px - 1 - x : x;
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(buffer.width_px) +
         static_cast<std::size_t>(column);
}

/// The same for the pixel of that picture, by its own ray.
std::optional<DepthRange> depth_range_at(const image::DepthBuffer& buffer,
                                         const DepthMeaning& meaning, const Camera& camera, int x,
                                         int y);

}  // namespace plumb::audit
