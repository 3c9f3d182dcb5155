#include "slicing/bundle_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/screen_error.h"
#include "slicing/slice_ray.h"

namespace plumb::slicing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostPlanes = 1e6;  // of a bundle; where more were needed it is none
constexpr double kRoundUp = 1.0 + 1e-12;

double vertices_s(double count, const CostProfile& profile) {
  return count / profile.vertices_per_s;
}

// rst(A, l, cosine): of an area seen under an angle.
double area_s(double area_m2, const BoxView& view, double share, const Camera& camera,
              const CostProfile& profile) {
  const double pixels_per_m = camera.gamma_v / view.distance_m;
  return std::min(area_m2 * share * pixels_per_m * pixels_per_m, view.most_px) /
         profile.pixels_per_s;
}

double area_across_m2(const glm::dvec3& extent, Axis axis) {
  const int n = index_of(axis);
  return extent[(n + 1) % 3] * extent[(n + 2) % 3];
}

double quads_s(double count, Axis axis, const glm::dvec3& extent, const BoxView& view,
               const Camera& camera, const CostProfile& profile) {
  const double share = axis == Axis::Z ? view.sin_most : view.cos_least;
  return count * (vertices_s(4.0, profile) +
                  area_s(area_across_m2(extent, axis), view, share, camera, profile));
}

Axis published_axis(const Box& box, const glm::dvec3& eye_m) {
  const glm::dvec3 d = 0.5 * (box.low + box.high) - eye_m;
  if (d.z * d.z > d.x * d.x + d.y * d.y) return Axis::Z;
  return std::abs(d.x) >= std::abs(d.y) ? Axis::X : Axis::Y;
}

SliceBundle bundle_across(const Box& box, std::uint32_t index, Axis axis, double count) {
  SliceBundle bundle;
  bundle.node = index;
  bundle.axis = axis;
  bundle.count = static_cast<int>(count);
  bundle.first_m = box.low[index_of(axis)];
  bundle.spacing_m = (box.high[index_of(axis)] - bundle.first_m) / count;
  bundle.reach = box;
  bundle.least_z_m = box.low.z;
  bundle.greatest_z_m = box.high.z;
  return bundle;
}

std::optional<PricedBundle> published(const SlicingNode& node, std::uint32_t index,
                                      const Camera& camera, double tolerance_px,
                                      const CostProfile& profile, bool borders) {
  const BoxView view = view_of_box(node.box, camera, Variant::Published);
  if (!(view.distance_m > 0.0)) return std::nullopt;
  const glm::dvec3 extent = node.box.high - node.box.low;
  const Axis axis = published_axis(node.box, camera.eye_m);
  const double cosine = axis == Axis::Z ? view.cos_least : 1.0;
  const double gap_px =
      projected_px(camera, extent[index_of(axis)], view.distance_m, cosine) / tolerance_px;
  const double count = std::max(1.0, std::ceil(gap_px));
  if (!(count <= kMostPlanes)) return std::nullopt;
  PricedBundle priced{bundle_across(node.box, index, axis, count),
                      quads_s(count, axis, extent, view, camera, profile)};
  SliceBundle& bundle = priced.bundle;
  const double pixel_m = 1.0 / projected_px(camera, 1.0, view.distance_m, 1.0);
  bundle.raise_m = 0.5 * pixel_m;
  if (!borders) return priced;
  if (axis == Axis::Z) {
    bundle.reach.low -= glm::dvec3(pixel_m, pixel_m, 0.0);
    bundle.reach.high += glm::dvec3(pixel_m, pixel_m, 0.0);
  } else if (projected_px(camera, extent.z, view.distance_m, view.cos_least) < 1.0) {
    bundle.reach.low.z -= pixel_m;
    bundle.reach.high.z += pixel_m;
  }
  return priced;
}

// What a polygon's edge may be moved on the screen by the rasteriser's snapping is at most this far
// from it in space, anywhere in the box: sqrt(1/2) / 256 px and as much again for roundings.
double snapping_m(const Box& box, const Camera& camera) {
  double farthest_squared = 0.0;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 d = box.corner(k) - camera.eye_m;
    farthest_squared = std::max(farthest_squared, glm::dot(d, d));
  }
  return 1.42 / 256.0 * std::sqrt(farthest_squared) / std::min(camera.gamma_h, camera.gamma_v);
}

