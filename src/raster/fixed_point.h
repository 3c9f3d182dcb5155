// Window coordinates with 8 subpixel bits, and the exact edge functions of a triangle.
//
// Why 64 bits suffice. Snapped coordinates lie in [-2^29, 2^29] subpixels (2^21 pixels; vertices
// are clipped to a guard band of 2^20 pixels long before). Pixel centres lie in [0, 2^24]. So a
// difference of two coordinates is at most 2^30 in size, a product of two differences at most 2^60,
// and an edge function, the difference of two such products, at most 2^61. The three edge functions
// at a point inside add up to twice the area, at most 2^61 as well. Nothing is ever rounded.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace plumb::raster {

/// Which pixels a triangle covers whose edge runs exactly through their centres.
enum class FillRule {
  TopLeft,  // those on a left edge, or on a horizontal edge above the interior: as Direct3D
            // specifies, and OpenGL drivers do with the window's y downwards
};

/// How a window coordinate becomes a multiple of 1/256 pixel.
enum class Snap {
  NearestHalfUp,  // floor(256 * x + 0.5), in double
};

inline constexpr FillRule kFillRule = FillRule::TopLeft;
inline constexpr Snap kSnap = Snap::NearestHalfUp;
inline constexpr int kSubpixelBits = 8;
inline constexpr std::int32_t kSubpixels = 1 << kSubpixelBits;
inline constexpr double kGuardBand_px = 1048576.0;  // 2^20, on either side of pixel 0
inline constexpr std::int32_t kLargestCoordinate = 1 << 29;

/// A window coordinate in subpixels; finite.
inline std::int32_t snap(double window_px) {
  const double scaled = window_px * kSubpixels + 0.5;
  const double bounded =
      std::clamp(scaled, double{-kLargestCoordinate}, double{kLargestCoordinate});
  const auto whole =
      static_cast<std::int32_t>(bounded);  // towards zero; floor is one less if below
  return whole - (bounded < whole ? 1 : 0);
}

/// A corner in the window: subpixels, y downwards, and one over its view depth.
struct ScreenVertex {
  std::int32_t x, y;
  double inverse_depth;  // 1/m
};

/// Pixels [x0, x1] x [y0, y1]; empty if x0 > x1 or y0 > y1.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
  bool empty() const { return x0 > x1 || y0 > y1; }
  bool holds_one_pixel() const { return x0 == x1 && y0 == y1; }
};

inline PixelBox common_part(const PixelBox& a, const PixelBox& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// The pixels whose centres lie in the closed box around three corners.
inline PixelBox pixel_box(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
  constexpr std::int32_t kHalf = kSubpixels / 2;
  const auto first = [](std::int32_t low) { return (low + kHalf - 1) >> kSubpixelBits; };
  const auto last = [](std::int32_t high) { return (high - kHalf) >> kSubpixelBits; };
  return {first(std::min({a.x, b.x, c.x})), first(std::min({a.y, b.y, c.y})),
          last(std::max({a.x, b.x, c.x})), last(std::max({a.y, b.y, c.y}))};
}

/// Twice the signed area in square subpixels; positive if the corners run clockwise on the screen.
inline std::int64_t doubled_area(const ScreenVertex& a, const ScreenVertex& b,
                                 const ScreenVertex& c) {
  return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
         (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
}

/// The three edge functions of a triangle, positive inside whichever way its corners run.
///
/// Function i belongs to the edge opposite corner i; over the doubled area it is the corner's
/// barycentric coordinate on the screen. A pixel is covered if every value less its `bias` is >= 0,
/// where the bias is 0 for a top or left edge and 1 for the others: the fill rule in integers.
struct EdgeFunctions {
  std::array<std::int64_t, 3> at_first;  // at the centre of pixel (0, 0), bias not yet taken off
  std::array<std::int64_t, 3> step_x;    // from one pixel to its right neighbour
  std::array<std::int64_t, 3> step_y;    // and to the one below
  std::array<std::int64_t, 3> bias;
  std::int64_t doubled_area;  // >= 0

  /// Function i less its bias, at the centre of pixel (x, y).
  std::int64_t biased(int i, int x, int y) const {
    return at_first[i] + x * step_x[i] + y * step_y[i] - bias[i];
  }
};

inline EdgeFunctions edge_functions(const std::array<ScreenVertex, 3>& corners) {
  EdgeFunctions edges;
  const std::int64_t area = doubled_area(corners[0], corners[1], corners[2]);
  const std::int64_t sign = area < 0 ? -1 : 1;
  edges.doubled_area = sign * area;
  for (int i = 0; i < 3; ++i) {
    const ScreenVertex& from = corners[(i + 1) % 3];
    const ScreenVertex& to = corners[(i + 2) % 3];
    const std::int64_t dx = sign * (std::int64_t{to.x} - from.x);
    const std::int64_t dy = sign * (std::int64_t{to.y} - from.y);
    edges.at_first[i] = dx * (kSubpixels / 2 - from.y) - dy * (kSubpixels / 2 - from.x);
    edges.step_x[i] = -dy * kSubpixels;
    edges.step_y[i] = dx * kSubpixels;
    edges.bias[i] = dy < 0 || (dy == 0 && dx > 0) ? 0 : 1;
  }
  return edges;
}

/// False only if the triangle covers no pixel of the box.
inline bool may_cover(const EdgeFunctions& edges, const PixelBox& box) {
  for (int i = 0; i < 3; ++i) {
    const int x = edges.step_x[i] > 0 ? box.x1 : box.x0;
    const int y = edges.step_y[i] > 0 ? box.y1 : box.y0;
    if (edges.biased(i, x, y) < 0) return false;
  }
  return true;
}

}  // namespace plumb::raster
