#include "core/screen_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace plumb {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Rounds a tolerance down by more than the few roundings on its way (below 40 of 1.1e-16 each).
constexpr double kRoundDown = 1.0 - 1e-12;
// Widens the frustum by more than the roundings of a plane test, relative to the lengths in it.
constexpr double kFrustumSlack = 1e-9;

using Cubic = std::array<double, 4>;

double evaluate(const Cubic& c, double t) { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }

// Where the cubic changes sign between two points that its slope does not turn between; by
// bisection.
double bisect(const Cubic& c, double low, double high) {
  const bool rising = evaluate(c, low) < 0.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    ((evaluate(c, middle) < 0.0) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Calls visit(t) at every root of the cubic in (0, 1).
template <class Visit>
void for_each_root(const Cubic& c, const Visit& visit) {
  std::array<double, 4> turns{0.0, 1.0, 1.0, 1.0};
  int count = 1;
  const double a = 3.0 * c[3], b = 2.0 * c[2], d = c[1];
  const double discriminant = b * b - 4.0 * a * d;
  if (discriminant > 0.0) {
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    for (const double t : {q / a, d / q}) {
      if (t > 0.0 && t < 1.0) turns[static_cast<std::size_t>(count++)] = t;
    }
    if (count == 3 && turns[1] > turns[2]) std::swap(turns[1], turns[2]);
  }
  turns[static_cast<std::size_t>(count)] = 1.0;
  for (int k = 0; k < count; ++k) {
    const double low = turns[static_cast<std::size_t>(k)],
                 high = turns[static_cast<std::size_t>(k) + 1];
    if ((evaluate(c, low) < 0.0) != (evaluate(c, high) < 0.0)) visit(bisect(c, low, high));
  }
}

// Largest N / (w * (w - shift)) on the segment from p to q, view coordinates, both with w > shift.
double largest_on_edge(const Camera& camera, const glm::dvec3& axis, const glm::dvec3& p,
                       const glm::dvec3& q, double shift) {
  const glm::dvec2 n_p = screen_velocity(camera, p, axis), n_q = screen_velocity(camera, q, axis);
  const glm::dvec2 n_d = n_q - n_p;
  const double n0 = glm::dot(n_p, n_p), n1 = glm::dot(n_p, n_d), n2 = glm::dot(n_d, n_d);
  const double w0 = p.z, w1 = q.z - p.z, m0 = w0 - shift;
  const auto value = [&](double t) {
    const double w = w0 + w1 * t;
    return std::sqrt(std::max(0.0, n0 + t * (2.0 * n1 + t * n2))) / (w * (w - shift));
  };
  const double a0 = w0 * m0, a1 = w1 * (w0 + m0), a2 = w1 * w1;
  const double v0 = w1 * (w0 + m0), v1 = 2.0 * w1 * w1;
  const Cubic slope{n1 * a0 - n0 * v0, n1 * a1 + n2 * a0 - n0 * v1 - 2.0 * n1 * v0,
                    n1 * a2 + n2 * a1 - 2.0 * n1 * v1 - n2 * v0, n2 * a2 - n2 * v1};
  double largest = std::max(value(0.0), value(1.0));
  for_each_root(slope, [&](double t) { largest = std::max(largest, value(t)); });
  return largest;
}

// The image's corners as slopes (x / w, y / w).
std::array<glm::dvec2, 4> image_corners(const Camera& camera) {
  const double left = -camera.centre_px.x / camera.gamma_h;
  const double right = (camera.width_px - camera.centre_px.x) / camera.gamma_h;
  const double top = camera.centre_px.y / camera.gamma_v;
  const double bottom = (camera.centre_px.y - camera.height_px) / camera.gamma_v;
  return {glm::dvec2{left, top}, {right, top}, {left, bottom}, {right, bottom}};
}

// Of the points of a box that are in view: the least depth, and the most that N / w can be; e_w is
// how much of the axis is depth.
struct Reach {
  double w_low, n, e_w;
};

Reach reach_of(const Camera& camera, const Box& box, const glm::dvec3& axis) {
  const glm::dvec3 e = direction_to_view(camera, axis);

  double n_corners = 0.0, w_corners = kInfinity;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 p = to_view(camera, box.corner(k));
    w_corners = std::min(w_corners, p.z);
    const glm::dvec2 n = screen_velocity(camera, p, e);
    n_corners = p.z > 0.0 ? std::max(n_corners, std::sqrt(glm::dot(n, n)) / p.z) : kInfinity;
  }
  double n_image = 0.0, tan_squared = 0.0;
  for (const glm::dvec2& corner : image_corners(camera)) {
    const glm::dvec2 n = screen_velocity(camera, {corner, 1.0}, e);
    n_image = std::max(n_image, std::sqrt(glm::dot(n, n)));
    tan_squared = std::max(tan_squared, glm::dot(corner, corner));
  }
  glm::dvec3 nearest;
  for (int axis_index = 0; axis_index < 3; ++axis_index) {
    nearest[axis_index] =
        std::clamp(camera.eye_m[axis_index], box.low[axis_index], box.high[axis_index]);
  }
  const glm::dvec3 apart = nearest - camera.eye_m;
  const double rho_cosine = std::sqrt(glm::dot(apart, apart) / (1.0 + tan_squared));
  return {std::max({w_corners, camera.near_m, rho_cosine}), std::min(n_corners, n_image),
          std::abs(e.z)};
}

}  // namespace

