// Meshes given in window coordinates, so that a test can say which pixels they cover.
#pragma once

#include <initializer_list>

#include "core/camera.h"
#include "core/hash.h"
#include "core/hit_image.h"
#include "core/triangle_mesh.h"

namespace plumb::test {

/// A camera at the origin that sees (x, y, w) = (x_px * w, -y_px * w, w) at (x_px, y_px), exactly.
inline Camera window_camera(int width_px, int height_px) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.gamma_h = camera.gamma_v = 1.0;
  camera.centre_px = {0.0, 0.0};
  camera.near_m = 0.125;
  return camera;
}

struct WindowPoint {
  double x_px, y_px;
  double depth_m = 1.0;
};

/// The world point that window_camera sees there: right is +x, up +z, forward +y.
inline glm::dvec3 world(const WindowPoint& p) {
  return {p.x_px * p.depth_m, p.depth_m, -p.y_px * p.depth_m};
}

/// Each three points are a triangle.
inline TriangleMesh window_mesh(std::initializer_list<WindowPoint> points) {
  TriangleMesh mesh;
  for (const WindowPoint& point : points) mesh.vertices_m.push_back(world(point));
  for (std::uint32_t k = 0; k + 2 < mesh.vertices_m.size(); k += 3) {
    mesh.triangles.push_back({k, k + 1, k + 2});
  }
  return mesh;
}

/// Row by row, '#' for a pixel that something covers and '.' for one that nothing does.
inline std::string coverage(const HitImage& image) {
  std::string text;
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) text += image.hit(image.index(x, y)) ? '#' : '.';
    text += '\n';
  }
  return text;
}

inline std::uint64_t checksum(const HitImage& image) {
  Checksum sum;
  sum.add(std::span<const double>(image.depth_m));
  sum.add(std::span<const glm::dvec3>(image.from_eye_m));
  sum.add(std::span<const std::uint32_t>(image.primitive));
  sum.add(std::span<const std::uint16_t>(image.overdraw));
  return sum.value();
}

}  // namespace plumb::test
