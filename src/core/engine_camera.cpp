#include "core/engine_camera.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"

namespace plumb {
namespace {

// Engines keep single precision: a rotation of theirs is one to a few parts in a million, and what
// is zero in a projection may be as far from it as that, beside its largest number.
constexpr double kSingle = 1e-5;

using Row = glm::dvec4;
using Rows = std::array<Row, 4>;

// For column vectors, row by row.
Rows rows_of(const std::array<double, 16>& numbers, MatrixLayout layout, VectorKind vectors,
             const char* name) {
  // Row vectors multiply from the left, by the transposed matrix.
  const bool by_rows = (layout == MatrixLayout::RowMajor) == (vectors == VectorKind::Column);
  Rows rows;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) {
      const double value = numbers[static_cast<std::size_t>(by_rows ? 4 * r + c : 4 * c + r)];
      require(std::isfinite(value), "the {} matrix has a number that is not finite", name);
      rows[static_cast<std::size_t>(r)][c] = value;
    }
  }
  return rows;
}

// Rotation and translation in the terrain's axes and metres, relative to the engine's origin:
// view_i = dot(axis_i, point) + shift_i.
struct Motion {
  std::array<glm::dvec3, 3> axis;
  glm::dvec3 shift;
};

glm::dvec3 to_terrain_axes(const EngineCamera& engine, const glm::dvec3& v) {
  const auto along = [&](int k) {
    const EngineAxis& axis = engine.world_axes[static_cast<std::size_t>(k)];
    return axis.sign * v[axis.axis];
  };
  return {along(0), along(1), along(2)};
}

Motion motion_of(const EngineCamera& engine) {
  const Rows view = rows_of(engine.view, engine.layout, engine.vectors, "view");
  const double last = std::abs(view[3].x) + std::abs(view[3].y) + std::abs(view[3].z);
  require(last <= kSingle && std::abs(view[3].w - 1.0) <= kSingle,
          "the view matrix is no rigid motion: its last row must be 0 0 0 1, got {} {} {} {} "
          "(is layout or vectors the other one?)",
          view[3].x, view[3].y, view[3].z, view[3].w);
  Motion motion;
  for (int i = 0; i < 3; ++i) {
    const Row& row = view[static_cast<std::size_t>(i)];
    motion.axis[static_cast<std::size_t>(i)] = to_terrain_axes(engine, glm::dvec3(row));
    motion.shift[i] = row.w * engine.metres_per_unit;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = i; k < 3; ++k) {
      const double product = glm::dot(motion.axis[i], motion.axis[k]);
      require(std::abs(product - (i == k ? 1.0 : 0.0)) <= kSingle,
              "the view matrix is no rigid motion: rows {} and {} have the product {} (scale "
              "belongs into metres_per_unit)",
              i, k, product);
    }
  }
  return motion;
}

// A row of the projection as a function of view space turned back into the terrain's axes, relative
// to the eye.
glm::dvec3 turned_back(const Motion& motion, const Row& row) {
  return row.x * motion.axis[0] + row.y * motion.axis[1] + row.z * motion.axis[2];
}

// What the projection does to view depth w: z / w = a + b / w after scaling.
struct Depth {
  double a, b;
};

void set_depth_range(const EngineCamera& engine, const Depth& depth, Camera& camera) {
  double at_near = engine.clip == ClipSpace::OpenGl ? -1.0 : 0.0, at_far = 1.0;
  if (engine.reverse_z) std::swap(at_near, at_far);
  const auto depth_at = [&](double end) {  // w with a + b / w == end
    return std::abs(end - depth.a) <= 1e-9 ? std::numeric_limits<double>::infinity()
                                           : depth.b / (end - depth.a);
  };
  camera.near_m = depth_at(at_near) * engine.metres_per_unit;
  camera.far_m = depth_at(at_far) * engine.metres_per_unit;
  if (camera.far_m < 0.0) camera.far_m = std::numeric_limits<double>::infinity();
  require(camera.near_m > 0.0 && camera.near_m < camera.far_m,
          "the projection's near plane lies at depth {} m and its far plane at {} m: expected 0 < "
          "near < far (is clip or reverse_z the other one?)",
          camera.near_m, camera.far_m);
}

}  // namespace

