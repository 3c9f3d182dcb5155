// Draws the triangles of one tile: coverage, depth and the fragment stage.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "core/hit_image.h"
#include "raster/binning.h"
#include "raster/fixed_point.h"

namespace plumb::raster {

/// A pixel that a triangle covers, before the depth test.
struct Fragment {
  int x = 0, y = 0;             // the pixel
  std::uint32_t primitive = 0;  // the triangle
  double depth_m = 0.0;
  glm::dvec3 from_eye_m{0.0};  // the triangle's point there
};

/// The fragment stage that keeps everything.
struct KeepAll {
  constexpr bool operator()(const Fragment&) const { return true; }
};

/// Which triangles are drawn, by the way that their corners run on the screen.
enum class Facing { Both, CounterClockwise, Clockwise };

/// Draws whole triangles and pieces into one tile of an image that nobody else writes to.
///
/// At a pixel centre, edge function i over the doubled area is the screen barycentric coordinate
/// l_i; with depths w_i, one over the depth is the sum of l_i / w_i, and the perspective-correct
/// coordinate is b_i = (l_i / w_i) * depth. The point is the sum of b_i times the triangle's own
/// corners. Each step is one rounding of doubles from exact integers.
template <class Keep>
class TileKernel {
 public:
  TileKernel(const Geometry& geometry, Facing facing, const Keep& keep, HitImage& image)
      : geometry_(geometry), facing_(facing), keep_(keep), image_(image) {}

  /// Draws the entries in their order; returns how many fragments were kept.
  std::int64_t draw(const Bins& bins, std::span<const BinEntry> entries,
                    const PixelBox& tile) const {
    std::int64_t fragments = 0;
    for (const BinEntry& entry : entries) {
      Primitive primitive;
      primitive.triangle = entry.triangle;
      primitive.corners = geometry_.mesh->triangles[entry.triangle].data();
      if (entry.piece < 0) {
        fragments += draw(
            {geometry_.vertices[primitive.corners[0]], geometry_.vertices[primitive.corners[1]],
             geometry_.vertices[primitive.corners[2]]},
            primitive, tile);
      } else {
        const ClippedPiece& piece = bins.pieces[static_cast<std::size_t>(entry.piece)];
        primitive.weights = piece.weights.data();
        fragments += draw(piece.corners, primitive, tile);
      }
    }
    return fragments;
  }

 private:
  struct Primitive {
    EdgeFunctions edges;
    glm::dvec3 scale{0.0};  // 1 / (doubled area * depth of corner i)
    std::uint32_t triangle = 0;
    const std::uint32_t* corners = nullptr;  // of the mesh
    const glm::dvec3* weights = nullptr;     // of a piece's corners; null for a whole triangle
  };

  bool faces_rightly(const std::array<ScreenVertex, 3>& corners) const {
    if (facing_ == Facing::Both) return true;
    return (doubled_area(corners[0], corners[1], corners[2]) > 0) == (facing_ == Facing::Clockwise);
  }

  std::int64_t draw(const std::array<ScreenVertex, 3>& corners, Primitive& primitive,
                    const PixelBox& tile) const {
    const PixelBox box = common_part(pixel_box(corners[0], corners[1], corners[2]), tile);
    if (box.empty() || !faces_rightly(corners)) return 0;
    const EdgeFunctions& edges = primitive.edges = edge_functions(corners);
    if (edges.doubled_area == 0) return 0;
    const auto area = static_cast<double>(edges.doubled_area);
    for (int i = 0; i < 3; ++i) {
      primitive.scale[i] = corners[static_cast<std::size_t>(i)].inverse_depth / area;
    }
    std::int64_t fragments = 0;
    for (int y = box.y0; y <= box.y1; ++y) fragments += draw_row(primitive, box.x0, box.x1, y);
    return fragments;
  }

  // The covered pixels of a row are one run: the triangle is convex.
  std::int64_t draw_row(const Primitive& primitive, int x0, int x1, int y) const {
    const EdgeFunctions& edges = primitive.edges;
    std::int64_t e0 = edges.biased(0, x0, y);
    std::int64_t e1 = edges.biased(1, x0, y);
    std::int64_t e2 = edges.biased(2, x0, y);
    std::int64_t fragments = 0;
    bool inside = false;
    for (int x = x0; x <= x1; ++x) {
      if ((e0 | e1 | e2) >= 0) {
        inside = true;
        fragments += shade(primitive,
                           {static_cast<double>(e0 + edges.bias[0]) * primitive.scale[0],
                            static_cast<double>(e1 + edges.bias[1]) * primitive.scale[1],
                            static_cast<double>(e2 + edges.bias[2]) * primitive.scale[2]},
                           x, y);
      } else if (inside) {
        break;
      }
      e0 += edges.step_x[0];
      e1 += edges.step_x[1];
      e2 += edges.step_x[2];
    }
    return fragments;
  }

  // `share` is l_i / w_i. Returns 1 if the fragment is kept, whether or not it is the nearest.
  int shade(const Primitive& primitive, const glm::dvec3& share, int x, int y) const {
    double depth_m = 1.0 / (share.x + share.y + share.z);
    if (depth_m > geometry_.projection.camera.far_m) return 0;
    const std::size_t pixel = image_.index(x, y);
    glm::dvec3 point_m;
    if constexpr (!std::is_same_v<Keep, KeepAll>) {
      Fragment fragment{x, y, primitive.triangle, depth_m, point_at(primitive, share * depth_m)};
      if (!keep_(fragment)) return 0;
      depth_m = fragment.depth_m;
      point_m = fragment.from_eye_m;
    }
    std::uint16_t& overdraw = image_.overdraw[pixel];
    if (overdraw < std::numeric_limits<std::uint16_t>::max()) ++overdraw;
    if (depth_m < image_.depth_m[pixel]) {  // not <=: of equal depths the first triangle wins
      if constexpr (std::is_same_v<Keep, KeepAll>) point_m = point_at(primitive, share * depth_m);
      image_.depth_m[pixel] = depth_m;
      image_.from_eye_m[pixel] = point_m;
      image_.primitive[pixel] = primitive.triangle;
    }
    return 1;
  }

  glm::dvec3 point_at(const Primitive& primitive, glm::dvec3 weight) const {
    if (primitive.weights != nullptr) {
      weight = weight.x * primitive.weights[0] + weight.y * primitive.weights[1] +
               weight.z * primitive.weights[2];
    }
    const auto corner = [&](int i) {
      return geometry_.projection.from_eye(geometry_.mesh->vertices_m[primitive.corners[i]]);
    };
    return weight.x * corner(0) + weight.y * corner(1) + weight.z * corner(2);
  }

  const Geometry& geometry_;
  Facing facing_;
  const Keep& keep_;
  HitImage& image_;
};

}  // namespace plumb::raster
