// A camera from the two matrices that an engine draws with, whatever its conventions.
#pragma once

#include <array>
#include <string>

#include "core/camera.h"

namespace plumb {

/// How sixteen numbers are read as rows and columns.
enum class MatrixLayout { RowMajor, ColumnMajor };
/// column: clip = projection * view * point; row: clip = point * view * projection.
enum class VectorKind { Column, Row };
/// Depth after the division, and which way the window's y runs in it.
enum class ClipSpace {
  OpenGl,    // -1 (near) .. 1 (far), y upwards
  Direct3d,  // 0 .. 1, y upwards
  Vulkan,    // 0 .. 1, y downwards
};

/// One of the engine's axes, with its sign.
struct EngineAxis {
  int axis = 0;  // 0, 1, 2: the engine's x, y, z
  int sign = 1;  // 1 or -1
  friend bool operator==(const EngineAxis&, const EngineAxis&) = default;
};

/// What an engine draws a frame with, and its conventions.
struct EngineCamera {
  std::array<double, 16> view{};        // from the engine's world to its view space
  std::array<double, 16> projection{};  // from view space to clip space
  MatrixLayout layout = MatrixLayout::ColumnMajor;
  VectorKind vectors = VectorKind::Column;
  ClipSpace clip = ClipSpace::OpenGl;
  bool reverse_z = false;  // near and far change places
  /// The engine's axes that point east, north and up.
  std::array<EngineAxis, 3> world_axes{{{0, 1}, {1, 1}, {2, 1}}};
  double metres_per_unit = 1.0;    // > 0
  glm::dvec3 world_origin_m{0.0};  // where the engine's origin stands in the terrain's world
  int width_px = 1920;
  int height_px = 1080;

  friend bool operator==(const EngineCamera&, const EngineCamera&) = default;
};

/// The pinhole camera that draws the same picture. Off-centre projections, windows of any shape,
/// infinite far planes and left-handed spaces are all right.
///
///   (1) A point's pixel is the one that clip = projection * view * point gives, divided, in a
///       window of width x height whose row 0 is on top.
///   (2) near_m and far_m are the view depths that the projection sends to the ends of its range.
/// Throws std::invalid_argument, one line that names the property that fails: numbers that are not
/// finite, a view that is no rigid motion, an orthographic or skewed projection, a near plane that
/// is oblique or not in front of the eye, axes that are not three different ones, and a picture
/// that would be mirrored (which is what a wrong layout, hand or y direction looks like).
Camera camera_of(const EngineCamera& engine);

/// "x,-z,y": the engine's axes that point east, north and up. Throws std::invalid_argument.
std::array<EngineAxis, 3> parse_world_axes(const std::string& text);
std::string to_text(const std::array<EngineAxis, 3>& world_axes);

}  // namespace plumb
