// Rays against triangles in long double or __float128: slow, short, and written apart from every
// caster that it judges.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "terrain/heightfield.h"

namespace plumb::test_support {

template <class Real>
struct WideVector {
  Real x, y, z;

  friend WideVector operator-(const WideVector& a, const WideVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
};

template <class Real>
Real dot(const WideVector<Real>& a, const WideVector<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
WideVector<Real> cross(const WideVector<Real>& a, const WideVector<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Real>
WideVector<Real> widen(const glm::dvec3& v) {
  return {Real(v.x), Real(v.y), Real(v.z)};
}

/// A ray as given, in the coordinates of a terrain or mesh relative to its origin. The difference
/// of a camera's eye and that origin is taken in Real, where it has no rounding.
template <class Real>
struct WideRay {
  WideVector<Real> origin, direction;
  Real t_min, t_max;
};

template <class Real>
WideRay<Real> wide_ray(const glm::dvec3& eye_m, const glm::dvec3& surface_origin_m,
                       const glm::dvec3& direction, double t_min, double t_max) {
  return {widen<Real>(eye_m) - widen<Real>(surface_origin_m), widen<Real>(direction), Real(t_min),
          Real(t_max)};
}

template <class Real>
struct WideHit {
  bool hit = false;
  Real t = 0;
  std::uint32_t triangle = kNoPrimitive;

  void offer(Real at, std::uint32_t candidate) {
    if (!hit || at < t || (at == t && candidate < triangle)) *this = {true, at, candidate};
  }
};

/// Parameters t that a ray's line shares with a triangle: none (first > last), one, or the interval
/// where a triangle that is seen edge-on holds the line.
template <class Real>
struct WideInterval {
  Real first, last;
};

/// Where the line meets the edge from a to b (relative to the ray's origin), in whose plane it
/// lies.
template <class Real>
void add_edge(const WideVector<Real>& direction, const WideVector<Real>& a,
              const WideVector<Real>& b, WideInterval<Real>& met) {
  const WideVector<Real> along = b - a;
  const WideVector<Real> normal = cross(direction, along);
  const Real length_squared = dot(normal, normal);
  const auto add = [&](Real t) {
    met.first = t < met.first ? t : met.first;
    met.last = t > met.last ? t : met.last;
  };
  if (length_squared == 0) {  // parallel: on the line or off it
    const WideVector<Real> off = cross(a, direction);
    if (dot(off, off) > 0) return;
    add(dot(a, direction) / dot(direction, direction));
    add(dot(b, direction) / dot(direction, direction));
    return;
  }
  const Real s = dot(cross(a, direction), normal);  // in units of 1 / length_squared
  if (s >= 0 && s <= length_squared) add(dot(cross(a, along), normal) / length_squared);
}

/// Improves `best` by the closed triangle: signed volumes say whether the ray's line passes
/// through it, its plane says where.
template <class Real>
void meet_wide(const WideRay<Real>& ray, const std::array<WideVector<Real>, 3>& corners,
               std::uint32_t triangle, WideHit<Real>& best) {
  const WideVector<Real> a = corners[0] - ray.origin, b = corners[1] - ray.origin,
                         c = corners[2] - ray.origin;
  const Real ab = dot(ray.direction, cross(a, b)), bc = dot(ray.direction, cross(b, c));
  if ((ab > 0 && bc < 0) || (ab < 0 && bc > 0)) return;
  const Real ca = dot(ray.direction, cross(c, a));
  const bool inside = (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  if (!inside) return;
  const WideVector<Real> normal = cross(b - a, c - a);
  const Real facing = dot(normal, ray.direction);
  WideInterval<Real> met{Real(1e300), Real(-1e300)};
  if (facing != 0) {
    met.first = met.last = dot(normal, a) / facing;
  } else {
    add_edge(ray.direction, a, b, met);
    add_edge(ray.direction, b, c, met);
    add_edge(ray.direction, c, a, met);
  }
  const Real t = met.first < ray.t_min ? ray.t_min : met.first;
  if (met.first <= met.last && t <= met.last && t <= ray.t_max) best.offer(t, triangle);
}

/// Both triangles of a cell, those that exist.
template <class Real>
void meet_wide_cell(const WideRay<Real>& ray, const terrain::Heightfield& field,
                    terrain::Diagonal diagonal, int i, int j, WideHit<Real>& best) {
  const auto corner = [&](int a, int b) {
    return WideVector<Real>{Real(a) * Real(field.dx_m), Real(b) * Real(field.dy_m),
                            Real(field.heights_m(a, b))};
  };
  const auto triangle = [&](int half, std::array<std::array<int, 2>, 3> samples) {
    for (const auto& s : samples) {
      if (field.is_void(i + s[0], j + s[1])) return;
    }
    meet_wide<Real>(
        ray,
        {corner(i + samples[0][0], j + samples[0][1]), corner(i + samples[1][0], j + samples[1][1]),
         corner(i + samples[2][0], j + samples[2][1])},
        terrain::triangle_index(field.cell_columns(), i, j, half), best);
  };
  if (rises_north_east(diagonal, i, j)) {
    triangle(0, {{{0, 0}, {1, 0}, {1, 1}}});
    triangle(1, {{{0, 0}, {1, 1}, {0, 1}}});
  } else {
    triangle(0, {{{0, 0}, {1, 0}, {0, 1}}});
    triangle(1, {{{1, 0}, {1, 1}, {0, 1}}});
  }
}

}  // namespace plumb::test_support
