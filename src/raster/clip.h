// Triangles that the near plane or the guard band cuts, as pieces that fit together exactly.
#pragma once

#include <glm/vec3.hpp>

#include <array>

#include "raster/fixed_point.h"
#include "raster/vertex_stage.h"

namespace plumb::raster {

/// A part of a triangle in the window.
struct ClippedPiece {
  std::array<ScreenVertex, 3> corners;
  std::array<glm::dvec3, 3>
      weights;  // each corner in barycentric coordinates of the whole triangle
};

/// A triangle cut by five planes has at most eight corners, so six pieces.
inline constexpr int kMostPieces = kClipPlanes + 1;

/// Cuts a triangle at every plane of the projection; returns how many of `pieces` were filled.
///
/// from_eye_m  its corners relative to the eye
///
///   (1) Two triangles that share an edge get the same snapped corners along it: a cut is computed
///       from the ends of the edge alone, always from the end that is kept.
///   (2) No pixel is covered by two pieces of one triangle.
///   (3) A corner that no plane cuts off keeps the window coordinates that `transform` gives it.
///   (4) A corner on the near plane is kept; a cut at it has exactly the near depth.
/// Source: Sutherland & Hodgman, one plane after the other; the departures are (1) and (2).
int clip_triangle(const Projection& projection, const std::array<glm::dvec3, 3>& from_eye_m,
                  std::array<ClippedPiece, kMostPieces>& pieces);

}  // namespace plumb::raster