std::optional<PricedBundle> conservative(const SlicingNode& node, std::uint32_t index,
                                         const Camera& camera, double tolerance_px,
                                         const CostProfile& profile) {
  const BoxView view = view_of_box(node.box, camera, Variant::Conservative);
  if (!node.inland || !(view.distance_m > 0.0)) return std::nullopt;
  // A ray that misses a polygon by its snapping comes within `border` of its edge on the bundle's
  // side, so into the box widened by it, and is there less than `raise` above the ground.
  const double border_m = snapping_m(node.box, camera);
  const double raise_m = border_m * (1.0 + node.steepest);
  const Box reach{node.box.low - glm::dvec3(border_m, border_m, raise_m),
                  node.box.high + glm::dvec3(border_m, border_m, raise_m)};
  const double allowed_m =
      allowed_displacement_m(camera, reach, glm::dvec3(0.0, 0.0, 1.0), tolerance_px);
  if (!(allowed_m > 2.0 * raise_m)) return std::nullopt;
  const glm::dvec3 extent = reach.high - reach.low;
  const double closing_s = quads_s(2.0, Axis::X, extent, view, camera, profile) +
                           quads_s(2.0, Axis::Y, extent, view, camera, profile) +
                           quads_s(1.0, Axis::Z, extent, view, camera, profile);
  std::optional<PricedBundle> best;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    const double change = depth_change(reach, node.steepest, camera.eye_m, axis);
    const double count =
        std::max(1.0, std::ceil(extent[index_of(axis)] * change / allowed_m * kRoundUp));
    if (!(count <= kMostPlanes)) continue;
    const double cost_s = quads_s(count, axis, extent, view, camera, profile) + closing_s;
    if (best && best->cost_s <= cost_s) continue;
    best = PricedBundle{bundle_across(reach, index, axis, count), cost_s};
    best->bundle.closed = true;
    best->bundle.closing_raise_m = raise_m;
    // 2^8 roundings: where a ray meets a plane takes fewer than ten.
    best->bundle.closing_rim_m = std::ldexp(greatest_coordinate_m(reach, camera.eye_m), -44);
    best->bundle.least_z_m = -kInfinity;
    best->bundle.greatest_z_m = kInfinity;
  }
  return best;
}

// The steepest slope within the reach, infinity where it is not known: a node knows its own cells
// and those around them.
double steepest_within(const Box& reach, const SlicingNode& node) {
  const glm::dvec3 extent = node.box.high - node.box.low;
  const double dx = extent.x / (node.i1 - node.i0), dy = extent.y / (node.j1 - node.j0);
  const bool known = node.inland && reach.low.x >= node.box.low.x - dx &&
                     reach.low.y >= node.box.low.y - dy && reach.high.x <= node.box.high.x + dx &&
                     reach.high.y <= node.box.high.y + dy;
  return known ? node.steepest : kInfinity;
}

}  // namespace

BoxView view_of_box(const Box& box, const Camera& camera, Variant variant) {
  const glm::dvec3& eye_m = camera.eye_m;
  BoxView view;
  double least_squared = kInfinity, least_sine = 1.0;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 d = box.corner(k) - eye_m;
    const double squared = glm::dot(d, d);
    least_squared = std::min(least_squared, squared);
    const double sine = squared > 0.0 ? std::abs(d.z) / std::sqrt(squared) : 1.0;
    least_sine = std::min(least_sine, sine);
    view.sin_most = std::max(view.sin_most, sine);
  }
  if (eye_m.z >= box.low.z && eye_m.z <= box.high.z) least_sine = 0.0;
  view.cos_least = std::sqrt(1.0 - least_sine * least_sine);
  view.distance_m = std::sqrt(least_squared);
  if (variant == Variant::Conservative) {
    view.most_px = static_cast<double>(camera.width_px) * camera.height_px;
    glm::dvec3 apart;
    for (int axis = 0; axis < 3; ++axis)
      apart[axis] = std::clamp(eye_m[axis], box.low[axis], box.high[axis]) - eye_m[axis];
    view.distance_m = std::sqrt(glm::dot(apart, apart));
  }
  return view;
}

double projected_px(const Camera& camera, double length_m, double distance_m, double cosine) {
  return camera.gamma_v * length_m * cosine / distance_m;
}

double cost_of_polygons_s(const SlicingNode& node, const BoxView& view, const Camera& camera,
                          const CostProfile& profile) {
  const glm::dvec3 extent = node.box.high - node.box.low;
  const double fans = 0.5 * (node.i1 - node.i0) * 0.5 * (node.j1 - node.j0);
  return vertices_s(10.0 * fans, profile) +
         area_s(extent.x * extent.y, view, view.sin_most, camera, profile);
}

double depth_change(const Box& box, double steepest, const glm::dvec3& eye_m, Axis axis) {
  const int n = index_of(axis);
  const double low = box.low[n] - eye_m[n], high = box.high[n] - eye_m[n];
  if (!(low > 0.0) && !(high < 0.0)) return kInfinity;
  double most = 0.0;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 p = box.corner(k) - eye_m;
    const double across = std::sqrt(p.x * p.x + p.y * p.y);
    most = std::max(most, (steepest * across + std::abs(p.z)) / std::abs(p[n]));
  }
  return most;
}

std::optional<PricedBundle> price_bundle(const SlicingNode& node, std::uint32_t index,
                                         const Camera& camera, Variant variant, double tolerance_px,
                                         const CostProfile& profile, bool borders) {
  std::optional<PricedBundle> priced =
      variant == Variant::Published ? published(node, index, camera, tolerance_px, profile, borders)
                                    : conservative(node, index, camera, tolerance_px, profile);
  if (priced) priced->bundle.steepest = steepest_within(priced->bundle.reach, node);
  return priced;
}

}  // namespace plumb::slicing