Camera camera_of(const EngineCamera& engine) {
  require(engine.metres_per_unit > 0.0 && std::isfinite(engine.metres_per_unit),
          "metres_per_unit must be positive, got {}", engine.metres_per_unit);
  require(engine.width_px >= 1 && engine.width_px <= 65536 && engine.height_px >= 1 &&
              engine.height_px <= 65536,
          "an image must be 1 to 65536 pixels wide and high, got {} x {}", engine.width_px,
          engine.height_px);
  const Motion motion = motion_of(engine);
  const Rows projection = rows_of(engine.projection, engine.layout, engine.vectors, "projection");
  const glm::dvec3 depth_row(projection[3]);
  const double scale = glm::length(depth_row);
  require(scale > 0.0 && std::abs(projection[3].w) <= kSingle * scale,
          "the projection is no pinhole's: its last row, {} {} {} {}, is an orthographic one's (or "
          "layout or vectors is the other one)",
          projection[3].x, projection[3].y, projection[3].z, projection[3].w);
  for (int k = 0; k < 2; ++k) {
    require(std::abs(projection[static_cast<std::size_t>(k)].w) <=
                kSingle * glm::length(glm::dvec3(projection[static_cast<std::size_t>(k)])),
            "the projection moves the picture by the same amount at every depth (row {} ends in "
            "{}): no pinhole does",
            k, projection[static_cast<std::size_t>(k)].w);
  }

  Camera camera;
  camera.width_px = engine.width_px;
  camera.height_px = engine.height_px;
  // The point that the view sends to zero; the rows are at right angles to single precision only.
  const glm::dmat3 columns(motion.axis[0], motion.axis[1], motion.axis[2]);
  camera.eye_m = engine.world_origin_m - glm::inverse(glm::transpose(columns)) * motion.shift;
  camera.forward = glm::normalize(turned_back(motion, projection[3]));

  // Across: x / w = gamma * (right . d) / (forward . d) + centre, in half windows.
  const glm::dvec3 x = turned_back(motion, projection[0]) / scale;
  const glm::dvec3 y = turned_back(motion, projection[1]) / scale;
  const double centre_x = glm::dot(x, camera.forward), centre_y = glm::dot(y, camera.forward);
  const glm::dvec3 right = x - centre_x * camera.forward, up = y - centre_y * camera.forward;
  const double size_x = glm::length(right), size_y = glm::length(up);
  require(size_x > 0.0 && size_y > 0.0, "the projection flattens the picture to a line");
  const double y_sign = engine.clip == ClipSpace::Vulkan ? -1.0 : 1.0;
  camera.right = right / size_x;
  camera.up = y_sign * up / size_y;
  const double skew = glm::dot(camera.right, camera.up);
  require(std::abs(skew) <= kSingle,
          "the projection is skewed: right and up are not at right angles (their product is {})",
          skew);
  require(glm::dot(glm::cross(camera.right, camera.up), camera.forward) < 0.0,
          "the picture would be mirrored: one of world_axes, clip, layout and vectors is not as "
          "the engine has it");
  // Exactly at right angles: engines' numbers are so to single precision only.
  camera.up = glm::normalize(glm::cross(camera.right, camera.forward));
  camera.gamma_h = size_x * engine.width_px / 2.0;
  camera.gamma_v = size_y * engine.height_px / 2.0;
  camera.centre_px = {(centre_x + 1.0) / 2.0 * engine.width_px,
                      (1.0 - y_sign * centre_y) / 2.0 * engine.height_px};

  // z = depth_z . view + z_shift, and must be a function of depth alone.
  const glm::dvec3 depth_z = glm::dvec3(projection[2]) / scale;
  const glm::dvec3 along = depth_row / scale;
  const double a = glm::dot(depth_z, along);
  require(glm::length(depth_z - a * along) <= kSingle * (1.0 + std::abs(a)),
          "the projection's near plane is oblique: what is cut off must be a depth");
  set_depth_range(engine, {a, projection[2].w / scale}, camera);
  return camera;
}

std::array<EngineAxis, 3> parse_world_axes(const std::string& text) {
  std::array<EngineAxis, 3> axes;
  std::size_t at = 0;
  unsigned seen = 0;
  bool good = true;
  for (std::size_t k = 0; k < 3 && good; ++k) {
    if (k > 0) good = at < text.size() && text[at++] == ',';
    EngineAxis& axis = axes[k];
    if (at < text.size() && (text[at] == '-' || text[at] == '+'))
      axis.sign = text[at++] == '-' ? -1 : 1;
    good = good && at < text.size() && text[at] >= 'x' && text[at] <= 'z';
    if (!good) break;
    axis.axis = text[at++] - 'x';
    seen |= 1u << axis.axis;
  }
  require(good && at == text.size() && seen == 7u,
          "world axes '{}': expected the engine's axes that point east, north and up, such as "
          "'x,-z,y'",
          text);
  return axes;
}

std::string to_text(const std::array<EngineAxis, 3>& world_axes) {
  std::string text;
  for (const EngineAxis& axis : world_axes) {
    if (!text.empty()) text += ',';
    if (axis.sign < 0) text += '-';
    text += static_cast<char>('x' + axis.axis);
  }
  return text;
}

}  // namespace plumb
