#include "raster/clip.h"

#include <cstddef>

namespace plumb::raster {
namespace {

struct Corner {
  glm::dvec3 view_m;
  glm::dvec3 weight;
  ScreenVertex window;  // once everything is cut
};

struct Polygon {
  std::array<Corner, kClipPlanes + 3> corners;
  int size = 0;
  void add(const Corner& corner) { corners[static_cast<std::size_t>(size++)] = corner; }
  const Corner& at(int k) const { return corners[static_cast<std::size_t>(k % size)]; }
};

// Where the edge from a kept corner to one that is cut off meets the plane.
Corner cut(const Projection& projection, ClipPlane plane, const Corner& kept, const Corner& lost) {
  const double kept_m = projection.distance(plane, kept.view_m);
  const double lost_m = projection.distance(plane, lost.view_m);
  const double t = kept_m / (kept_m - lost_m);
  Corner result{kept.view_m + (lost.view_m - kept.view_m) * t,
                kept.weight + (lost.weight - kept.weight) * t,
                {}};
  if (plane == kNear) result.view_m.z = projection.camera.near_m;
  return result;
}

Polygon clip_at(const Projection& projection, ClipPlane plane, const Polygon& polygon) {
  Polygon result;
  for (int k = 0; k < polygon.size; ++k) {
    const Corner& here = polygon.at(k);
    const Corner& next = polygon.at(k + 1);
    const bool keeps_here = projection.distance(plane, here.view_m) >= 0.0;
    const bool keeps_next = projection.distance(plane, next.view_m) >= 0.0;
    if (keeps_here) result.add(here);
    if (keeps_here && !keeps_next) result.add(cut(projection, plane, here, next));
    if (!keeps_here && keeps_next) result.add(cut(projection, plane, next, here));
  }
  return result;
}

std::int64_t turn(const Corner& a, const Corner& b, const Corner& c) {
  return doubled_area(a.window, b.window, c.window);
}

// True if the fan around corner `apex` has no two pieces that run opposite ways.
bool fan_is_flat(const Polygon& polygon, int apex) {
  bool clockwise = false, counter_clockwise = false;
  for (int k = 1; k + 1 < polygon.size; ++k) {
    const std::int64_t area =
        turn(polygon.at(apex), polygon.at(apex + k), polygon.at(apex + k + 1));
    clockwise = clockwise || area > 0;
    counter_clockwise = counter_clockwise || area < 0;
  }
  return !(clockwise && counter_clockwise);
}

// The convex hull of the snapped corners, leftmost (then topmost) first: gift wrapping.
Polygon hull_of(const Polygon& polygon) {
  const auto before = [](const ScreenVertex& a, const ScreenVertex& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  };
  const auto distance = [](const ScreenVertex& a, const ScreenVertex& b) {
    return std::max(std::abs(std::int64_t{a.x} - b.x), std::abs(std::int64_t{a.y} - b.y));
  };
  int first = 0;
  for (int k = 1; k < polygon.size; ++k) {
    if (before(polygon.at(k).window, polygon.at(first).window)) first = k;
  }
  Polygon hull;
  int here = first;
  do {
    hull.add(polygon.at(here));
    int next = -1;  // everything else lies to one side of here -> next; of several, the farthest
    for (int k = 0; k < polygon.size; ++k) {
      const ScreenVertex &from = polygon.at(here).window, &to = polygon.at(k).window;
      if (from.x == to.x && from.y == to.y) continue;
      const std::int64_t side =
          next < 0 ? -1 : turn(polygon.at(here), polygon.at(next), polygon.at(k));
      if (side < 0 || (side == 0 && distance(from, to) > distance(from, polygon.at(next).window))) {
        next = k;
      }
    }
    if (next < 0) break;  // all corners fell together
    here = next;
  } while (polygon.at(here).window.x != polygon.at(first).window.x ||
           polygon.at(here).window.y != polygon.at(first).window.y);
  return hull;
}

int fan(const Polygon& polygon, int apex, std::array<ClippedPiece, kMostPieces>& pieces) {
  int count = 0;
  for (int k = 1; k + 1 < polygon.size; ++k) {
    const Corner &a = polygon.at(apex), &b = polygon.at(apex + k), &c = polygon.at(apex + k + 1);
    if (turn(a, b, c) == 0) continue;
    pieces[static_cast<std::size_t>(count++)] = {{a.window, b.window, c.window},
                                                 {a.weight, b.weight, c.weight}};
  }
  return count;
}

}  // namespace

int clip_triangle(const Projection& projection, const std::array<glm::dvec3, 3>& from_eye_m,
                  std::array<ClippedPiece, kMostPieces>& pieces) {
  Polygon polygon;
  for (std::size_t i = 0; i < 3; ++i) {
    glm::dvec3 weight(0.0);
    weight[static_cast<int>(i)] = 1.0;
    polygon.add({projection.view(from_eye_m[i]), weight, {}});
  }
  for (int plane = 0; plane < kClipPlanes; ++plane) {
    polygon = clip_at(projection, static_cast<ClipPlane>(plane), polygon);
    if (polygon.size < 3) return 0;
  }
  for (int k = 0; k < polygon.size; ++k) {
    Corner& corner = polygon.corners[static_cast<std::size_t>(k)];
    corner.window = projection.to_window(corner.view_m);
  }
  for (int apex = 0; apex < polygon.size; ++apex) {
    if (fan_is_flat(polygon, apex)) return fan(polygon, apex, pieces);
  }
  // Snapping dented the polygon by a fraction of a subpixel so that every fan overlaps itself.
  // Its hull covers all of it, and no pixel twice.
  return fan(hull_of(polygon), 0, pieces);
}

}  // namespace plumb::raster