glm::dvec3 direction_to_view(const Camera& camera, const glm::dvec3& direction) {
  return {glm::dot(direction, camera.right), glm::dot(direction, camera.up),
          glm::dot(direction, camera.forward)};
}

double screen_displacement_of_view_px(const Camera& camera, const glm::dvec3& view_m,
                                      const glm::dvec3& axis_view, double delta_m) {
  if (delta_m == 0.0) return 0.0;
  return screen_displacement_at_speed_px(screen_speed(camera, view_m, axis_view), view_m.z,
                                         axis_view.z, delta_m);
}

double screen_displacement_px(const Camera& camera, const glm::dvec3& world_m,
                              const glm::dvec3& axis, double delta_m) {
  if (delta_m == 0.0) return 0.0;
  return screen_displacement_of_view_px(camera, to_view(camera, world_m),
                                        direction_to_view(camera, axis), delta_m);
}

double largest_displacement_px(const Camera& camera, const Box& box, const glm::dvec3& axis,
                               double delta_m) {
  require(glm::dot(axis, axis) == 1.0 && (axis.x != 0.0) + (axis.y != 0.0) + (axis.z != 0.0) == 1,
          "axis must be a coordinate axis, got ({}, {}, {})", axis.x, axis.y, axis.z);
  if (delta_m == 0.0 || box.empty()) return 0.0;
  const double length = std::abs(delta_m);
  const glm::dvec3 e = direction_to_view(camera, axis);
  const double shift = length * std::abs(e.z);
  const int k = axis.x != 0.0 ? 0 : axis.y != 0.0 ? 1 : 2;
  // N does not depend on the coordinate along the axis, so the worst face is the one with the least
  // depth.
  const bool low_face = e.z * axis[k] > 0.0;
  const int others[2] = {(k + 1) % 3, (k + 2) % 3};
  std::array<glm::dvec3, 4> corner;
  for (int c = 0; c < 4; ++c) {
    glm::dvec3 p;
    p[k] = low_face ? box.low[k] : box.high[k];
    p[others[0]] = (c == 1 || c == 2) ? box.high[others[0]] : box.low[others[0]];
    p[others[1]] = c >= 2 ? box.high[others[1]] : box.low[others[1]];
    corner[static_cast<std::size_t>(c)] = to_view(camera, p);
    if (!(corner[static_cast<std::size_t>(c)].z - shift > 0.0)) return kInfinity;
  }
  double largest = 0.0;
  for (std::size_t c = 0; c < 4; ++c) {
    largest = std::max(largest, largest_on_edge(camera, e, corner[c], corner[(c + 1) % 4], shift));
  }
  return length * largest;
}

double allowed_displacement_m(const Camera& camera, const Box& box, const glm::dvec3& axis,
                              double error_px) {
  require(error_px >= 0.0 && std::isfinite(error_px), "error_px must be finite and >= 0, got {}",
          error_px);
  if (box.empty() || !may_be_in_view(camera, box)) return kInfinity;
  if (error_px == 0.0) return 0.0;
  const Reach reach = reach_of(camera, box, axis);
  return error_px * reach.w_low / (reach.n + error_px * reach.e_w) * kRoundDown;
}

double displacement_bound_px(const Camera& camera, const Box& box, const glm::dvec3& axis,
                             double delta_m) {
  const double length = std::abs(delta_m);
  if (length == 0.0 || box.empty() || !may_be_in_view(camera, box)) return 0.0;
  const Reach reach = reach_of(camera, box, axis);
  const double moved = reach.w_low - length * reach.e_w;
  return moved > 0.0 ? length * reach.n / moved / kRoundDown : kInfinity;
}

bool may_be_in_view(const Camera& camera, const Box& box) {
  if (box.empty()) return false;
  const std::array<glm::dvec2, 4> image = image_corners(camera);
  const double left = image[0].x, right = image[3].x, top = image[0].y, bottom = image[3].y;
  bool outside_near = true, outside_left = true, outside_right = true, outside_top = true,
       outside_bottom = true;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 p = to_view(camera, box.corner(k));
    const double slack = kFrustumSlack * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
    outside_near = outside_near && p.z < camera.near_m - slack;
    outside_left = outside_left && p.x < left * p.z - slack;
    outside_right = outside_right && p.x > right * p.z + slack;
    outside_top = outside_top && p.y > top * p.z + slack;
    outside_bottom = outside_bottom && p.y < bottom * p.z - slack;
  }
  return !(outside_near || outside_left || outside_right || outside_top || outside_bottom);
}

}  // namespace plumb
