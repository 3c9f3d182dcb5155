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
#include "raster/perspective.h"
#include "raster/points.h"

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

/// Draws what was sorted into one tile of an image that nobody else writes to.
///
/// Without a fragment stage, pixels that show whole triangles have their depth and primitive
/// alone: `fill_points` is for later, when it is known what each of them shows.
template <class Keep>
class TileKernel {
  static constexpr bool kKeepsAll = std::is_same_v<Keep, KeepAll>;

 public:
  TileKernel(const Geometry& geometry, const Keep& keep, HitImage& image)
      : geometry_(geometry), keep_(keep), image_(image) {}

  /// Draws the entries in their order; returns how many fragments were kept.
  std::int64_t draw(const Bins& bins, std::span<const BinEntry> entries,
                    const PixelBox& tile) const {
    std::int64_t fragments = 0;
    for (const BinEntry& entry : entries) {
      if (entry.is_fragment()) {
        if (is_nearest(entry.place, entry.depth_m))
          show(entry.place, entry.depth_m, entry.triangle);
        ++fragments;
        continue;
      }
      Primitive primitive;
      primitive.triangle = entry.triangle;
      if (entry.is_piece()) {
        const ClippedPiece& piece = bins.pieces[entry.place];
        primitive.weights = piece.weights.data();
        fragments += draw(piece.corners, primitive, tile);
      } else {
        const Triangle& corners = geometry_.mesh->triangles[entry.triangle];
        fragments += draw({geometry_.vertices[corners[0]], geometry_.vertices[corners[1]],
                           geometry_.vertices[corners[2]]},
                          primitive, tile);
      }
    }
    return fragments;
  }

 private:
  struct Primitive {
    EdgeFunctions edges;
    glm::dvec3 scales{0.0};
    std::uint32_t triangle = 0;
    const glm::dvec3* weights = nullptr;  // of a piece's corners; null for a whole triangle
  };

  std::int64_t draw(const std::array<ScreenVertex, 3>& corners, Primitive& primitive,
                    const PixelBox& tile) const {
    const PixelBox box = common_part(pixel_box(corners[0], corners[1], corners[2]), tile);
    primitive.edges = edge_functions(corners);
    primitive.scales = corner_scales(primitive.edges, corners);
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
                           corner_shares(e0 + edges.bias[0], e1 + edges.bias[1], e2 + edges.bias[2],
                                         primitive.scales),
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

  // Returns 1 if the fragment is kept, whether or not it is the nearest.
  int shade(const Primitive& primitive, const glm::dvec3& shares, int x, int y) const {
    double depth_m = depth_of(shares);
    if (depth_m > geometry_.projection.camera.far_m) return 0;
    const std::size_t pixel = image_.index(x, y);
    if constexpr (kKeepsAll) {
      if (!is_nearest(pixel, depth_m)) return 1;
      if (primitive.weights != nullptr)
        image_.from_eye_m[pixel] = point_at(primitive, shares * depth_m);
    } else {
      Fragment fragment{x, y, primitive.triangle, depth_m, point_at(primitive, shares * depth_m)};
      if (!keep_(fragment)) return 0;
      depth_m = fragment.depth_m;
      if (!is_nearest(pixel, depth_m)) return 1;
      image_.from_eye_m[pixel] = fragment.from_eye_m;
    }
    show(pixel, depth_m, primitive.triangle);
    return 1;
  }

  bool is_nearest(std::size_t pixel, double depth_m) const {
    std::uint16_t& overdraw = image_.overdraw[pixel];
    if (overdraw < std::numeric_limits<std::uint16_t>::max()) ++overdraw;
    return depth_m < image_.depth_m[pixel];  // not <=: of equal depths the first triangle wins
  }

  void show(std::size_t pixel, double depth_m, std::uint32_t triangle) const {
    image_.depth_m[pixel] = depth_m;
    image_.primitive[pixel] = triangle;
  }

  glm::dvec3 point_at(const Primitive& primitive, glm::dvec3 weight) const {
    if (primitive.weights != nullptr) {
      weight = weight.x * primitive.weights[0] + weight.y * primitive.weights[1] +
               weight.z * primitive.weights[2];
    }
    return triangle_point(geometry_, primitive.triangle, weight);
  }

  const Geometry& geometry_;
  const Keep& keep_;
  HitImage& image_;
};

}  // namespace plumb::raster
